//! Joint velocities from encoder positions: a Luenberger observer of constant gains.
//!
//! Luenberger, "An Introduction to Observers" (IEEE Trans. Automatic Control, 1971), on q̈ known:
//!
//! ```text
//! q̂⁻ = q̂ + h q̇̂ + ½ h² q̈      q̇̂⁻ = q̇̂ + h q̈      e = q_m − q̂⁻
//! q̂  = q̂⁻ + (1 − β²) e         q̇̂  = q̇̂⁻ + (1 − β)² e / h
//! ```
//!
//! Both poles lie at β = exp(−ω_o h): the critically damped g-h filter of Brookner, *Tracking and
//! Kalman Filtering Made Easy* (1998), section 1.2.6. h is the nominal tick, never a measured one.

use crate::limits::{Circles, ConfigError, ConfigParameter};
use dynamics_core::scalar::Real;
use dynamics_core::state::all_finite;

#[cfg(test)]
mod tests;

/// Positions and velocities of the joints, as estimated by an [`Observer`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Estimate<R, const V: usize> {
    /// Positions q̂, rad or m.
    pub q: [R; V],
    /// Velocities, rad/s or m/s.
    pub qd: [R; V],
}

/// The parameters of an [`Observer`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ObserverConfig<R> {
    /// Bandwidth ω_o, rad/s. A higher bandwidth follows faster and passes more of the quantisation:
    /// a step Δ of the encoder changes the velocity by about ω_o² h Δ.
    pub bandwidth: R,
    /// Nominal length h of a tick, s.
    pub tick: R,
}

impl<R: Real> ObserverConfig<R> {
    /// Checks that both numbers are finite and greater than zero.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::Tick.positive(self.tick)?;
        ConfigParameter::Bandwidth.positive(self.bandwidth)
    }
}

/// 1 − exp(−x) for x from 0 to 16, at which larger numbers count.
#[inline(always)]
pub(crate) fn one_less_decay<R: Real>(x: R) -> R {
    let x = x.clamped(R::ZERO, R::from_f64(16.0));
    // exp(x) − 1 to x⁵/120, and from it the result without cancellation.
    let mut series = R::ONE;
    for n in [5.0, 4.0, 3.0, 2.0] {
        series = R::ONE + x * R::from_f64(1.0 / n) * series;
    }
    let growth = x * series;
    growth / (R::ONE + growth)
}

/// An observer of V joints with one bandwidth.
///
/// With a known acceleration (that of the reference) the estimate does not lag while the arm
/// accelerates. A non-finite input leaves the estimate unchanged.
///
/// ```
/// use motion_control::estimate::{Observer, ObserverConfig};
/// let mut observer = Observer::<f32, 1>::try_new(ObserverConfig { bandwidth: 200.0, tick: 1e-3 })?;
/// for tick in 0..200 {
///     observer.update(&[0.5 + 2e-3 * tick as f32], &[0.0]);
/// }
/// assert!((observer.predict(&[0.0]).qd[0] - 2.0).abs() < 1e-3);
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
#[doc(alias = "velocity estimator")]
#[doc(alias = "Luenberger")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer<R, const V: usize> {
    tick: R,
    half_tick: R,
    half_tick_squared: R,
    /// 1 − β².
    position_gain: R,
    /// (1 − β)² / h.
    velocity_gain: R,
    estimate: Estimate<R, V>,
    started: bool,
}

