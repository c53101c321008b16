//! Why a path has no motion.

use core::fmt;

use crate::limits::LimitKind;

/// The reason why there is no motion along a path. Joints and points of the grid are numbered from
/// 0.
///
/// ```
/// use motion_control::reference::TimedPathError;
/// let error = TimedPathError::Torque { point: 12, joint: 1, needed: 161.2, allowed: 150.0 };
/// assert_eq!(
///     error.to_string(),
///     "grid point 12, joint 1: gravity and friction need a torque of 161.2000, 150.0000 allowed"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TimedPathError {
    /// The length of a tick is not a positive number.
    Tick,
    /// A limit of torque is not a positive finite number.
    TorqueLimit {
        /// The joint.
        joint: usize,
        /// The limit, N·m or N.
        value: f64,
    },
    /// A limit of speed or acceleration is not a positive number.
    MotionLimit {
        /// The joint.
        joint: usize,
        /// Which of the two.
        of: LimitKind,
        /// The limit, rad and s or m and s.
        value: f64,
    },
    /// A friction is negative or not finite, or more of it is certain than there is.
    Friction {
        /// The joint.
        joint: usize,
    },
    /// The path or the inverse dynamics is not finite.
    NotFinite {
        /// The point of the grid.
        point: usize,
        /// The joint.
        joint: usize,
    },
    /// The inverse dynamics changes with the sign of the velocities: friction belongs into the
    /// limits.
    SignOfVelocity {
        /// The point of the grid.
        point: usize,
        /// The joint.
        joint: usize,
    },
    /// Gravity and friction alone need more than 999/1000 of the torque's limit in a slow motion:
    /// the arm could not stop there, or not move on.
    Torque {
        /// The point of the grid.
        point: usize,
        /// The joint.
        joint: usize,
        /// Their torque, N·m or N.
        needed: f64,
        /// The limit.
        allowed: f64,
    },
    /// The motion does not get from this point to the next one: what is left of a limit of torque
    /// is lost to rounding.
    Stuck {
        /// The point of the grid.
        point: usize,
    },
    /// The motion has more ticks than can be counted.
    TooLong,
}

impl fmt::Display for TimedPathError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Tick => out.write_str("the length of a tick is not a positive number"),
            Self::TorqueLimit { joint, value } => {
                let value = value as f32;
                write!(
                    out,
                    "joint {joint}: its limit of torque, {value}, is not a positive finite number"
                )
            }
            Self::MotionLimit { joint, of, value } => {
                let value = value as f32;
                write!(out, "joint {joint}: its {of}, {value}, is not a positive number")
            }
            Self::Friction { joint } => write!(
                out,
                "joint {joint}: its friction is negative or not finite, or more of it is certain \
                 than there is"
            ),
            Self::NotFinite { point, joint } => write!(
                out,
                "grid point {point}, joint {joint}: the path or the inverse dynamics is not finite"
            ),
            Self::SignOfVelocity { point, joint } => write!(
                out,
                "grid point {point}, joint {joint}: there is friction in the inverse dynamics"
            ),
            Self::Torque { point, joint, needed, allowed } => write!(
                out,
                "grid point {point}, joint {joint}: gravity and friction need a torque of \
                 {needed:.4}, {allowed:.4} allowed"
            ),
            Self::Stuck { point } => {
                write!(out, "grid point {point}: the limits leave no torque to move on")
            }
            Self::TooLong => out.write_str("the motion has more ticks than can be counted"),
        }
    }
}

impl core::error::Error for TimedPathError {}
