//! The kernel of sines and cosines that a scalar brings itself.

use super::Real;
use crate::trig::Kernel;

/// The scalar's own kernel, [`Real::sin_cos`]: the default.
#[derive(Clone, Copy, Debug)]
pub struct Native;

impl<R: Real> Kernel<R> for Native {
    #[cfg_attr(optimised, inline(always))]
    fn sin_cos(x: R) -> (R, R) {
        x.sin_cos()
    }
    #[cfg_attr(optimised, inline(always))]
    fn sin_cos_near(x: R) -> (R, R) {
        x.sin_cos_near()
    }
}
