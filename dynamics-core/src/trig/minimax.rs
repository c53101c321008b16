//! Minimax polynomials of several degrees on |r| ≤ π/4, behind a reduction in two or three parts.

use super::Kernel;
use super::kernel::bounded;

/// Sine by a polynomial of degree `DEGREE` (3, 5 or 7), cosine by one of a degree more, of x − k
/// π/2 with π/2 in `PARTS` (2 or 3) parts.
///
/// | degree | error of the polynomials |
/// |---|---|
/// | 3 | 5·10⁻⁴ |
/// | 5 | 10⁻⁶ |
/// | 7 | 3·10⁻⁹, below rounding |
///
/// Two parts suffice up to ±100 rad, three up to 10⁴; for other x the results are within ±1, see
/// [`crate::trig`]. Cost: the same instructions for all x. Source: as [`crate::trig`]; the
/// coefficients are printed by `companions/laboratory/minimax.py`.
///
/// ```
/// use dynamics_core::trig::{Kernel, Minimax};
/// let (s, c) = Minimax::<5, 2>::sin_cos(0.5_f32);
/// assert!((s - 0.479_425_54).abs() < 1e-6 && (c - 0.877_582_55).abs() < 1e-6);
/// ```
///
/// ```compile_fail,E0080
/// use dynamics_core::trig::{Kernel, Minimax};
/// let _ = Minimax::<4, 2>::sin_cos(0.5_f32); // there is no such polynomial
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Minimax<const DEGREE: usize, const PARTS: usize>;

impl<const DEGREE: usize, const PARTS: usize> Kernel<f32> for Minimax<DEGREE, PARTS> {
    #[cfg_attr(optimised, inline(always))]
    fn sin_cos(x: f32) -> (f32, f32) {
        const {
            assert!(DEGREE == 3 || DEGREE == 5 || DEGREE == 7, "degrees are 3, 5 and 7");
            assert!(PARTS == 2 || PARTS == 3, "parts are 2 or 3");
        }
        let (k, quadrant) = quarter_turns(x);
        let r = if PARTS == 3 {
            ((x - k * 1.570_312_5) - k * 4.837_513e-4) - k * 7.549_79e-8
        } else {
            (x - k * 1.570_785_5) - k * 1.080_433_4e-5
        };
        // Within 2¹⁸ quarter turns k is right and |r| < 0.9.
        let inside = quadrant.wrapping_sub(0x4b3c_0000) < 1 << 19;
        in_quadrant(polynomials::<DEGREE>(bounded(r, inside, x)), quadrant)
    }
}

/// The nearest whole number of quarter turns, as a number and with its low bits.
///
/// Adding and subtracting 1.5·2²³ rounds an f32 below 2²² to the nearest integer and leaves that
/// integer in the low bits of the sum.
#[cfg_attr(optimised, inline(always))]
fn quarter_turns(x: f32) -> (f32, u32) {
    const ROUND: f32 = 12_582_912.0;
    let t = x * core::f32::consts::FRAC_2_PI + ROUND;
    (t - ROUND, t.to_bits())
}

/// Sine and cosine of |r| ≤ π/4.
#[cfg_attr(optimised, inline(always))]
fn polynomials<const DEGREE: usize>(r: f32) -> (f32, f32) {
    const SIN: [f32; 3] = [-0.166_666_55, 0.008_332_174, -0.000_195_156_54];
    const COS: [f32; 3] = [0.041_666_653, -0.001_388_761_9, 2.446_341_2e-5];
    const SIN_5: [f32; 2] = [-0.166_629_36, 0.008_154_79];
    const COS_6: [f32; 2] = [0.041_661_993, -0.001_366_497_3];
    let u = r * r;
    match DEGREE {
        3 => (r + r * u * -0.161_598_67, 1.0 + u * (-0.5 + u * 0.040_818_892)),
        5 => (
            r + r * u * (SIN_5[0] + u * SIN_5[1]),
            1.0 + u * (-0.5 + u * (COS_6[0] + u * COS_6[1])),
        ),
        _ => (
            r + r * u * (SIN[0] + u * (SIN[1] + u * SIN[2])),
            1.0 + u * (-0.5 + u * (COS[0] + u * (COS[1] + u * COS[2]))),
        ),
    }
}

/// Sine and cosine of r + k π/2 from those of r; the low two bits of `k` choose the quadrant.
#[cfg_attr(optimised, inline(always))]
fn in_quadrant((s, c): (f32, f32), k: u32) -> (f32, f32) {
    // Exchange and change signs in integer registers: no branch, no wait for the FPU's flags.
    let (s, c) = (s.to_bits(), c.to_bits());
    let exchanged = (s ^ c) & (k & 1).wrapping_neg();
    let sine = s ^ exchanged ^ ((k & 2) << 30);
    let cosine = c ^ exchanged ^ ((k.wrapping_add(1) & 2) << 30);
    (f32::from_bits(sine), f32::from_bits(cosine))
}
