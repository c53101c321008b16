//! A table of one turn, and Taylor's polynomials from its nearest entry.

use super::Kernel;
use super::kernel::{GATHERS, bounded};
use crate::math::const_eval;

/// Sine and cosine of the nearest of `N` (a power of two) angles of a turn, turned on by the rest
/// r, |r| ≤ π/N, by Taylor's polynomials up to the order `ORDER`: 1 (linear interpolation along the
/// tangent), 2, 3 or 4.
///
/// | entries, order | flash | error |
/// |---|---|---|
/// | 256, 1 | 2 kB | 8·10⁻⁵ |
/// | 256, 2 | 2 kB | 5·10⁻⁷ |
/// | 128, 3 | 1 kB | 8·10⁻⁸, of which 6·10⁻⁸ are rounding |
/// | 64, 4 | 512 B | 7·10⁻⁸ |
///
/// Multiples of the table's step are subtracted from x in `PARTS` parts: 2 suffice up to ±100 rad,
/// 4 up to 10⁴ for up to 128 entries. For other x the results are within ±1 (for orders 1 and 2
/// within ±1.05), see [`crate::trig`]. Cost: the same instructions for all x, of which two load
/// neighbouring words from flash and take longer with wait states. Source: Gal, "Computing
/// elementary functions: a new approach for achieving high accuracy and good performance" (1986),
/// with equidistant entries; parts as in [`crate::trig`].
///
/// ```
/// use dynamics_core::trig::{Kernel, Table};
/// let (s, c) = Table::<256, 1>::sin_cos(-3.0_f32);
/// assert!((s + 0.141_120_01).abs() < 1e-4 && (c + 0.989_992_5).abs() < 1e-4);
/// ```
///
/// ```compile_fail,E0080
/// use dynamics_core::trig::{Kernel, Table};
/// let _ = Table::<100, 3>::sin_cos(0.5_f32); // not a power of two
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Table<const N: usize, const ORDER: usize, const PARTS: usize = 2>;

/// (sin, cos), side by side in one line of a flash cache.
#[repr(C, align(8))]
#[derive(Clone, Copy)]
struct Pair {
    sin: f32,
    cos: f32,
}

impl<const N: usize, const ORDER: usize, const PARTS: usize> Table<N, ORDER, PARTS> {
    /// Those of k 2π/N.
    const ENTRIES: [Pair; N] = {
        assert!(N.is_power_of_two() && N >= 16 && N <= 1024);
        assert!(ORDER >= 1 && ORDER <= 4);
        assert!(PARTS == 2 || PARTS == 4);
        let mut entries = [Pair { sin: 0.0, cos: 1.0 }; N];
        let mut k = 0;
        while k < N {
            // Within half a turn, where the series of `const_math` ends early.
            let turns = k as f64 / N as f64 - if 2 * k > N { 1.0 } else { 0.0 };
            let (s, c) = const_eval::sin_cos(turns * core::f64::consts::TAU);
            entries[k] = Pair { sin: s as f32, cos: c as f32 };
            k += 1;
        }
        entries
    };

    /// The same entries as words, the sine in the low half: LLVM loads sines and cosines of several
    /// angles by one gather, where it takes a second one for the cosines of pairs.
    const WORDS: [u64; N] = {
        let (mut words, mut k) = ([0; N], 0);
        while k < N {
            let Pair { sin, cos } = Self::ENTRIES[k];
            words[k] = ((cos.to_bits() as u64) << 32) | sin.to_bits() as u64;
            k += 1;
        }
        words
    };

    /// 2π/N in parts, all but the last so short that they are exact times k: 11 bits for |k| < 2¹³,
    /// 6 for 2¹⁸.
    const STEP: [f32; PARTS] = {
        let short = if PARTS == 2 { 0x1fff } else { 0x3_ffff };
        let mut rest = core::f64::consts::TAU / N as f64;
        let (mut step, mut i) = ([0.0; PARTS], 0);
        while i + 1 < PARTS {
            step[i] = f32::from_bits((rest as f32).to_bits() & !short);
            rest -= step[i] as f64;
            i += 1;
        }
        step[PARTS - 1] = rest as f32;
        step
    };

    /// A part of it, or nothing beyond the last.
    const fn part(i: usize) -> f32 {
        if i < PARTS { Self::STEP[i] } else { 0.0 }
    }
}

impl<const N: usize, const ORDER: usize, const PARTS: usize> Kernel<f32>
    for Table<N, ORDER, PARTS>
{
    #[cfg_attr(optimised, inline(always))]
    fn sin_cos(x: f32) -> (f32, f32) {
        // As in `minimax`: rounds, and leaves the integer in the low bits.
        const ROUND: f32 = 12_582_912.0;
        // None of these bits is set while t is between 2²³ and 2²⁴, some are once it is beyond 2²⁵
        // or negative; what lies between leaves |r| < 1/4.
        const OUTSIDE: u32 = 0xb400_0000;
        let t = x * const { (N as f64 / core::f64::consts::TAU) as f32 } + ROUND;
        let (k, at) = (t - ROUND, t.to_bits() as usize & (N - 1));
        let r = if ORDER == 1 {
            // The table's own error is larger than that of one part.
            x - k * const { (core::f64::consts::TAU / N as f64) as f32 }
        } else {
            // Not a loop: compilers that mind the code's size would leave it one.
            let r = (x - k * const { Self::part(0) }) - k * const { Self::part(1) };
            if PARTS == 2 {
                r
            } else {
                (r - k * const { Self::part(2) }) - k * const { Self::part(3) }
            }
        };
        let r = bounded(r, t.to_bits() & OUTSIDE == 0, x);
        let Pair { sin: s, cos: c } = if GATHERS {
            let word = (const { &Self::WORDS })[at];
            Pair { sin: f32::from_bits(word as u32), cos: f32::from_bits((word >> 32) as u32) }
        } else {
            (const { &Self::ENTRIES })[at]
        };
        let u = r * r;
        let sixth = || r + r * (u * (-1.0 / 6.0));
        // sin r and cos r − 1.
        let (ds, dc) = match ORDER {
            1 => return (s + c * r, c - s * r),
            2 => (r, u * -0.5),
            3 => (sixth(), u * -0.5),
            _ => (sixth(), u * (-0.5 + u * (1.0 / 24.0))),
        };
        (s + (s * dc + c * ds), c + (c * dc - s * ds))
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn a_word_has_the_bits_of_its_pair() {
        type Default = Table<128, 3>;
        for (word, pair) in Default::WORDS.iter().zip(Default::ENTRIES) {
            let (low, high) = (*word as u32, (word >> 32) as u32);
            assert_eq!((low, high), (pair.sin.to_bits(), pair.cos.to_bits()));
        }
    }
}
