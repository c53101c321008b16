//! Sines and cosines of other crates.

use dynamics_core::trig::Kernel;
use micromath::F32Ext;

/// The crate `libm`, which computes single precision in f64 inside.
#[derive(Clone, Copy, Debug)]
pub struct Libm;

impl Kernel<f32> for Libm {
    #[inline(always)]
    fn sin_cos(x: f32) -> (f32, f32) {
        (libm::sinf(x), libm::cosf(x))
    }
}

/// The crate `micromath`, whose sine is its cosine a quarter turn on.
#[derive(Clone, Copy, Debug)]
pub struct Micromath;

impl Kernel<f32> for Micromath {
    #[inline(always)]
    fn sin_cos(x: f32) -> (f32, f32) {
        (F32Ext::sin(x), F32Ext::cos(x))
    }
}
