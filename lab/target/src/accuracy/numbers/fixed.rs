//! Fixed point, for comparison: what processors without an FPU use.
//!
//! Products are summed in 64 bits (SMULL, SMLAL) and rounded once. Every quantity has the same scale, so units have to
//! be chosen that keep all of them within ±2: [`InUnits`](crate::accuracy::model::InUnits) makes a robot in such units. Yates, *Fixed-Point
//! Arithmetic: An Introduction* (2009).

use dynamics_core::scalar::Real;
use dynamics_core::trig::Kernel;

use super::vector::Plain;
use super::{operators, real};

/// A number within ±2 in steps of 2⁻³⁰: Q31 with the bit of headroom that 1 takes. What overflows wraps.
///
/// ```
/// use dynamics_core::scalar::Real;
/// use lab_target::accuracy::numbers::Fixed;
/// let half = Fixed::from_f64(0.5);
/// assert_eq!((half * half + half).to_f64(), 0.75);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Fixed(i32);

/// Bits behind the point.
const FRACTION: u32 = 30;

impl Fixed {
    /// The nearest one to an f64.
    pub const fn new(x: f64) -> Self {
        let scaled = x * (1_i64 << FRACTION) as f64;
        Self((scaled + if scaled < 0.0 { -0.5 } else { 0.5 }) as i32)
    }
}

operators! {
    [] Fixed, Add add (Self) -> Self: |a, b| Self(a.0.wrapping_add(b.0));
    [] Fixed, Sub sub (Self) -> Self: |a, b| a + -b;
    [] Fixed, Mul mul (Self) -> Self: |a, b| Self::products([(a, b)]);
    [] Fixed, Neg neg () -> Self: |a| Self(a.0.wrapping_neg());
    [] Fixed, Div div (Self) -> Self: |a, b| {
        let dividend = i64::from(a.0) * (1 << FRACTION);
        // A divisor of 0 gives 0: there is nothing to wrap.
        Self(dividend.checked_div(i64::from(b.0)).unwrap_or(0) as i32)
    };
}

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
/// The polynomials are those of [`dynamics_core::trig::Minimax`] of degree 7. The same instructions whatever the angle.
///
/// ```
/// use dynamics_core::{scalar::Real, trig::Kernel};
/// use lab_target::accuracy::numbers::{Fixed, HalfTurns};
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

real! {
    Fixed,
    full: 2.0,
    epsilon: Self(1),
    tiny: Self(1),
    sin_cos: |x| HalfTurns::sin_cos(x * const { Self::new(core::f64::consts::FRAC_1_PI) }),
    to_f64: |x| -> f64 { f64::from(x.0) / (1_i64 << FRACTION) as f64 }
    rsqrt: |x| -> Self { Self::new(x.to_f64().rsqrt()) }
    abs: |x| -> Self { Self(x.0.wrapping_abs()) }
    is_finite: |_| -> bool { true }
    trunc_saturating: |x| -> Self { Self(x.0 / Self::ONE.0 * Self::ONE.0) }
}
