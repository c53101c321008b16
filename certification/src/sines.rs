//! The error of the library's sines over the ranges of a robot's joints, by trying every angle.
//!
//! The same source computes the same bits on host and target (`cargo xtask test bits`), and an angle is one of at most 2³² numbers, so
//! that little needs to be argued about the kernel: each angle's sine and cosine are compared with f64's. Below 2⁻³⁰ rad the kernel's
//! step is zero, its square is lost beside one, and what it returns is the angle itself and one.

use std::ops::RangeInclusive;

use dynamics_core::trig;

use crate::bound::SineErrors;
use crate::state_box::Joint;

/// More than the error of the reference: that of this host's libm, and of the series of small angles.
const REFERENCE: f64 = 1e-15;
/// Angles below it are not tried: their sine is the angle within 2⁻⁹⁰, their cosine is one within 2⁻⁶¹.
const TINY: f32 = 1.0 / 1_073_741_824.0;
/// Below it the series of sine and cosine are exact enough with two terms.
const SMALL: f32 = 1.0 / 4096.0;

/// The sines of a joint as the engine computes them: those for ±100 rad within two turns.
pub fn pair(joint: &Joint, q: f32) -> (f32, f32) {
    if is_near(joint) {
        trig::sin_cos_near(q)
    } else {
        trig::sin_cos(q)
    }
}

/// Whether the engine computes the sines of a joint by the kernel for two turns.
pub(crate) fn is_near(joint: &Joint) -> bool {
    let most = joint.position.magnitude();
    most <= 2.0 * std::f64::consts::TAU
}

/// The greatest errors over all numbers of f32 in the ranges of the joints that turn.
pub fn enumerate(joints: &[Joint]) -> SineErrors {
    let mut worst = SineErrors::default();
    for near in [false, true] {
        let mine = || {
            joints
                .iter()
                .filter(|joint| joint.turns && is_near(joint) == near)
        };
        let kernel = if near {
            trig::sin_cos_near
        } else {
            trig::sin_cos
        };
        let most = |end: fn(&Joint) -> f64| mine().map(end).fold(0.0_f64, f64::max) as f32;
        for (sign, most) in [
            (1.0, most(|joint| joint.position.high)),
            (-1.0, most(|joint| -joint.position.low)),
        ] {
            // One beyond, if the limit was rounded down.
            let of_sign = over(
                TINY.to_bits()..=most.to_bits() + 1,
                &|x: f32| kernel(sign * x),
                f64::from(sign),
            );
            worst = larger(worst, of_sign);
        }
    }
    worst
}

fn larger(a: SineErrors, b: SineErrors) -> SineErrors {
    SineErrors {
        sine: a.sine.max(b.sine),
        cosine: a.cosine.max(b.cosine),
    }
}

/// The errors over numbers of f32 by their bits, on all cores. The kernel is of the angle with its sign, the angle without.
fn over(
    bits: RangeInclusive<u32>,
    kernel: &(impl Fn(f32) -> (f32, f32) + Sync),
    sign: f64,
) -> SineErrors {
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u32;
    let (first, last) = (*bits.start(), (*bits.end()).max(*bits.start()));
    let share = (last - first) / threads + 1;
    std::thread::scope(|scope| {
        let parts = (0..threads).map(|i| {
            let start = first + i * share;
            let end = start.saturating_add(share - 1).min(last);
            scope.spawn(move || {
                (start..=end).fold(SineErrors::default(), |worst, bits| {
                    larger(worst, error(f32::from_bits(bits), kernel, sign))
                })
            })
        });
        let parts: Vec<_> = parts.collect();
        // A thread that ended early would leave angles out; nothing is then proven.
        let nothing = SineErrors {
            sine: f64::INFINITY,
            cosine: f64::INFINITY,
        };
        parts
            .into_iter()
            .map(|part| part.join().unwrap_or(nothing))
            .fold(SineErrors::default(), larger)
    })
}

#[inline(always)]
fn error(x: f32, kernel: impl Fn(f32) -> (f32, f32), sign: f64) -> SineErrors {
    let (sine, cosine) = kernel(x);
    let (wide, square) = (f64::from(x), f64::from(x) * f64::from(x));
    let (s, c) = if x < SMALL {
        (wide * (1.0 - square / 6.0), 1.0 - 0.5 * square)
    } else {
        wide.sin_cos()
    };
    SineErrors {
        sine: (f64::from(sine) - sign * s).abs() + REFERENCE,
        cosine: (f64::from(cosine) - c).abs() + REFERENCE,
    }
}
