//! max(0, x) without a comparison.

use crate::scalar::Real;

/// max(0, x) = (x + |x|) / 2, exact: contacts push and never pull.
///
/// ```
/// use dynamics_core::scalar::positive_part;
/// assert_eq!((positive_part(3.0_f32), positive_part(-3.0_f32)), (3.0, 0.0));
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn positive_part<R: Real>(x: R) -> R {
    R::from_f64(0.5) * (x + x.abs())
}
