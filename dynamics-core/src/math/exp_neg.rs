//! e⁻ˣ without a branch, and in f32 without f64.
//!
//! Cody and Waite, *Software Manual for the Elementary Functions* (1980), chapter 6: −x = k ln 2 +
//! r with ln 2 in two parts, the product of the first of which with k is exact, then a minimax
//! polynomial of degree 6 on |r| ≤ ln 2 / 2 (Remez exchange in 40 digits, coefficients rounded to
//! f32 one after the other). `libm::expf` branches and is twice as long.

/// e⁻ˣ of x ≥ 0: relative error below 1.5·10⁻⁷ down to e⁻⁸⁷, then 0; 1 for x < 0 and for NaN.
///
/// Cost: the same instructions for all x.
///
/// ```
/// use dynamics_core::scalar::exp_neg;
/// assert!((exp_neg(1.0) - 0.367_879_44).abs() < 4e-8);
/// assert_eq!((exp_neg(0.0), exp_neg(f32::INFINITY)), (1.0, 0.0));
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn exp_neg(x: f32) -> f32 {
    const ROUND: f32 = 12_582_912.0;
    const P: [f32; 5] = [0.499_999_94, 0.166_665_23, 0.041_668_22, 0.008_367_908, 0.001_380_581_8];
    // A conversion that saturates limits x to [0, 128): neither a comparison nor its wait for the
    // FPU's flags.
    const STEPS: f32 = 33_554_432.0;
    let x = ((x * STEPS) as u32) as f32 * (1.0 / STEPS);
    let t = x * core::f32::consts::LOG2_E + ROUND;
    let k = t - ROUND;
    let r = (k * 0.693_145_75 - x) + k * 1.428_606_8e-6;
    let e = 1.0 + (r + r * r * (P[0] + r * (P[1] + r * (P[2] + r * (P[3] + r * P[4])))));
    // 2⁻ᵏ; zero where it would be subnormal.
    let halvings = t.to_bits() & 0xff;
    f32::from_bits(127_u32.saturating_sub(halvings) << 23) * e
}
