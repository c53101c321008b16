//! f32 with the rounding error of every operation carried along: twice the digits, without f64.
//!
//! Two-sum: Knuth, *The Art of Computer Programming* 2 (1969), 4.2.2; two-product: Dekker, "A floating-point
//! technique for extending the available precision" (1971); pairs of them: Joldes, Muller & Popescu, "Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic" (2017). The FPU's fused
//! multiply-add would halve the product, but has no name in `core`.

use dynamics_core::scalar::Real;

use super::vector::Plain;
use super::{operators, real};

/// A number as the sum of an f32 and its rounding error: some 46 bits.
///
/// Errors are relative to the larger operand. No infinities: what overflows becomes NaN.
///
/// ```
/// use dynamics_core::scalar::Real;
/// use lab_target::accuracy::numbers::Compensated;
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
    pub const fn new(x: f64) -> Self {
        let value = x as f32;
        Self {
            value,
            rest: (x - value as f64) as f32,
        }
    }
}

operators! {
    /// 11 flops.
    [] Compensated, Add add (Self) -> Self: |a, b| {
        let (sum, rest) = two_sum(a.value, b.value);
        fast_two_sum(sum, rest + (a.rest + b.rest))
    };
    [] Compensated, Sub sub (Self) -> Self: |a, b| a + -b;
    /// 24 flops.
    [] Compensated, Mul mul (Self) -> Self: |a, b| {
        let (product, rest) = two_product(a.value, b.value);
        let cross = a.value * b.rest + a.rest * b.value;
        fast_two_sum(product, rest + cross)
    };
    [] Compensated, Div div (Self) -> Self: |a, b| {
        let first = a.value / b.value;
        let left = a - b * Self::from(first);
        fast_two_sum(first, left.value / b.value)
    };
    [] Compensated, Neg neg () -> Self: |a| Self { value: -a.value, rest: -a.rest };
}

real! {
    Compensated,
    full: <f32 as Real>::MAX_TRUNC,
    epsilon: Self::new(1.0 / (1_u64 << 46) as f64),
    tiny: Self::new(f32::MIN_POSITIVE as f64),
    sin_cos: sin_cos,
    to_f64: |x| -> f64 { f64::from(x.value) + f64::from(x.rest) }
    // One more step of Newton's iteration doubles the digits of f32's.
    rsqrt: |x| -> Self {{
        let y = Self::from(x.value.rsqrt());
        y + y * (const { Self::new(0.5) } - const { Self::new(0.5) } * x * y * y)
    }}
    abs: |x| -> Self { if x.value < 0.0 { -x } else { x } }
    is_finite: |x| -> bool { x.value.is_finite() && x.rest.is_finite() }
    trunc_saturating: |x| -> Self { Self::from(x.value.trunc_saturating()) + Self::from(x.rest.trunc_saturating()) }
}

impl From<f32> for Compensated {
    #[inline(always)]
    fn from(value: f32) -> Self {
        Self { value, rest: 0.0 }
    }
}

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

/// As the library's f64, by Taylor's polynomials: to 10⁻¹² within ±100 rad.
#[inline]
fn sin_cos(x: Compensated) -> (Compensated, Compensated) {
    const ROUND: f32 = 12_582_912.0;
    let t = x.value * core::f32::consts::FRAC_2_PI + ROUND;
    let (k, quadrant) = (t - ROUND, t.to_bits());
    // π/2 in three parts: k times the first is exact.
    const QUARTER: f64 = core::f64::consts::FRAC_PI_2;
    let first = Compensated::from(-k * 1.570_312_5);
    let second = Compensated::from(-k) * const { Compensated::new(QUARTER - 1.570_312_5) };
    let r = (x + first) + second;
    let u = r * r;
    let series = |factors: [f64; 6]| {
        let mut sum = Compensated::ONE;
        for factor in factors {
            sum = Compensated::ONE - u * sum * Compensated::new(factor);
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
