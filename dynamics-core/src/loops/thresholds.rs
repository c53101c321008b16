//! The distances from a singular configuration below which a machine is treated as singular.

use crate::math::const_eval as m;

/// The pivot, relative to the size of a loop, below which a row of K depends on those before it, in
/// f64 and in f32.
///
/// This is of the order of the root of the rounding error: a pivot p multiplies rounding errors by
/// 1/p, and where the product exceeds p itself, the rank is that of the rounding errors. Closer
/// than this to a singular configuration, in rad, a machine is treated as singular.
pub const RANK_TOLERANCE: (f64, f32) = (1e-7, 2e-3);

/// The distance ς from a singular configuration of the motors below which the passive coordinates
/// are damped, by default; see [`Loops::damped_below`](super::Loops::damped_below).
pub const SINGULAR: f64 = 5e-3;

/// ε in f64 and f32: a given threshold, and at least that below which elimination may leave a
/// passive coordinate without a pivot. With complete pivoting C rows of p columns have no pivot
/// that is less than their least singular value over √(C − p + 1).
pub(super) const fn thresholds(given: f64, rows: usize, passive: usize) -> (f64, f32) {
    let root = m::sqrt((rows.saturating_sub(passive) + 1) as f64);
    let (double, single) = (root * RANK_TOLERANCE.0, root as f32 * RANK_TOLERANCE.1);
    (given.max(double), (given as f32).max(single))
}
