//! The configuration of a motion controller, and advice on it: units of its limits, its tick and
//! its frequencies.

use core::f64::consts::PI;

use crate::estimate::ObserverConfig;
use crate::limits::{ConfigError, ConfigParameter};
use crate::safety::SupervisorConfig;
use dynamics_core::advice::{
    Advice, AdvisedJoint, Frequency, positions_in_degrees, speeds_in_degrees,
};
use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;

/// s: 20 ticks a second. Loops over the slowest buses, those of hobby servos, have 50.
const LONG_TICK: f64 = 0.05;
/// rad or m: 57°. A restart within it is a jump already; 1° is 0.017 rad.
const FAR_RESTART: f64 = 1.0;
/// The share of a joint's greatest speed that one step of the encoder makes in the estimated
/// velocity. At 1 kHz and 250 rad/s 12 bits make 0.1 rad/s: 3 % of an arm's 3 rad/s.
const COARSE: f64 = 0.2;

/// The parameters of a [`MotionController`](super::MotionController): those of the arm and of the
/// loop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionControllerConfig<R, const V: usize> {
    /// Limits, the length of a tick, and the durations of the reactions to a fault.
    pub supervisor: SupervisorConfig<R, V>,
    /// Bandwidth ω_o of the observer, rad/s, about ten times that of the feedback.
    pub observer_bandwidth: R,
    /// Rate λ at which the speed of a held arm decays, 1/s: q̈ = −λ q̇. About ω_n of the feedback;
    /// with 2 ζ ω_n a fast arm needs more torque than it has.
    pub decay_rate: R,
    /// The greatest distance of a joint from its reference for
    /// [`MotionController::reset`](super::MotionController::reset), rad or m.
    pub restart_distance: R,
}

