//! f32 with the rounding error of every operation carried along: twice the digits, without f64.
//!
//! Two-sum: Knuth, *The Art of Computer Programming* 2 (1969), 4.2.2; two-product: Dekker, "A floating-point
//! technique for extending the available precision" (1971); pairs of them: Joldes, Muller & Popescu, "Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic" (2017). The FPU's fused
//! multiply-add would halve the product, but has no name in `core`.

use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use super::plain::{Mat3, Plain, Vec3, assigning};
use super::{Real, sealed};
use crate::model::{Model, Robot};

/// A number as the sum of an f32 and what rounding has taken from it: some 46 bits.
///
/// Errors are relative to the larger operand. No infinities: what overflows becomes NaN.
///
/// ```
/// use dynamics_core::scalar::{Compensated, Real};
/// let (one, small) = (Compensated::ONE, Compensated::from_f64(1e-9));
/// assert!(((one + small - one).to_f64() - 1e-9).abs() < 1e-14); // f32 has nothing left of it
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Compensated {
    value: f32,
    rest: f32,
}

/// a + b and what rounding took. 6 flops.
#[inline(always)]
fn two_sum(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    let second = sum - a;
    (sum, (a - (sum - second)) + (b - second))
}

/// The same for |a| ≥ |b|. 3 flops.
#[inline(always)]
fn fast_two_sum(a: f32, b: f32) -> Compensated {
    let sum = a + b;
    Compensated {
        value: sum,
        rest: b - (sum - a),
    }
}

/// a b and what rounding took. 17 flops and bit operations.
#[inline(always)]
fn two_product(a: f32, b: f32) -> (f32, f32) {
    // Halves of 12 bits, whose products are exact.
    let upper = |x: f32| f32::from_bits(x.to_bits() & 0xffff_f000);
    let (a_1, b_1) = (upper(a), upper(b));
    let (a_2, b_2) = (a - a_1, b - b_1);
    let product = a * b;
    (
        product,
        ((a_1 * b_1 - product) + a_1 * b_2 + a_2 * b_1) + a_2 * b_2,
    )
}

impl Compensated {
    /// The nearest one to an f64.
    pub(crate) const fn new(x: f64) -> Self {
        let value = x as f32;
        Self {
            value,
            rest: (x - value as f64) as f32,
        }
    }
}

/// 11 flops.
impl Add for Compensated {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        let (sum, rest) = two_sum(self.value, o.value);
        fast_two_sum(sum, rest + (self.rest + o.rest))
    }
}

/// 24 flops.
impl Mul for Compensated {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let (product, rest) = two_product(self.value, o.value);
        let cross = self.value * o.rest + self.rest * o.value;
        fast_two_sum(product, rest + cross)
    }
}

impl Div for Compensated {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let first = self.value / o.value;
        let left = self - o * Self::from(first);
        fast_two_sum(first, left.value / o.value)
    }
}

impl Neg for Compensated {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            rest: -self.rest,
        }
    }
}

assigning!(Compensated);

impl From<f32> for Compensated {
    #[inline(always)]
    fn from(value: f32) -> Self {
        Self { value, rest: 0.0 }
    }
}

impl sealed::Sealed for Compensated {}

impl Plain for Compensated {
    #[inline(always)]
    fn products<const K: usize>(terms: [(Self, Self); K]) -> Self {
        let mut sum = Self::ZERO;
        for (k, (a, b)) in terms.into_iter().enumerate() {
            sum = if k == 0 { a * b } else { sum + a * b };
        }
        sum
    }
}

impl Real for Compensated {
    type Vec3 = Vec3<Self>;
    type Mat3 = Mat3<Self>;
    const ZERO: Self = Self::new(0.0);
    const ONE: Self = Self::new(1.0);
    const MAX_TRUNC: f64 = <f32 as Real>::MAX_TRUNC;
    const EPSILON: Self = Self::new(1.0 / (1_u64 << 46) as f64);
    const MIN_POSITIVE: Self = Self::new(f32::MIN_POSITIVE as f64);

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::new(x)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self.value) + f64::from(self.rest)
    }
    /// As [`crate::trig::sin_cos_f64`], by Taylor's polynomials: to 10⁻¹² within ±100 rad.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        const ROUND: f32 = 12_582_912.0;
        let t = self.value * core::f32::consts::FRAC_2_PI + ROUND;
        let (k, quadrant) = (t - ROUND, t.to_bits());
        // π/2 in three parts: k times the first is exact.
        const QUARTER: f64 = core::f64::consts::FRAC_PI_2;
        let first = Self::from(-k * 1.570_312_5);
        let second = Self::from(-k) * const { Self::new(QUARTER - 1.570_312_5) };
        let r = (self + first) + second;
        let u = r * r;
        let series = |factors: [f64; 6]| {
            let mut sum = Self::ONE;
            for factor in factors {
                sum = Self::ONE - u * sum * Self::new(factor);
            }
            sum
        };
        // sin r = r (1 − u/2·3 (1 − u/4·5 (…))), cos r = 1 − u/1·2 (1 − u/3·4 (…)).
        let s = r * series([13.0, 11.0, 9.0, 7.0, 5.0, 3.0].map(|n| 1.0 / (n * (n - 1.0))));
        let c = series([12.0, 10.0, 8.0, 6.0, 4.0, 2.0].map(|n| 1.0 / (n * (n - 1.0))));
        match quadrant & 3 {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        }
    }
    #[inline]
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
    #[inline(always)]
    fn rsqrt(self) -> Self {
        // One more step of Newton's iteration doubles the digits of f32's.
        let y = Self::from(self.value.rsqrt());
        y + y * (const { Self::new(0.5) } - const { Self::new(0.5) } * self * y * y)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.rest.is_finite()
    }
    #[inline(always)]
    fn clamped(self, lo: Self, hi: Self) -> Self {
        let x = if self > lo { self } else { lo };
        if x < hi { x } else { hi }
    }
    #[inline(always)]
    fn trunc_saturating(self) -> Self {
        Self::from(self.value.trunc_saturating()) + Self::from(self.rest.trunc_saturating())
    }
    fn cast<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
    ) -> Model<Self, B, Q, V> {
        model.to_compensated()
    }
    #[inline(always)]
    fn model<T, const B: usize, const Q: usize, const V: usize>() -> &'static Model<Self, B, Q, V>
    where
        T: Robot<B, Q, V>,
    {
        const { &T::MODEL.to_compensated() }
    }
    #[inline(always)]
    fn select(double: f64, _: f32) -> Self {
        Self::new(double)
    }
}
