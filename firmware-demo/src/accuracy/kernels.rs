//! Sines and cosines: the library's kernels, and those of others.

use dynamics_core::scalar::Native;
use dynamics_core::trig::{Kernel, Minimax, Table};
use micromath::F32Ext;

/// A kernel with a name.
pub trait Named {
    /// On the axis `trig`; empty for the library's own, whichever it is.
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

macro_rules! named {
    ($($kernel:ty = $name:literal),*) => {$(
        impl Named for $kernel {
            const NAME: &'static str = $name;
        }
    )*};
}
named! {
    Minimax<3, 2> = "minimax3", Minimax<5, 2> = "minimax5", Minimax<7, 2> = "minimax7", Minimax<7, 3> = "minimax7x3",
    Table<256, 1> = "table", Table<256, 2> = "table2", Table<64, 4> = "table4",
    Table<128, 3> = "table3", Table<128, 3, 4> = "table3x4", Native = "", Libm = "libm", Micromath = "micromath"
}
