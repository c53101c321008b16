//! The limits of each joint, and what is wrong with them.

use core::fmt;

use super::MotionLimits;
use crate::model::JointLimits;
use crate::scalar::Real;

#[cfg(test)]
mod tests;

/// The limits of each joint that a [`Supervisor`](super::Supervisor) enforces.
///
/// They can be made from the [`JointLimits`] of a robot's description; the rate of the torque is then unlimited:
///
/// ```
/// use dynamics_core::control::SafetyLimits;
/// use dynamics_core::model::JointLimits;
/// let joint = JointLimits { lower: -3.1_f32, upper: 3.1, velocity: 3.2, torque: 150.0 };
/// let limits = SafetyLimits::from([joint; 6]).with_rate_share(0.5).with_position_margin(0.1);
/// assert_eq!((limits.rate[0], limits.speed[0], limits.upper[0]), (75.0, 3.2, 3.0));
/// ```
#[doc(alias = "soft limits")]
#[doc(alias = "Bounds")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SafetyLimits<R, const V: usize> {
    /// Greatest |τ|, N·m or N.
    pub torque: [R; V],
    /// Greatest change of τ from one tick to the next, N·m or N.
    pub rate: [R; V],
    /// Greatest |q̇|, rad/s or m/s.
    pub speed: [R; V],
    /// Least position, rad or m.
    pub lower: [R; V],
    /// Greatest position, rad or m.
    pub upper: [R; V],
}

impl<R: Real, const V: usize> From<[JointLimits<R>; V]> for SafetyLimits<R, V> {
    /// The joints' limits, of which none is on the rate of the torque.
    #[inline]
    fn from(limits: [JointLimits<R>; V]) -> Self {
        Self {
            torque: limits.map(|limit| limit.torque),
            rate: [R::ONE / R::ZERO; V],
            speed: limits.map(|limit| limit.velocity),
            lower: limits.map(|limit| limit.lower),
            upper: limits.map(|limit| limit.upper),
        }
    }
}

impl<R: Real> From<JointLimits<R>> for MotionLimits<R> {
    /// The joint's speed, and any acceleration.
    fn from(limits: JointLimits<R>) -> Self {
        Self {
            velocity: limits.velocity,
            acceleration: R::ONE / R::ZERO,
        }
    }
}

impl<R: Real, const V: usize> SafetyLimits<R, V> {
    /// The same limits with a rate of the torque, per tick, of this share of the torque limit.
    #[inline]
    pub fn with_rate_share(self, share: R) -> Self {
        Self {
            rate: self.torque.map(|torque| torque * share),
            ..self
        }
    }

    /// The same limits with a range of positions that is smaller by `margin` (rad or m) at both ends.
    pub fn with_position_margin(self, margin: R) -> Self {
        Self {
            lower: self.lower.map(|lower| lower + margin),
            upper: self.upper.map(|upper| upper - margin),
            ..self
        }
    }

    /// The same limits with speeds of this share of the joints' limits.
    pub fn with_speed_share(self, share: R) -> Self {
        Self {
            speed: self.speed.map(|speed| speed * share),
            ..self
        }
    }

    /// Checks that every limit allows some motion or torque, as [`super::Supervisor::try_new`] requires.
    ///
    /// Positions, speeds and rates may be unlimited (infinite), torques may not. Zero is a valid limit.
    ///
    /// ```
    /// use dynamics_core::control::{SafetyLimits, SafetyLimitsError, LimitKind};
    /// let limits = SafetyLimits { torque: [9.0, -9.0], rate: [1.0; 2], speed: [2.0; 2], lower: [-1.0; 2], upper: [1.0; 2] };
    /// let error = limits.check().unwrap_err();
    /// assert_eq!(error, SafetyLimitsError::Negative { joint: 1, of: LimitKind::Torque });
    /// assert_eq!(error.to_string(), "joint 1: its limit of torque is negative");
    /// ```
    ///
    /// # Errors
    /// [`SafetyLimitsError`] names the joint and the limit: NaN, negative, infinite for a torque, or a range of positions that
    /// is empty.
    pub fn check(&self) -> Result<(), SafetyLimitsError> {
        let limits = [
            (LimitKind::Torque, &self.torque),
            (LimitKind::Rate, &self.rate),
            (LimitKind::Speed, &self.speed),
        ];
        for (of, limits) in limits {
            for (joint, &limit) in limits.iter().enumerate() {
                if limit < R::ZERO {
                    return Err(SafetyLimitsError::Negative { joint, of });
                }
                // A NaN is not, a negative limit was refused.
                let is_number = limit >= R::ZERO;
                if !is_number || matches!(of, LimitKind::Torque) && !limit.is_finite() {
                    return Err(SafetyLimitsError::NotFinite { joint, of });
                }
            }
        }
        for (joint, (lower, upper)) in self.lower.iter().zip(&self.upper).enumerate() {
            if lower > upper {
                return Err(SafetyLimitsError::Empty { joint });
            }
            // A NaN compares with nothing.
            let is_range = lower <= upper;
            if !is_range {
                let of = LimitKind::Position;
                return Err(SafetyLimitsError::NotFinite { joint, of });
            }
        }
        Ok(())
    }
}

/// The quantity that a limit applies to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LimitKind {
    /// The torque.
    Torque,
    /// The torque's change in a tick.
    Rate,
    /// The speed.
    Speed,
    /// The position.
    Position,
}

impl fmt::Display for LimitKind {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Torque => "torque",
            Self::Rate => "the torque's rate",
            Self::Speed => "speed",
            Self::Position => "position",
        })
    }
}

/// The reason why the limits of a joint are rejected. Joints are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SafetyLimitsError {
    /// A limit is NaN, or that of a torque infinite.
    NotFinite {
        /// The joint.
        joint: usize,
        /// The quantity.
        of: LimitKind,
    },
    /// A limit is negative.
    Negative {
        /// The joint.
        joint: usize,
        /// The quantity.
        of: LimitKind,
    },
    /// The least position is above the greatest.
    Empty {
        /// The joint.
        joint: usize,
    },
}

impl SafetyLimitsError {
    /// The joint.
    pub const fn joint(&self) -> usize {
        match *self {
            Self::NotFinite { joint, .. }
            | Self::Negative { joint, .. }
            | Self::Empty { joint } => joint,
        }
    }
}

impl fmt::Display for SafetyLimitsError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite { joint, of } => {
                write!(
                    out,
                    "joint {joint}: its limit of {of} is not a finite number"
                )
            }
            Self::Negative { joint, of } => {
                write!(out, "joint {joint}: its limit of {of} is negative")
            }
            Self::Empty { joint } => {
                write!(
                    out,
                    "joint {joint}: its least position is above its greatest"
                )
            }
        }
    }
}

impl core::error::Error for SafetyLimitsError {}
