//! The limits of each joint, and what is wrong with them.

use core::fmt;

use crate::scalar::Real;

/// The limits of each joint.
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

impl<R: Real, const V: usize> SafetyLimits<R, V> {
    /// Whether every limit allows something: what [`super::Supervisor::try_new`] takes.
    ///
    /// Positions, speeds and rates may be unlimited (infinite), torques may not. Zero is a limit like others.
    ///
    /// ```
    /// use dynamics_core::control::{SafetyLimits, SafetyLimitsError, LimitKind};
    /// let bounds = SafetyLimits { torque: [9.0, -9.0], rate: [1.0; 2], speed: [2.0; 2], lower: [-1.0; 2], upper: [1.0; 2] };
    /// let error = bounds.check().unwrap_err();
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

/// What a limit is of.
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

/// What is wrong with the limits of a joint. Joints count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SafetyLimitsError {
    /// A limit is NaN, or that of a torque infinite.
    NotFinite {
        /// The joint.
        joint: usize,
        /// What the limit is of.
        of: LimitKind,
    },
    /// A limit is negative.
    Negative {
        /// The joint.
        joint: usize,
        /// What the limit is of.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{Fault, Mode, Supervisor};

    const GOOD: SafetyLimits<f32, 2> = SafetyLimits {
        torque: [10.0, 0.0],
        rate: [4.0, f32::INFINITY],
        speed: [2.0, f32::INFINITY],
        lower: [-1.0, f32::NEG_INFINITY],
        upper: [1.0, f32::INFINITY],
    };

    fn with(of: LimitKind, limit: f32) -> SafetyLimits<f32, 2> {
        let mut bounds = GOOD;
        let limits = match of {
            LimitKind::Torque => &mut bounds.torque,
            LimitKind::Rate => &mut bounds.rate,
            LimitKind::Speed => &mut bounds.speed,
            LimitKind::Position => &mut bounds.upper,
        };
        limits[1] = limit;
        bounds
    }

    #[test]
    fn limits_that_allow_nothing_are_refused_by_joint_and_name() {
        assert_eq!(GOOD.check(), Ok(()));
        let joint = 1;
        for of in [LimitKind::Torque, LimitKind::Rate, LimitKind::Speed] {
            let negative = SafetyLimitsError::Negative { joint, of };
            assert_eq!(with(of, -1.0).check(), Err(negative));
            assert_eq!(with(of, f32::NEG_INFINITY).check(), Err(negative));
            let none = SafetyLimitsError::NotFinite { joint, of };
            assert_eq!(with(of, f32::NAN).check(), Err(none));
        }
        let of = LimitKind::Torque;
        let endless = SafetyLimitsError::NotFinite { joint, of };
        assert_eq!(with(of, f32::INFINITY).check(), Err(endless));
        let of = LimitKind::Position;
        let none = SafetyLimitsError::NotFinite { joint, of };
        assert_eq!(with(of, f32::NAN).check(), Err(none));
        let mut bounds = with(of, -1.0);
        bounds.lower[1] = f32::NAN;
        assert_eq!(bounds.check(), Err(none));
        bounds.lower[1] = -0.5;
        assert_eq!(bounds.check(), Err(SafetyLimitsError::Empty { joint }));
        bounds.lower[1] = -1.0;
        assert_eq!(bounds.check(), Ok(()));
    }

    #[test]
    fn an_arm_with_such_limits_is_stopped_and_says_why_instead_of_going_limp() {
        for of in [
            LimitKind::Torque,
            LimitKind::Rate,
            LimitKind::Speed,
            LimitKind::Position,
        ] {
            let bounds = with(of, f32::NAN);
            let error = Supervisor::try_new(bounds, 0.01, 3, 4).unwrap_err();
            assert_eq!(error.joint(), 1);
            let mut supervisor = Supervisor::new(bounds, 0.01, 3, 4);
            for _ in 0..3 {
                assert_eq!(supervisor.admit(Ok(&[0.0; 2])), Mode::Stopped);
                let command = supervisor.pass(&[1.0, 0.0]);
                assert_eq!((command.torque, command.brake), ([0.0; 2], true));
                assert_eq!(command.status.fault, Some(Fault::Limits { joint: 1 }));
                supervisor.reset();
            }
        }
        let mut supervisor =
            Supervisor::try_new(GOOD, 0.01, 3, 4).expect("limits that allow something");
        assert_eq!(supervisor.admit(Ok(&[0.0; 2])), Mode::Full);
    }
}