impl<R: Real, const V: usize> MotionControllerConfig<R, V> {
    /// Checks that every number is within its range and that every limit allows some motion or
    /// torque.
    ///
    /// # Errors
    /// [`ConfigError`]; if a limit is wrong, with the joint, the limit and its value.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.supervisor.check()?;
        self.observer().check()?;
        ConfigParameter::DecayRate.positive(self.decay_rate)?;
        ConfigParameter::RestartDistance.require(self.restart_distance >= R::ZERO)
    }

    pub(super) fn observer(&self) -> ObserverConfig<R> {
        ObserverConfig { bandwidth: self.observer_bandwidth, tick: self.supervisor.tick }
    }

    /// The parts of the configuration that look like another unit, or cannot act: a list of words
    /// with numbers. Never a refusal: [`MotionControllerConfig::check`] refuses what is impossible.
    ///
    /// | advice | given where |
    /// |---|---|
    /// | [`Advice::LongTick`] | the tick is longer than 0.05 s |
    /// | [`Advice::FarRestart`] | the restart distance is above 1 rad, and finite |
    /// | [`Advice::ZeroRate`] | the rate of a joint that has a torque is zero |
    /// | [`Advice::PositionsInDegrees`], [`Advice::SpeedsInDegrees`] | most limits are beyond four turns, or 60 rad/s |
    /// | [`Advice::PositionInDegrees`], [`Advice::SpeedInDegrees`] | some limits are beyond four turns; one is above 60 rad/s and 20 times the next |
    /// | [`Advice::BeyondNyquist`] | the observer's bandwidth or the decay rate is above π / tick |
    /// | [`Advice::BeyondObserver`] | the decay rate, which is about ω_n, is not below the observer's bandwidth |
    /// | [`Advice::CoarseEncoder`] | a step of the encoder changes the estimated velocity by 0.2 of the joint's speed limit |
    ///
    /// ```
    /// use dynamics_core::advice::Advice;
    /// use motion_control::limits::SafetyLimits;
    /// use motion_control::motion::MotionControllerConfig;
    /// use motion_control::safety::SupervisorConfig;
    /// let limits = SafetyLimits { torque: [10.0], rate: [5.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let good = MotionControllerConfig {
    ///     supervisor: SupervisorConfig {
    ///         limits, tick: 1e-3, resolution: 4e-4, ride_through_ticks: 5, hold_ticks: 100, reentry_ticks: 200,
    ///     },
    ///     observer_bandwidth: 250.0,
    ///     decay_rate: 25.0,
    ///     restart_distance: 0.15,
    /// };
    /// assert_eq!(good.advice().count(), 0);
    /// let degrees = MotionControllerConfig { restart_distance: 15.0, ..good };
    /// assert_eq!(degrees.check(), Ok(()));
    /// assert_eq!(degrees.advice().next(), Some(Advice::FarRestart { distance: 15.0 }));
    /// ```
    pub fn advice(&self) -> impl Iterator<Item = Advice> + '_ {
        let (limits, tick) = (&self.supervisor.limits, self.supervisor.tick.to_f64());
        let (bandwidth, decay) = (self.observer_bandwidth.to_f64(), self.decay_rate.to_f64());
        let distance = self.restart_distance.to_f64();
        let ends = limits.lower.iter().zip(&limits.upper);
        let ends = ends.map(|(lower, upper)| [lower.to_f64(), upper.to_f64()]);
        let once = [
            (tick > LONG_TICK).then_some(Advice::LongTick { tick }),
            (distance.is_finite() && distance > FAR_RESTART)
                .then_some(Advice::FarRestart { distance }),
            positions_in_degrees(numbered(ends)),
            speeds_in_degrees(numbered(limits.speed.iter().map(|x| x.to_f64()))),
            beyond_nyquist(Frequency::Observer, bandwidth, tick),
            beyond_nyquist(Frequency::DecayRate, decay, tick),
            beyond_observer(Frequency::DecayRate, decay, bandwidth),
        ];
        let torques = limits.rate.iter().zip(&limits.torque);
        let rates = numbered(torques).filter_map(|(joint, (&rate, &torque))| {
            let torque = torque.to_f64();
            (rate == R::ZERO && torque > 0.0).then_some(Advice::ZeroRate { joint, torque })
        });
        let resolution = self.supervisor.resolution.to_f64();
        let step = bandwidth * bandwidth * tick * resolution;
        let coarse = numbered(limits.speed.iter()).filter_map(move |(joint, speed)| {
            let speed = speed.to_f64();
            (step > COARSE * speed).then_some(Advice::CoarseEncoder {
                joint,
                resolution,
                step,
                speed,
            })
        });
        once.into_iter().flatten().chain(rates).chain(coarse)
    }

    /// The same for the feedback's natural frequency ω_n and the bandwidth of the drives' torque,
    /// both in rad/s, which the configuration does not have: [`Advice::BeyondNyquist`],
    /// [`Advice::BeyondObserver`] and [`Advice::BeyondDrive`].
    ///
    /// The bandwidth is that at which the torque follows its command; infinite where it is not
    /// known.
    ///
    /// ```
    /// # use motion_control::limits::SafetyLimits;
    /// # use motion_control::motion::MotionControllerConfig;
    /// # use motion_control::safety::SupervisorConfig;
    /// # let limits = SafetyLimits { torque: [10.0], rate: [5.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let config = MotionControllerConfig {
    /// #     supervisor: SupervisorConfig {
    /// #         limits, tick: 1e-3, resolution: 4e-4, ride_through_ticks: 5, hold_ticks: 100, reentry_ticks: 200,
    /// #     },
    /// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.15,
    /// # };
    /// use dynamics_core::advice::Advice;
    /// let slow_drive = 20.0; // rad/s, such as a hobby servo over its bus
    /// let advice: Vec<Advice> = config.advice_on_feedback(25.0, slow_drive).collect();
    /// assert_eq!(advice, [Advice::BeyondDrive { frequency: 25.0, bandwidth: 20.0 }]);
    /// ```
    pub fn advice_on_feedback(
        &self,
        natural_frequency: R,
        drive_bandwidth: R,
    ) -> impl Iterator<Item = Advice> + use<R, V> {
        let (frequency, bandwidth) = (natural_frequency.to_f64(), drive_bandwidth.to_f64());
        let of = Frequency::Natural;
        [
            beyond_nyquist(of, frequency, self.supervisor.tick.to_f64()),
            beyond_observer(of, frequency, self.observer_bandwidth.to_f64()),
            (frequency >= bandwidth).then_some(Advice::BeyondDrive { frequency, bandwidth }),
        ]
        .into_iter()
        .flatten()
    }
}

/// The joints in the order of the numbers, without names.
fn numbered<T>(all: impl Iterator<Item = T>) -> impl Iterator<Item = (AdvisedJoint, T)> {
    all.enumerate().map(|(number, x)| {
        let body = None;
        (AdvisedJoint { number, body }, x)
    })
}

fn beyond_nyquist(of: Frequency, frequency: f64, tick: f64) -> Option<Advice> {
    let nyquist = PI / tick;
    (frequency > nyquist).then_some(Advice::BeyondNyquist { of, frequency, nyquist })
}

fn beyond_observer(of: Frequency, frequency: f64, bandwidth: f64) -> Option<Advice> {
    (frequency >= bandwidth).then_some(Advice::BeyondObserver { of, frequency, bandwidth })
}
