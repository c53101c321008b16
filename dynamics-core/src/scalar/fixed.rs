//! Fixed point, for comparison: what processors without an FPU use.
//!
//! Products are summed in 64 bits (SMULL, SMLAL) and rounded once. Every quantity has the same scale, so units have to
//! be chosen that keep all of them within ±2: [`Model::in_units`] makes a robot in such units. Yates, *Fixed-Point
//! Arithmetic: An Introduction* (2009).

use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use super::plain::{Mat3, Plain, Vec3, assigning};
use super::{Real, sealed};
use crate::model::{Model, Robot};
use crate::trig::Kernel;

/// A number within ±2 in steps of 2⁻³⁰: Q31 with the bit of headroom that 1 takes. What overflows wraps.
///
/// ```
/// use dynamics_core::scalar::{Fixed, Real};
/// let half = Fixed::from_f64(0.5);
/// assert_eq!((half * half + half).to_f64(), 0.75);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Fixed(i32);

/// Bits behind the point.
const FRACTION: u32 = 30;

impl Fixed {
    /// The nearest one to an f64.
    pub(crate) const fn new(x: f64) -> Self {
        let scaled = x * (1_i64 << FRACTION) as f64;
        Self((scaled + if scaled < 0.0 { -0.5 } else { 0.5 }) as i32)
    }
}

impl Add for Fixed {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self(self.0.wrapping_add(o.0))
    }
}

impl Mul for Fixed {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self::products([(self, o)])
    }
}

impl Div for Fixed {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let dividend = i64::from(self.0) * (1 << FRACTION);
        // A divisor of 0 gives 0: there is nothing to wrap.
        Self(dividend.checked_div(i64::from(o.0)).unwrap_or(0) as i32)
    }
}

impl Neg for Fixed {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

assigning!(Fixed);

impl Plain for Fixed {
    #[inline(always)]
    fn products<const K: usize>(terms: [(Self, Self); K]) -> Self {
        const HALF: i64 = 1 << (FRACTION - 1);
        let mut sum = HALF;
        for (a, b) in terms {
            sum = sum.wrapping_add(i64::from(a.0) * i64::from(b.0));
        }
        Self((sum >> FRACTION) as i32)
    }
}

/// Sine and cosine of angles in half turns, within ±2 of them: 1 is π. Error 5·10⁻⁹.
///
/// The polynomials are those of [`crate::trig::Minimax`] of degree 7. The same instructions whatever the angle.
///
/// ```
/// use dynamics_core::scalar::{Fixed, HalfTurns, Real};
/// use dynamics_core::trig::Kernel;
/// let (s, c) = HalfTurns::sin_cos(Fixed::from_f64(0.25));
/// assert!((s.to_f64() - 0.5_f64.sqrt()).abs() < 5e-9 && (c.to_f64() - 0.5_f64.sqrt()).abs() < 5e-9);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct HalfTurns;

impl Kernel<Fixed> for HalfTurns {
    #[inline(always)]
    fn sin_cos(x: Fixed) -> (Fixed, Fixed) {
        const SIN: [Fixed; 3] = [
            Fixed::new(-0.166_666_55),
            Fixed::new(0.008_332_174),
            Fixed::new(-0.000_195_156_54),
        ];
        const COS: [Fixed; 3] = [
            Fixed::new(0.041_666_653),
            Fixed::new(-0.001_388_761_9),
            Fixed::new(2.446_341_2e-5),
        ];
        // A quarter turn is 2²⁹; beyond ±2 the bits above wrap, and so do angles.
        const QUARTER: u32 = FRACTION - 1;
        let k = x.0.wrapping_add(1 << (QUARTER - 1)) >> QUARTER;
        // The rest in quarter turns fits with two bits to spare: r = π/2 of it.
        let rest = Fixed(x.0.wrapping_sub(k << QUARTER) << 1);
        let r = rest * const { Fixed::new(core::f64::consts::FRAC_PI_2) };
        let u = r * r;
        let s = r + r * (u * (SIN[0] + u * (SIN[1] + u * SIN[2])));
        let c = COS[0] + u * (COS[1] + u * COS[2]);
        let c = Fixed::ONE + u * (const { Fixed::new(-0.5) } + u * c);
        match k & 3 {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        }
    }
}

impl sealed::Sealed for Fixed {}

impl Real for Fixed {
    type Vec3 = Vec3<Self>;
    type Mat3 = Mat3<Self>;
    const ZERO: Self = Self(0);
    const ONE: Self = Self(1 << FRACTION);
    const MAX_TRUNC: f64 = 2.0;
    const EPSILON: Self = Self(1);
    const MIN_POSITIVE: Self = Self(1);

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::new(x)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self.0) / (1_i64 << FRACTION) as f64
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        HalfTurns::sin_cos(self * const { Self::new(core::f64::consts::FRAC_1_PI) })
    }
    #[inline(always)]
    fn sin_cos_near(self) -> (Self, Self) {
        self.sin_cos()
    }
    fn exp_neg(self) -> Self {
        Self::new(self.to_f64().exp_neg())
    }
    fn sqrt(self) -> Self {
        Self::new(self.to_f64().sqrt())
    }
    fn atan2(self, x: Self) -> Self {
        Self::new(self.to_f64().atan2(x.to_f64()))
    }
    fn rsqrt(self) -> Self {
        Self::new(self.to_f64().rsqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.wrapping_abs())
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        true
    }
    #[inline(always)]
    fn clamped(self, lo: Self, hi: Self) -> Self {
        let x = if self > lo { self } else { lo };
        if x < hi { x } else { hi }
    }
    #[inline(always)]
    fn trunc_saturating(self) -> Self {
        Self(self.0 / Self::ONE.0 * Self::ONE.0)
    }
    fn cast<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
    ) -> Model<Self, B, Q, V> {
        model.to_fixed()
    }
    #[inline(always)]
    fn model<T, const B: usize, const Q: usize, const V: usize>() -> &'static Model<Self, B, Q, V>
    where
        T: Robot<B, Q, V>,
    {
        const { &T::MODEL.to_fixed() }
    }
    #[inline(always)]
    fn select(double: f64, _: f32) -> Self {
        Self::new(double)
    }
}
