//! A path of the joints without time.

use crate::real;
use dynamics_core::scalar::Real;

/// Positions and their derivatives by the path parameter s at one point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PathPoint<R, const V: usize> {
    /// Positions q, rad or m.
    pub q: [R; V],
    /// q′ = dq/ds, rad or m.
    pub slope: [R; V],
    /// q″ = d²q/ds², rad or m.
    pub curvature: [R; V],
}

/// A path q(s) of V joints for 0 ≤ s ≤ 1, of which q″ is continuous: what
/// [`TimedPath`](crate::reference::TimedPath) gives a time.
///
/// ```
/// use motion_control::reference::{GeometricPath, PathPoint};
/// /// A straight line of two joints.
/// struct Line([f64; 2]);
/// impl GeometricPath<f64, 2> for Line {
///     fn point(&self, s: f64) -> PathPoint<f64, 2> {
///         PathPoint { q: self.0.map(|q| q * s), slope: self.0, curvature: [0.0; 2] }
///     }
/// }
/// assert_eq!(Line([1.0, -2.0]).point(0.5).q, [0.5, -1.0]);
/// assert_eq!(Line([1.0, -2.0]).grid_point(1, 4), 0.25);
/// ```
pub trait GeometricPath<R: Real, const V: usize> {
    /// The point at s.
    fn point(&self, s: R) -> PathPoint<R, V>;

    /// s of a point of a grid with this number of segments: from 0 to 1, in ascending order. There
    /// should be a point wherever q″ has a corner.
    fn grid_point(&self, point: usize, segments: usize) -> R {
        if point < segments { real::<R>(point as u32) / real(segments as u32) } else { R::ONE }
    }
}
