//! Sines and cosines: the library's kernels, and those of others.

use dynamics_core::trig::{Kernel, Minimax, Table};
use micromath::F32Ext;

/// A kernel with a name.
pub trait Named: Kernel<f32> {
    /// On the axis `trig`.
    const NAME: &'static str;
}

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

macro_rules! words {
    ($($axis:ident $value:literal [$($kernel:ty)?] $name:literal, $phrase:literal;)*) => {$($(
        impl Named for $kernel {
            const NAME: &'static str = $value;
        }
    )?)*};
}
include!("words.rs");
