//! Sine and cosine in f32, without a branch and without f64.
//!
//! Cody and Waite, *Software Manual for the Elementary Functions* (1980): x = k π/2 + r with π/2
//! in parts whose products with k are exact, then minimax polynomials of degree 7 (sine) and 8
//! (cosine) on |r| ≤ π/4. The coefficients are printed by `host-tests/oracle/minimax.py`.
//! `libm::sinf` computes in f64, which the FPU of a Cortex-M4F does not have: 30 times the cost.

/// Adding and subtracting 1.5·2²³ rounds an f32 below 2²² to the nearest integer, and leaves
/// that integer in the low bits of the sum.
const ROUND: f32 = 12_582_912.0;

const SIN: [f32; 3] = [-0.166_666_55, 0.008_332_174, -0.000_195_156_54];
const COS: [f32; 3] = [0.041_666_653, -0.001_388_761_9, 2.446_341_2e-5];

/// (sin x, cos x) of x in rad, |x| ≤ 10⁴: absolute error below 1.2·10⁻⁷.
///
/// Beyond 10⁴ rad accuracy is lost gradually; beyond 6·10⁶ rad, and for infinite or NaN input,
/// the result has no meaning (it may be NaN): callers gate such angles before they get here.
/// The same instructions whatever x.
///
/// ```
/// let (s, c) = dynamics_core::trig::sin_cos(0.5);
/// assert!((s - 0.479_425_54).abs() < 1.2e-7 && (c - 0.877_582_55).abs() < 1.2e-7);
/// ```
#[inline(always)]
pub fn sin_cos(x: f32) -> (f32, f32) {
    let t = x * core::f32::consts::FRAC_2_PI + ROUND;
    let k = t - ROUND;
    let r = ((x - k * 1.570_312_5) - k * 4.837_513e-4) - k * 7.549_79e-8;
    kernel(r, t.to_bits())
}

/// (sin x, cos x) of x in rad for joints that never leave ±4π: absolute error below 1.2·10⁻⁷.
///
/// A reduction in two parts instead of three. The same instructions whatever x.
///
/// ```
/// let (s, c) = dynamics_core::trig::sin_cos_4pi(-3.0);
/// assert!((s + 0.141_120_01).abs() < 1.2e-7 && (c + 0.989_992_5).abs() < 1.2e-7);
/// ```
#[inline(always)]
pub fn sin_cos_4pi(x: f32) -> (f32, f32) {
    let t = x * core::f32::consts::FRAC_2_PI + ROUND;
    let k = t - ROUND;
    let r = (x - k * 1.570_785_5) - k * 1.080_433_4e-5;
    kernel(r, t.to_bits())
}

/// Sine and cosine of r + k π/2; the low two bits of `k` choose the quadrant.
#[inline(always)]
fn kernel(r: f32, k: u32) -> (f32, f32) {
    let u = r * r;
    let s = r + r * u * (SIN[0] + u * (SIN[1] + u * SIN[2]));
    let c = 1.0 + u * (-0.5 + u * (COS[0] + u * (COS[1] + u * COS[2])));
    // Exchange and change signs in integer registers: no branch, no wait for the FPU's flags.
    let (s, c) = (s.to_bits(), c.to_bits());
    let exchanged = (s ^ c) & (k & 1).wrapping_neg();
    let sine = s ^ exchanged ^ ((k & 2) << 30);
    let cosine = c ^ exchanged ^ ((k.wrapping_add(1) & 2) << 30);
    (f32::from_bits(sine), f32::from_bits(cosine))
}
