//! The external torques of the joints from their momentum, without accelerations and without the
//! inverse of M.
//!
//! De Luca & Mattone (2003); Haddadin, De Luca & Albu-Schäffer, "Robot collisions: a survey"
//! (2017), (43) to (47). In continuous time ṙ = K (τ_ext − r); here exactly for torques that are
//! constant over a tick:
//!
//! ```text
//! ṗ = τ + β + τ_ext                 β = Cᵀ q̇ − g − F, the drift
//! m = (p − p⁻)/h − τ − ½ (β + β⁻)   the mean of τ_ext since the last measurement
//! r = r⁻ + (1 − exp(−K h)) (m − r⁻)
//! ```

use core::hint::black_box;

use crate::entry;
use crate::estimate::ObserverConfig;
use crate::estimate::observer::one_less_decay;
use crate::limits::{ConfigError, Fault};
use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;

/// The external torques of V joints, by an observer of the generalised momentum; ORDER poles lie at
/// the bandwidth.
///
/// A first-order observer is the usual one; a second-order one passes less of the noise of the
/// velocities.
///
/// # Cost
/// 10 flops and 3 for each pole, for each joint, beside the model; a division after lost
/// measurements.
///
/// ```
/// use dynamics_core::algorithms::{MomentumAndDrift, momentum_and_drift, rnea};
/// use motion_control::estimate::{MomentumObserver, ObserverConfig};
/// use dynamics_core::{effects::Gravity, model::Robot, robots::Ur5e, state::State};
/// let mut observer: MomentumObserver<f64, 6> =
///     MomentumObserver::try_new(ObserverConfig { bandwidth: 50.0, tick: 1e-3 })?;
/// // The arm stands still although the drives push 3 N·m less than gravity: something supports its elbow.
/// let state = State::at([0.0, -1.0, 1.0, 0.0, 0.0, 0.0]);
/// let scene = Gravity::EARTH; // with friction: (Gravity::EARTH, viscous, coulomb)
/// let mut tau = rnea(&Ur5e::MODEL, &state, &scene);
/// tau[2] -= 3.0;
/// for _ in 0..200 {
///     let MomentumAndDrift { p, beta } = momentum_and_drift(&Ur5e::MODEL, &state, &scene);
///     observer.update(&p, &beta)?;
///     observer.drive(&tau);
/// }
/// assert!((observer.external_torque()[2] - 3.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "disturbance observer")]
#[doc(alias = "collision detection")]
#[doc(alias = "residual")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumObserver<R, const V: usize, const ORDER: usize = 1> {
    tick: R,
    /// 1/h.
    rate: R,
    /// 1 − exp(−K h).
    gap: R,
    /// exp(−K h n) of the n ticks since the last measurement.
    decay: R,
    /// n h.
    elapsed: R,
    /// The last momentum and the integral of the drives' torques over these ticks.
    driven: [R; V],
    beta: [R; V],
    residuals: [[R; V]; ORDER],
    started: bool,
}

impl<R: Real, const V: usize, const ORDER: usize> MomentumObserver<R, V, ORDER> {
    /// An observer without external torques; the first update sets the momentum.
    ///
    /// # Errors
    /// [`ConfigError`], as [`ObserverConfig::check`].
    pub fn try_new(config: ObserverConfig<R>) -> Result<Self, ConfigError> {
        const { assert!(ORDER == 1 || ORDER == 2, "the order is 1 or 2") };
        config.check()?;
        let ObserverConfig { bandwidth, tick } = config;
        Ok(Self {
            tick,
            rate: R::ONE / tick,
            gap: one_less_decay(bandwidth * tick),
            decay: R::ONE,
            elapsed: R::ZERO,
            driven: [R::ZERO; V],
            beta: [R::ZERO; V],
            residuals: [[R::ZERO; V]; ORDER],
            started: false,
        })
    }

    /// A tick with a measurement: the momentum p = M q̇ and β = Cᵀ q̇ − g − F of its positions and
    /// velocities, N·m·s and N·m.
    ///
    /// Both are those of [`momentum_and_drift`](dynamics_core::algorithms::momentum_and_drift())
    /// under the effects of the scene.
    ///
    /// # Errors
    /// [`Fault::NotFinite`] names the first joint with a number that is not finite; the measurement
    /// then counts as lost.
    #[inline]
    pub fn update(&mut self, p: &[R; V], beta: &[R; V]) -> Result<(), Fault> {
        if !sum(p, beta).is_finite() {
            cold();
            // Or the sum alone is too large.
            let mut numbers = p.iter().zip(beta);
            let joint = numbers.position(|(p, beta)| !(p.is_finite() & beta.is_finite()));
            if let Some(joint) = joint {
                return Err(Fault::NotFinite { joint });
            }
        }
        if let Some((share, rate)) = self.mean() {
            let half = R::from_f64(0.5);
            for i in 0..V {
                let model = half * (entry(beta, i) + entry(&self.beta, i));
                let change = entry(p, i) - entry(&self.driven, i);
                follow(&mut self.residuals, i, share, change * rate - model);
            }
        }
        (self.driven, self.beta, self.started) = (*p, *beta, true);
        (self.decay, self.elapsed) = (R::ONE, R::ZERO);
        Ok(())
    }

