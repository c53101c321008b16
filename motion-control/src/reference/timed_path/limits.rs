//! The limits of a motion along a path.

use super::TimedPathError;
use crate::limits::{LimitKind, MotionLimits, SafetyLimits};
use dynamics_core::scalar::Real;

/// The limits of V joints in a motion along a path.
///
/// ```
/// use motion_control::limits::MotionLimits;
/// use motion_control::reference::{JointFriction, PathLimits, TimedPathError};
/// let limits = PathLimits {
///     torque: [150.0, 28.0],
///     motion: [MotionLimits { velocity: 3.0, acceleration: 20.0 }; 2],
///     friction: [JointFriction { coulomb: 5.0, viscous: 8.0, certain: 0.5 }; 2],
/// };
/// assert_eq!(limits.check(), Ok(()));
/// let error = PathLimits { torque: [150.0, 0.0], ..limits }.check().unwrap_err();
/// assert_eq!(error, TimedPathError::TorqueLimit { joint: 1, value: 0.0 });
/// assert_eq!(error.to_string(), "joint 1: its limit of torque, 0, is not a positive finite number");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PathLimits<R, const V: usize> {
    /// Greatest |τ|, N·m or N: less than that of the supervisor by what the feedback needs.
    pub torque: [R; V],
    /// Greatest speeds and accelerations, which may be infinite.
    pub motion: [MotionLimits<R>; V],
    /// Friction.
    pub friction: [JointFriction<R>; V],
}

/// Friction of a joint in a motion along a path.
///
/// Friction against the motion counts in full where it makes the torque greater. If it makes it
/// smaller, as when the joint brakes, only the share `certain` counts: friction varies with
/// temperature, and vanishes smoothly near rest. If the joint reverses within a segment of the
/// grid, friction counts in both directions. Viscous friction is linear in ṡ = √x: above, the
/// tangent of √x takes its place, below a chord, so that torques remain linear in x and their
/// bounds are never exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct JointFriction<R> {
    /// Coulomb friction, N·m or N.
    pub coulomb: R,
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub viscous: R,
    /// The share of both that counts where it relieves the motor, 0 to 1; zero is on the safe side.
    pub certain: R,
}

impl<R: Real> JointFriction<R> {
    /// No friction.
    pub const NONE: Self = Self { coulomb: R::ZERO, viscous: R::ZERO, certain: R::ZERO };
}

impl<R: Real, const V: usize> From<SafetyLimits<R, V>> for PathLimits<R, V> {
    /// The same torques and speeds, any acceleration, and no friction.
    fn from(limits: SafetyLimits<R, V>) -> Self {
        Self {
            torque: limits.torque,
            motion: limits
                .speed
                .map(|velocity| MotionLimits { velocity, acceleration: R::ONE / R::ZERO }),
            friction: [JointFriction::NONE; V],
        }
    }
}

impl<R: Real, const V: usize> PathLimits<R, V> {
    /// The same limits with this share of the torques, which leaves the rest to the feedback.
    ///
    /// ```
    /// use motion_control::{limits::SafetyLimits, reference::PathLimits};
    /// let safety = SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let limits = PathLimits::from(safety.with_speed_share(0.5)).with_torque_share(0.8);
    /// assert_eq!((limits.torque, limits.motion[0].velocity), ([8.0], 1.5));
    /// ```
    #[must_use]
    pub fn with_torque_share(self, share: R) -> Self {
        Self { torque: self.torque.map(|torque| torque * share), ..self }
    }

    /// Checks that torques are positive and finite, speeds and accelerations positive, and
    /// frictions finite and not negative.
    ///
    /// # Errors
    /// [`TimedPathError`] names the joint, the limit and its value.
    pub fn check(&self) -> Result<(), TimedPathError> {
        let zero = R::ZERO;
        for (joint, &torque) in self.torque.iter().enumerate() {
            if !(torque.is_finite() & (torque > zero)) {
                let value = torque.to_f64();
                return Err(TimedPathError::TorqueLimit { joint, value });
            }
        }
        for (joint, limit) in self.motion.iter().enumerate() {
            let both =
                [(LimitKind::Speed, limit.velocity), (LimitKind::Acceleration, limit.acceleration)];
            for (of, limit) in both {
                // Written so that a NaN is refused, too.
                let allows = limit > zero;
                if !allows {
                    let value = limit.to_f64();
                    return Err(TimedPathError::MotionLimit { joint, of, value });
                }
            }
        }
        for (joint, friction) in self.friction.iter().enumerate() {
            let JointFriction { coulomb, viscous, certain } = *friction;
            let numbers = [coulomb, viscous, certain];
            let valid = numbers.iter().all(|x| x.is_finite() & (*x >= zero));
            if !valid || certain > R::ONE {
                return Err(TimedPathError::Friction { joint });
            }
        }
        Ok(())
    }
}
