//! Why way-points make no trajectory.

use core::fmt;

/// The reason why way-points define no trajectory. Points and joints are numbered from 0; a segment
/// has the number of the point that ends it.
///
/// ```
/// use motion_control::reference::TrajectoryError;
/// let error = TrajectoryError::Velocity { point: 2, joint: 3, needed: 3.5, allowed: 3.0 };
/// assert_eq!(
///     format!("{error}"),
///     "way-point 2, joint 3: needs a speed of 3.5000, 3.0000 allowed"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TrajectoryError {
    /// The length of a tick is not a positive number.
    Tick,
    /// A position or velocity is not finite.
    NotFinite {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
    },
    /// The velocity at the first or the last way-point is not zero.
    NotAtRest {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
    },
    /// The number of ticks to the point is zero (for the first point: not zero), or the total
    /// exceeds a `u32`.
    Ticks {
        /// The way-point.
        point: usize,
    },
    /// The speed that the joint needs exceeds its limit.
    Velocity {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
        /// The greatest |q̇| before the point, rad/s or m/s.
        needed: f64,
        /// The limit.
        allowed: f64,
    },
    /// The acceleration that the joint needs exceeds its limit.
    Acceleration {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
        /// The greatest |q̈| before the point, rad/s² or m/s².
        needed: f64,
        /// The limit.
        allowed: f64,
    },
}

impl fmt::Display for TrajectoryError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Tick => write!(out, "the length of a tick is not a positive number"),
            Self::NotFinite { point, joint } => {
                write!(out, "way-point {point}, joint {joint}: position or velocity is not finite")
            }
            Self::NotAtRest { point, joint } => write!(
                out,
                "way-point {point}, joint {joint}: the first and the last way-point have to stop"
            ),
            Self::Ticks { point: 0 } => write!(out, "way-point 0: its ticks are not 0"),
            Self::Ticks { point } => {
                write!(out, "way-point {point}: no ticks to get there, or more than 2^32 in total")
            }
            Self::Velocity { point, joint, needed, allowed } => write!(
                out,
                "way-point {point}, joint {joint}: needs a speed of {needed:.4}, {allowed:.4} \
                 allowed"
            ),
            Self::Acceleration { point, joint, needed, allowed } => write!(
                out,
                "way-point {point}, joint {joint}: needs an acceleration of {needed:.4}, \
                 {allowed:.4} allowed"
            ),
        }
    }
}

impl core::error::Error for TrajectoryError {}
