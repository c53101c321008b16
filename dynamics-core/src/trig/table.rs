//! A table of one turn, and Taylor's polynomials from its nearest entry.

use super::Kernel;
use crate::const_math;

/// Sine and cosine of the nearest of `N` (a power of two) angles of a turn, turned on by the rest r, |r| ≤ π/N, by
/// Taylor's polynomials up to the order `ORDER`: 1 (linear interpolation along the tangent), 2 or 4.
///
/// | entries, order | flash | error |
/// |---|---|---|
/// | 256, 1 | 2 kB | 8·10⁻⁵ |
/// | 256, 2 | 2 kB | 5·10⁻⁷ |
/// | 64, 4 | 512 B | 2·10⁻⁷ |
///
/// Holds to ±100 rad. Cost: the same instructions whatever x, two of them loads from flash, which wait states
/// make longer. Source: Gal, "Computing elementary functions: a new approach for achieving high accuracy and good
/// performance" (1986), with equidistant entries.
///
/// ```
/// use dynamics_core::trig::{Kernel, Table};
/// let (s, c) = Table::<256, 1>::sin_cos(-3.0_f32);
/// assert!((s + 0.141_120_01).abs() < 1e-4 && (c + 0.989_992_5).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Table<const N: usize, const ORDER: usize>;

impl<const N: usize, const ORDER: usize> Table<N, ORDER> {
    /// (sin, cos) of k 2π/N.
    const ENTRIES: [[f32; 2]; N] = {
        assert!(N.is_power_of_two() && N >= 16 && N <= 1024);
        assert!(ORDER == 1 || ORDER == 2 || ORDER == 4);
        let mut entries = [[0.0; 2]; N];
        let mut k = 0;
        while k < N {
            // Within half a turn, where the series of `const_math` ends early.
            let turns = k as f64 / N as f64 - if 2 * k > N { 1.0 } else { 0.0 };
            let (s, c) = const_math::sin_cos(turns * core::f64::consts::TAU);
            entries[k] = [s as f32, c as f32];
            k += 1;
        }
        entries
    };
    /// 2π/N in two parts, the first of 11 bits: exact times |k| < 2¹³.
    const STEP: [f32; 2] = {
        let step = core::f64::consts::TAU / N as f64;
        let first = f32::from_bits((step as f32).to_bits() & !0x1fff);
        [first, (step - first as f64) as f32]
    };
}

impl<const N: usize, const ORDER: usize> Kernel<f32> for Table<N, ORDER> {
    #[inline(always)]
    fn sin_cos(x: f32) -> (f32, f32) {
        // As in `minimax`: rounds, and leaves the integer in the low bits.
        const ROUND: f32 = 12_582_912.0;
        let t = x * const { (N as f64 / core::f64::consts::TAU) as f32 } + ROUND;
        let (k, at) = (t - ROUND, t.to_bits() as usize & (N - 1));
        let r = if ORDER == 1 {
            // The table's own error is larger than that of one part.
            x - k * const { (core::f64::consts::TAU / N as f64) as f32 }
        } else {
            let [first, second] = Self::STEP;
            (x - k * first) - k * second
        };
        let [s, c] = const { &Self::ENTRIES }[at];
        // sin r and cos r − 1.
        let (ds, dc) = match ORDER {
            1 => return (s + c * r, c - s * r),
            2 => (r, r * r * -0.5),
            _ => {
                let u = r * r;
                (r + r * (u * (-1.0 / 6.0)), u * (-0.5 + u * (1.0 / 24.0)))
            }
        };
        (s + (s * dc + c * ds), c + (c * dc - s * ds))
    }
}
