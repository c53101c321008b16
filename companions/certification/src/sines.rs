//! The error of the library's sines over the ranges of a robot's joints, by trying every angle.
//!
//! The same source computes the same bits on host and target (`cargo xtask test bits`), and an
//! angle is one of at most 2³² numbers, so that little needs to be argued about the kernel: each
//! angle's sine and cosine are compared with f64's. Below 2⁻³⁰ rad the kernel's step is zero, its
//! square is lost beside one, and what it returns is the angle itself and one.

use std::ops::RangeInclusive;

use dynamics_core::trig;

use crate::bound::SineErrors;
use crate::state_box::Joint;

/// More than the error of the reference: that of this host's libm, and of the series of small
/// angles.
const REFERENCE: f64 = 1e-15;
/// Angles below it are not tried: their sine is the angle within 2⁻⁹⁰, their cosine is one within
/// 2⁻⁶¹.
const TINY: f32 = 1.0 / 1_073_741_824.0;
/// Below it the series of sine and cosine are exact enough with two terms.
const SMALL: f32 = 1.0 / 4096.0;

/// The sines of a joint as the engine computes them: those for ±100 rad within two turns.
pub fn pair(joint: &Joint, q: f32) -> (f32, f32) {
    Kernel::NATIVE.pair(joint, q)
}

/// Whether the engine computes the sines of a joint by the kernel for two turns.
pub(crate) fn is_near(joint: &Joint) -> bool {
    let most = joint.position.magnitude();
    most <= 2.0 * std::f64::consts::TAU
}

/// Sine and cosine of an angle.
type Function = fn(f32) -> (f32, f32);

/// A kernel of sines: for two turns, and for more.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    near: Function,
    far: Function,
}

impl Kernel {
    /// The library's own kernels of sines.
    pub const NATIVE: Self = Self { near: trig::sin_cos_near, far: trig::sin_cos };

    /// The kernel that a type is.
    pub fn of<K: trig::Kernel<f32>>() -> Self {
        Self { near: K::sin_cos_near, far: K::sin_cos }
    }

    /// As [`pair`], by this kernel.
    pub(crate) fn pair(&self, joint: &Joint, q: f32) -> (f32, f32) {
        let kernel = if is_near(joint) { self.near } else { self.far };
        kernel(q)
    }
}

/// The greatest errors of the library's sines over all numbers of f32 in the ranges of the joints
/// that turn.
pub fn enumerate(joints: &[Joint]) -> SineErrors {
    enumerate_each(joints, &[Kernel::NATIVE])[0]
}

/// The greatest errors of each of some kernels.
pub fn enumerate_each(joints: &[Joint], kernels: &[Kernel]) -> Vec<SineErrors> {
    let mut worst = vec![SineErrors::default(); kernels.len()];
    for near in [false, true] {
        let mine = || joints.iter().filter(|joint| joint.turns && is_near(joint) == near);
        let of = |kernel: &Kernel| if near { kernel.near } else { kernel.far };
        let functions: Vec<Function> = kernels.iter().map(of).collect();
        let most = |end: fn(&Joint) -> f64| mine().map(end).fold(0.0_f64, f64::max) as f32;
        for (sign, most) in
            [(1.0, most(|joint| joint.position.high)), (-1.0, most(|joint| -joint.position.low))]
        {
            // One beyond, if the limit was rounded down.
            let of_sign = over(TINY.to_bits()..=most.to_bits() + 1, &functions, sign);
            worst = larger_each(&worst, &of_sign);
        }
    }
    worst
}

fn larger_each(a: &[SineErrors], b: &[SineErrors]) -> Vec<SineErrors> {
    a.iter().zip(b).map(|(a, b)| larger(*a, *b)).collect()
}

fn larger(a: SineErrors, b: SineErrors) -> SineErrors {
    SineErrors { sine: a.sine.max(b.sine), cosine: a.cosine.max(b.cosine) }
}

/// The errors over numbers of f32 by their bits, on all cores. The kernels are of the angle with
/// its sign, the angle without.
fn over(bits: RangeInclusive<u32>, kernels: &[Function], sign: f32) -> Vec<SineErrors> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u32;
    let (first, last) = (*bits.start(), (*bits.end()).max(*bits.start()));
    let share = (last - first) / threads + 1;
    let none = vec![SineErrors::default(); kernels.len()];
    std::thread::scope(|scope| {
        let parts = (0..threads).map(|i| {
            let start = first + i * share;
            let end = start.saturating_add(share - 1).min(last);
            let mut worst = none.clone();
            scope.spawn(move || {
                for bits in start..=end {
                    let x = f32::from_bits(bits);
                    let exact = reference(x);
                    for (worst, kernel) in worst.iter_mut().zip(kernels) {
                        *worst = larger(*worst, error(kernel(sign * x), exact, sign));
                    }
                }
                worst
            })
        });
        let parts: Vec<_> = parts.collect();
        // A thread that ended early would leave angles out; nothing is then proven.
        let nothing = SineErrors { sine: f64::INFINITY, cosine: f64::INFINITY };
        let joined = parts
            .into_iter()
            .map(|part| part.join().unwrap_or_else(|_| vec![nothing; kernels.len()]));
        joined.fold(none.clone(), |worst, part| larger_each(&worst, &part))
    })
}

#[inline(always)]
fn reference(x: f32) -> (f64, f64) {
    let (wide, square) = (f64::from(x), f64::from(x) * f64::from(x));
    if x < SMALL { (wide * (1.0 - square / 6.0), 1.0 - 0.5 * square) } else { wide.sin_cos() }
}

#[inline(always)]
fn error((sine, cosine): (f32, f32), (s, c): (f64, f64), sign: f32) -> SineErrors {
    SineErrors {
        sine: (f64::from(sine) - f64::from(sign) * s).abs() + REFERENCE,
        cosine: (f64::from(cosine) - c).abs() + REFERENCE,
    }
}