    /// 1 − exp(−K h n) of the next measurement; without a tick in between there is no mean.
    #[inline(always)]
    pub(crate) fn share(&self) -> Option<R> {
        self.mean().map(|(share, _)| share)
    }

    /// [`Self::share`], and 1/(n h).
    #[inline(always)]
    fn mean(&self) -> Option<(R, R)> {
        let rate = if self.elapsed == self.tick {
            Some(self.rate)
        } else {
            // Hidden, so that a tick without lost measurements does not divide, too.
            let elapsed = black_box(self.elapsed);
            (elapsed > R::ZERO).then(|| R::ONE / elapsed)
        };
        rate.filter(|_| self.started).map(|rate| (R::ONE - self.decay, rate))
    }

    /// The torques of the drives from this tick to the next, N·m or N: to be called once in each
    /// tick, also in one whose measurement is lost or rejected. The next measurement then gives the
    /// mean over all ticks since the last one.
    ///
    /// ```
    /// use motion_control::estimate::{MomentumObserver, ObserverConfig};
    /// let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    /// let mut observer: MomentumObserver<f64, 1> = MomentumObserver::try_new(config)?;
    /// observer.update(&[0.0], &[0.0])?;
    /// for _ in 0..3 {
    ///     observer.drive(&[2.0]); // two measurements are lost
    /// }
    /// observer.update(&[0.0], &[0.0])?; // the arm stands still: something takes 2 N·m
    /// assert!((observer.external_torque()[0] + 2.0 * (1.0 - (-0.15_f64).exp())).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// A torque that is not finite counts as none. With load-dependent friction it is the part that
    /// the gears [transmit](dynamics_core::algorithms::transmitted_torque()).
    #[inline]
    pub fn drive(&mut self, tau: &[R; V]) {
        let all = sum(tau, &[]).is_finite();
        for (driven, tau) in self.driven.iter_mut().zip(tau) {
            if all || tau.is_finite() {
                *driven += self.tick * *tau;
            }
        }
        self.elapsed += self.tick;
        self.decay -= self.decay * self.gap;
    }

    /// The external torques r of the joints, N·m or N: positive if they push as a positive torque
    /// of the drive does.
    #[inline]
    pub fn external_torque(&self) -> &[R; V] {
        let [.., last] = self.residuals.as_slice() else {
            return &self.driven;
        };
        last
    }

    /// The outermost joint whose |r| is beyond its threshold, N·m or N: a contact at its link, or
    /// further out where its force has no torque about the outer joints.
    ///
    /// ```
    /// use motion_control::estimate::{MomentumObserver, ObserverConfig};
    /// let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    /// let observer: MomentumObserver<f32, 6> = MomentumObserver::try_new(config)?;
    /// assert_eq!(observer.outermost(&[2.0; 6]), None);
    /// # Ok::<(), motion_control::limits::ConfigError>(())
    /// ```
    #[inline]
    pub fn outermost(&self, threshold: &[R; V]) -> Option<usize> {
        let mut joints = self.external_torque().iter().zip(threshold);
        joints.rposition(|(r, threshold)| r.abs() > *threshold)
    }

    /// Forgets the momentum and the external torques: after a stop, or at another load.
    ///
    /// ```
    /// # use motion_control::estimate::{MomentumObserver, ObserverConfig};
    /// # let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    /// let mut observer: MomentumObserver<f64, 1> = MomentumObserver::try_new(config)?;
    /// observer.update(&[0.0], &[0.0])?;
    /// observer.drive(&[2.0]);
    /// observer.update(&[0.0], &[0.0])?;
    /// observer.restart();
    /// observer.update(&[5.0], &[0.0])?; // the first measurement sets the momentum
    /// assert_eq!(observer.external_torque(), &[0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn restart(&mut self) {
        self.residuals = [[R::ZERO; V]; ORDER];
        (self.decay, self.elapsed) = (R::ONE, R::ZERO);
        self.started = false;
    }
}

/// Moves the filters of a joint by the share of a tick: each follows the one before, the first one
/// follows `input`.
#[inline(always)]
pub(crate) fn follow<R: Real, const V: usize>(
    filters: &mut [[R; V]],
    joint: usize,
    share: R,
    mut input: R,
) {
    for filter in filters {
        if let Some(value) = filter.get_mut(joint) {
            *value += share * (input - *value);
            input = *value;
        }
    }
}

/// The sum of all numbers, which is finite only if each of them is.
#[inline(always)]
fn sum<R: Real>(a: &[R], b: &[R]) -> R {
    // −0 is the number that changes no other by its addition.
    a.iter().chain(b).fold(R::from_f64(-0.0), |sum, &x| sum + x)
}

/// Marks what rarely happens.
#[cold]
#[inline]
fn cold() {}
