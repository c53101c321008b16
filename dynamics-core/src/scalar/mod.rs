//! The scalar of a computation, f32 or f64, with its vectors and matrices, which are glam's.
//!
//! All other modules use [`Real`] only, so that one source serves the firmware (f32), the host
//! tests (f64) and the reports that compare the two in one binary.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

pub use crate::math::exp_neg;
pub use native::Native;
pub use positive_part::positive_part;
pub use vector::{Matrix, Vector};

use crate::model::{Model, Robot};

mod native;
mod positive_part;
mod vector;

/// Public for scalars of the host's tools, such as several f32 side by side, whose every lane is
/// compared with f32.
#[doc(hidden)]
pub mod sealed {
    #[allow(missing_docs, reason = "not part of the public API")]
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A real number: `f32` on the target, `f64` for oracles.
///
/// Sealed: the tolerance table and the bit-identity tests cover these two.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + Send
    + Sync
    + 'static
{
    /// A vector of three: `glam::Vec3` or `glam::DVec3`.
    type Vec3: Vector<Self>;
    /// A 3×3 matrix: `glam::Mat3` or `glam::DMat3`.
    type Mat3: Matrix<Self>;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The limit of [`Real::trunc_saturating`]: 2³¹ in f32, 2⁶³ in f64.
    const MAX_TRUNC: f64;

    /// The nearest value of this type. Meant for constants: on an FPU without f64 the
    /// conversion of a run-time value is a call into software.
    fn from_f64(x: f64) -> Self;
    /// The same value in f64, exactly.
    fn to_f64(self) -> f64;
    /// (sin, cos) of an angle in rad: [`crate::trig::sin_cos`] or [`crate::trig::sin_cos_f64`].
    ///
    /// Cost: the same instructions for every input; [`crate::trig`] has range and error.
    fn sin_cos(self) -> (Self, Self);
    /// As `sin_cos`, for angles within ±100 rad: [`crate::trig::sin_cos_near`] in f32.
    fn sin_cos_near(self) -> (Self, Self);
    /// e⁻ˣ of x ≥ 0: [`crate::scalar::exp_neg`] in f32; 1 for x < 0 and for NaN.
    ///
    /// Cost: in f32 the same instructions for every input.
    fn exp_neg(self) -> Self;
    /// √x, rounded to nearest; NaN below zero. It is computed in software if the target has no
    /// instruction for it without std: not for the control tick.
    fn sqrt(self) -> Self;
    /// The angle of the point (x, self) from the x axis, rad, within ±π. Not for the control tick.
    fn atan2(self, x: Self) -> Self;
    /// The distance from 1 to the next number.
    const EPSILON: Self;
    /// The smallest positive normal number; added to a denominator, it avoids 0/0.
    const MIN_POSITIVE: Self;
    /// 1/√x of a positive normal number, within 2 ulp; no division, the same instructions for every
    /// x.
    fn rsqrt(self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// Whether the value is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// x limited to [lo, hi]; a NaN becomes `lo`. No branch, no panic if lo > hi.
    fn clamped(self, lo: Self, hi: Self) -> Self;
    /// The whole number next to x towards zero, within ±[`Real::MAX_TRUNC`]; a NaN becomes 0.
    ///
    /// Cost: two conversions, which saturate; there is no comparison that waits for the FPU's
    /// flags.
    fn trunc_saturating(self) -> Self;
    /// The whole number next to x towards zero, within 0 and 2³² − 1; a NaN becomes 0.
    ///
    /// Cost: one conversion, which saturates. By way of [`Real::to_f64`] it would be calls into
    /// software.
    fn to_u32(self) -> u32;
    /// A model cast to this type.
    fn cast<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
    ) -> Model<Self, B, Q, V>;
    /// The model of a robot known at compile time, cast to this type.
    fn model<T, const B: usize, const Q: usize, const V: usize>() -> &'static Model<Self, B, Q, V>
    where
        T: Robot<B, Q, V>;
    /// `yes` if `condition`, else `no`, without a branch.
    fn either(condition: bool, yes: Self, no: Self) -> Self;
    /// Selects this type's value from two, the first for f64 and the second for f32.
    fn select(double: f64, single: f32) -> Self;
}

macro_rules! real {
    ($r:ident, $whole:ident, $bits:ident, $vec:path, $mat:path, $sin_cos:expr, $near:expr, $exp_neg:expr, $sqrt:expr, $atan2:expr, $magic:literal, $steps:literal, $model:ident, $cast:expr, |$double:ident, $single:ident| $pick:ident) => {
        impl Real for $r {
            type Vec3 = $vec;
            type Mat3 = $mat;
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const MAX_TRUNC: f64 = -($whole::MIN as f64);
            #[cfg_attr(optimised, inline(always))]
            fn from_f64(x: f64) -> Self {
                x as $r
            }
            #[cfg_attr(optimised, inline(always))]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[cfg_attr(optimised, inline(always))]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }
            #[cfg_attr(optimised, inline(always))]
            fn sin_cos_near(self) -> (Self, Self) {
                $near(self)
            }
            #[cfg_attr(optimised, inline(always))]
            fn exp_neg(self) -> Self {
                $exp_neg(self)
            }
            #[inline]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                $atan2(self, x)
            }
            const EPSILON: Self = <$r>::EPSILON;
            const MIN_POSITIVE: Self = <$r>::MIN_POSITIVE;
            #[cfg_attr(optimised, inline(always))]
            fn rsqrt(self) -> Self {
                // Halves the exponent, then Newton's iteration for 1/y² = x. The bits of a NaN may
                // become anything.
                let halved = self.to_bits() >> 1;
                let mut y = <$r>::from_bits(halved.wrapping_neg().wrapping_add($magic));
                let half = 0.5 * self;
                for _ in 0..$steps {
                    y += y * (0.5 - half * y * y);
                }
                y
            }
            #[cfg_attr(optimised, inline(always))]
            fn abs(self) -> Self {
                <$r>::abs(self)
            }
            #[cfg_attr(optimised, inline(always))]
            fn is_finite(self) -> bool {
                <$r>::is_finite(self)
            }
            #[cfg_attr(optimised, inline(always))]
            fn clamped(self, lo: Self, hi: Self) -> Self {
                let x = if self > lo { self } else { lo };
                if x < hi { x } else { hi }
            }
            #[cfg_attr(optimised, inline(always))]
            fn trunc_saturating(self) -> Self {
                (self as $whole) as $r
            }
            #[cfg_attr(optimised, inline(always))]
            fn to_u32(self) -> u32 {
                self as u32
            }
            fn cast<const B: usize, const Q: usize, const V: usize>(
                model: &Model<f64, B, Q, V>,
            ) -> Model<Self, B, Q, V> {
                $cast(model)
            }
            #[cfg_attr(optimised, inline(always))]
            fn model<T, const B: usize, const Q: usize, const V: usize>()
            -> &'static Model<Self, B, Q, V>
            where
                T: Robot<B, Q, V>,
            {
                const { &T::$model }
            }
            #[cfg_attr(optimised, inline(always))]
            fn either(condition: bool, yes: Self, no: Self) -> Self {
                let mask = <$bits>::from(condition).wrapping_neg();
                <$r>::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
            }
            #[cfg_attr(optimised, inline(always))]
            fn select($double: f64, $single: f32) -> Self {
                let _ = ($double, $single);
                $pick
            }
        }
    };
}

real!(
    f32,
    i32,
    u32,
    glam::Vec3,
    glam::Mat3,
    crate::trig::sin_cos,
    crate::trig::sin_cos_near,
    exp_neg,
    libm::sqrtf,
    libm::atan2f,
    0x5f37_59df,
    3,
    MODEL_F32,
    Model::to_f32,
    |double, single| single
);
real!(
    f64,
    i64,
    u64,
    glam::DVec3,
    glam::DMat3,
    crate::trig::sin_cos_f64,
    crate::trig::sin_cos_f64,
    |x: f64| libm::exp(-f64::max(x, 0.0)),
    libm::sqrt,
    libm::atan2,
    0x5fe6_eb50_c7b5_37a9,
    4,
    MODEL,
    Model::clone,
    |double, single| double
);