impl<R: Real, const V: usize> Observer<R, V> {
    /// An observer without a position: the first update sets the position, at zero velocity.
    ///
    /// # Errors
    /// [`ConfigError`], as [`ObserverConfig::check`].
    pub fn try_new(config: ObserverConfig<R>) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self::new(config))
    }

    /// As [`Self::try_new`], without the check: for constant configurations.
    ///
    /// A bandwidth or tick that is not a positive number leaves both gains at zero, and with them
    /// the velocity; ω_o h counts up to 16.
    pub fn new(config: ObserverConfig<R>) -> Self {
        let ObserverConfig { bandwidth, tick } = config;
        let usable = tick.is_finite() & (tick > R::ZERO) & (bandwidth > R::ZERO);
        let (tick, x) = if usable { (tick, bandwidth * tick) } else { (R::ZERO, R::ZERO) };
        let gap = one_less_decay(x);
        Self {
            tick,
            half_tick: R::from_f64(0.5) * tick,
            half_tick_squared: R::from_f64(0.5) * tick * tick,
            position_gain: gap * (R::from_f64(2.0) - gap),
            velocity_gain: if usable { gap * gap / tick } else { R::ZERO },
            estimate: Estimate { q: [R::ZERO; V], qd: [R::ZERO; V] },
            started: false,
        }
    }

    /// Restarts at rest at q. A non-finite q changes nothing.
    pub fn reset(&mut self, q: &[R; V]) {
        if all_finite(q) {
            self.started = true;
            self.estimate = Estimate { q: *q, qd: [R::ZERO; V] };
        }
    }

    /// The estimate after a measurement q (rad, m); the acceleration `qdd` has acted since the
    /// previous one.
    ///
    /// Cost: 10 flops per joint, with the same instructions for all data, except for the first
    /// measurement and non-finite ones.
    #[inline]
    pub fn update(&mut self, q: &[R; V], qdd: &[R; V]) -> Estimate<R, V> {
        if !self.started {
            self.reset(q);
            return self.estimate;
        }
        let mut next = self.predicted(qdd);
        for ((next, rate), &q) in next.q.iter_mut().zip(&mut next.qd).zip(q) {
            let e = q - *next;
            *next += self.position_gain * e;
            *rate += self.velocity_gain * e;
        }
        self.keep(next)
    }

    /// The estimate after a tick without a valid measurement: the prediction.
    ///
    /// ```
    /// use motion_control::estimate::{Observer, ObserverConfig};
    /// let mut observer = Observer::<f32, 1>::new(ObserverConfig { bandwidth: 200.0, tick: 0.5 });
    /// observer.reset(&[1.0]);
    /// let estimate = observer.predict(&[2.0]);
    /// assert_eq!((estimate.q, estimate.qd), ([1.25], [1.0]));
    /// ```
    #[inline]
    pub fn predict(&mut self, qdd: &[R; V]) -> Estimate<R, V> {
        if !self.started {
            return self.estimate;
        }
        let next = self.predicted(qdd);
        self.keep(next)
    }

    /// The present estimate, after a measurement q (rad, m) of the previous tick, for encoders that
    /// latch a position at the end of one frame and send it in the next. `qdd` has acted since
    /// then.
    ///
    /// The prediction of the previous tick is corrected and then extrapolated: the poles are those
    /// of [`Self::update`], but the estimate does not include a measurement of the present tick.
    /// The cost is that of [`Self::update`].
    ///
    /// ```
    /// use motion_control::estimate::{Observer, ObserverConfig};
    /// let mut observer = Observer::<f32, 1>::new(ObserverConfig { bandwidth: 200.0, tick: 1e-3 });
    /// let position = |tick: i32| 0.5 + 2e-3 * tick as f32;
    /// for tick in 0..200 {
    ///     observer.update_delayed(&[position(tick - 1)], &[0.0]);
    /// }
    /// assert!((observer.estimate().q[0] - position(199)).abs() < 1e-5);
    /// ```
    #[inline]
    pub fn update_delayed(&mut self, q: &[R; V], qdd: &[R; V]) -> &Estimate<R, V> {
        if !self.started {
            self.reset(q);
            return &self.estimate;
        }
        let mut next = self.estimate;
        let mut sum = -R::ZERO;
        let inputs = q.iter().zip(qdd);
        for ((next, rate), (&q, &qdd)) in next.q.iter_mut().zip(&mut next.qd).zip(inputs) {
            let e = q - *next;
            let speed = *rate + self.velocity_gain * e;
            *rate = speed + self.tick * qdd;
            *next = (*next + self.position_gain * e) + self.half_tick * (speed + *rate);
            // Every input reaches the position, and every position the sum.
            sum += *next;
        }
        if sum.is_finite() {
            self.estimate = next;
        }
        &self.estimate
    }

    /// As [`Self::update`] without acceleration, for an arm that sinks: a function of its own, so
    /// that the update of the usual tick is inlined as before.
    #[cold]
    #[inline(never)]
    pub(crate) fn follow(&mut self, q: &[R; V]) {
        let mut next = self.estimate;
        for ((next, rate), &q) in next.q.iter_mut().zip(&mut next.qd).zip(q) {
            *next += self.tick * *rate;
            let e = q - *next;
            *next += self.position_gain * e;
            *rate += self.velocity_gain * e;
        }
        self.keep(next);
    }

    /// Replaces the positions by measured ones q (rad, m) after ticks without measurements; the
    /// velocities keep their predicted values. A non-finite q changes nothing.
    pub fn correct_position(&mut self, q: &[R; V]) {
        if all_finite(q) {
            self.estimate.q = *q;
        }
    }

    /// As [`Self::correct_position`], with positions q (rad, m) of the previous tick, extrapolated
    /// to the present one at the predicted velocities.
    pub fn correct_position_delayed(&mut self, q: &[R; V]) {
        if !all_finite(q) {
            return;
        }
        let rates = self.estimate.qd.iter();
        for ((out, &q), &qd) in self.estimate.q.iter_mut().zip(q).zip(rates) {
            *out = q + self.tick * qd;
        }
    }

    /// Moves the estimate by whole turns of the circles to within half a turn of `to`, rad: before
    /// an update with the position of a joint that turns without end, of which the encoder measures
    /// the angle within a turn.
    ///
    /// The velocity is then as accurate after any number of turns as in the first. A
    /// [`MotionController`](crate::motion::MotionController)
    /// [`OnCircles`](crate::motion::OnCircles) does this in each tick.
    ///
    /// ```
    /// use motion_control::estimate::{Observer, ObserverConfig};
    /// use motion_control::limits::Circles;
    /// let mut observer = Observer::<f32, 1>::new(ObserverConfig { bandwidth: 200.0, tick: 1e-3 });
    /// for measured in [3.138, 3.14, -3.141_185, -3.139_185] { // 2 mrad a tick, through π
    ///     observer.turn_to(Circles::NONE.with(0), &[measured]);
    ///     observer.update(&[measured], &[0.0]);
    /// }
    /// assert!((0.0..2.0).contains(&observer.estimate().qd[0]) && observer.estimate().q[0] < -3.13);
    /// ```
    pub fn turn_to(&mut self, circles: Circles, to: &[R; V]) {
        self.estimate.q = circles.near(&self.estimate.q, to);
    }

    /// Whether a position was ever measured.
    pub(crate) fn started(&self) -> bool {
        self.started
    }

    /// The nominal length of a tick.
    pub(crate) fn tick(&self) -> R {
        self.tick
    }

    /// The present estimate.
    #[inline(always)]
    pub fn estimate(&self) -> &Estimate<R, V> {
        &self.estimate
    }

    #[inline(always)]
    fn predicted(&self, qdd: &[R; V]) -> Estimate<R, V> {
        let mut next = self.estimate;
        for ((q, qd), &qdd) in next.q.iter_mut().zip(&mut next.qd).zip(qdd) {
            *q += self.tick * *qd + self.half_tick_squared * qdd;
            *qd += self.tick * qdd;
        }
        next
    }

    /// Every input reaches the sums, so that their finiteness vouches for all of them.
    #[inline(always)]
    fn keep(&mut self, next: Estimate<R, V>) -> Estimate<R, V> {
        if all_finite(&next.q) & all_finite(&next.qd) {
            self.estimate = next;
        }
        self.estimate
    }
}
