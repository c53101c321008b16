//! Why way-points make no path.

use core::fmt;

/// The reason why way-points make no path. Points and joints are numbered from 0.
///
/// ```
/// use motion_control::reference::{PathSpline, PathSplineError};
/// let mut path = PathSpline::<f32, 1, 4>::EMPTY;
/// let error = path.fit(&[[0.0], [0.1], [0.1]], &[0.1], &[0.0]).unwrap_err();
/// assert_eq!(error, PathSplineError::Coincident { point: 2 });
/// assert_eq!(error.to_string(), "way-point 2 is where the one before it is");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PathSplineError {
    /// There are fewer than two way-points.
    TooFew,
    /// There are more way-points than the path can have.
    TooMany,
    /// A position is not finite.
    NotFinite {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
    },
    /// A way-point is where the one before it is, up to rounding of the path's length.
    Coincident {
        /// The way-point.
        point: usize,
    },
    /// A tolerance is negative or NaN.
    Tolerance {
        /// The joint.
        joint: usize,
    },
    /// Lengths in spacings overflow, or a spacing is not a positive number.
    TooLong,
}

impl fmt::Display for PathSplineError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooFew => out.write_str("there are fewer than two way-points"),
            Self::TooMany => out.write_str("there are more way-points than the path can have"),
            Self::NotFinite { point, joint } => {
                write!(out, "way-point {point}, joint {joint}: the position is not finite")
            }
            Self::Coincident { point } => {
                write!(out, "way-point {point} is where the one before it is")
            }
            Self::Tolerance { joint } => {
                write!(out, "joint {joint}: the tolerance is negative or not a number")
            }
            Self::TooLong => {
                out.write_str("the length of the path in spacings is not a finite number")
            }
        }
    }
}

impl core::error::Error for PathSplineError {}
