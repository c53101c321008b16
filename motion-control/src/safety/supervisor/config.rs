//! The configuration of a supervisor.

use crate::limits::{ConfigError, ConfigParameter, SafetyLimits};
use dynamics_core::scalar::Real;

/// The parameters of a [`Supervisor`](super::Supervisor): those of the arm and of the loop.
///
/// ```
/// use motion_control::{SafetyLimits, SupervisorConfig};
/// let config = SupervisorConfig {
///     limits: SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
///     tick: 1e-3,
///     resolution: core::f32::consts::TAU / 16_384.0, // 14 bits
///     ride_through_ticks: 5,
///     hold_ticks: 100,
///     reentry_ticks: 200,
/// };
/// assert_eq!(config.check(), Ok(()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SupervisorConfig<R, const V: usize> {
    /// The limits of each joint.
    pub limits: SafetyLimits<R, V>,
    /// Nominal length of a tick, s.
    pub tick: R,
    /// Step of the encoders, rad or m, by which a slow joint may seem to exceed its greatest speed; zero for none.
    pub resolution: R,
    /// Ticks with a fault for which the arm stays in [`Mode::Full`](super::Mode::Full): the prediction of an observer
    /// replaces the measurements, and the last torque replaces a torque that is not finite. Excessive speed has no
    /// ride-through.
    pub ride_through_ticks: u32,
    /// Ticks with a fault after those for which the arm is held, before it is stopped.
    pub hold_ticks: u32,
    /// Consecutive ticks without a fault after which earlier faults are no longer counted, and ticks of the return to
    /// the trajectory.
    pub reentry_ticks: u32,
}

impl<R: Real, const V: usize> SupervisorConfig<R, V> {
    /// Checks that every number is within its range and that every limit allows some motion or torque.
    ///
    /// # Errors
    /// [`ConfigError`]; if a limit is wrong, with the joint, the limit and its value.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::Tick.positive(self.tick)?;
        let step = self.resolution;
        ConfigParameter::Resolution.require(step.is_finite() & (step >= R::ZERO))?;
        Ok(self.limits.check()?)
    }
}
