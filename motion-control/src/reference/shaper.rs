//! References that leave no vibration: zero-vibration shapers.
//!
//! A reference is replaced by a sum of itself at several delays, so that the vibrations that each
//! part excites cancel: Singer & Seering (1990). For a vibration of frequency ω and damping ratio
//! ζ, with T = π / ω√(1 − ζ²) and K = exp(−ζπ/√(1 − ζ²)), ZV has the amplitudes 1 and K over their
//! sum at 0 and T, ZVD 1, 2K and K² at 0, T and 2T.

use core::fmt;

use heapless::Vec;

use crate::entry;
use crate::limits::Circles;
use crate::reference::Reference;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

#[cfg(test)]
mod tests;

/// A vibration of a machine, such as a mode of a link that bends: the frequency is that with the
/// joints clamped, which [`Modes::frequencies`](dynamics_core::flexible::Modes::frequencies) has
/// for a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vibration<R> {
    /// The link that vibrates, for messages.
    pub link: &'static str,
    /// The number of its mode, for messages.
    pub mode: usize,
    /// ω without damping, rad/s.
    pub omega: R,
    /// Damping ratio ζ, less than one.
    pub damping_ratio: R,
}

/// The delays and amplitudes of which a shaped reference is the sum: at most N.
///
/// ZV leaves some π/2 of the error of the frequency, 8 % of the vibration at 5 %, and delays by
/// half a period; ZVD leaves its square, 0.6 %, and delays by a whole one. A delay between two
/// ticks is divided between them, so that a vibration has its impulses on both: for several
/// vibrations the lists multiply, 3, 9, 27 with ZV and 5, 25 with ZVD.
///
/// ```
/// use motion_control::reference::{Shaper, Vibration};
/// let sway = Vibration { link: "boom", mode: 0, omega: 12.0_f32, damping_ratio: 0.01 };
/// let shaper = Shaper::<f32, 3>::zv(&[sway], 1e-3)?;
/// assert_eq!(shaper.delay(), 262); // half a period of 0.524 s, rounded up
/// let never = Vibration { omega: 0.0, ..sway };
/// let error = Shaper::<f32, 3>::zv(&[never], 1e-3).unwrap_err();
/// assert_eq!(error.to_string(), "link `boom`, mode 0: the frequency is not positive");
/// # Ok::<(), motion_control::reference::ShaperError>(())
/// ```
///
/// # Source
/// Singer & Seering, "Preshaping command inputs to reduce system vibration" (1990).
#[derive(Clone, Debug, PartialEq)]
pub struct Shaper<R, const N: usize, const CIRCLES: u128 = 0> {
    impulses: Vec<Impulse<R>, N>,
}

/// A part of a shaped reference.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Impulse<R> {
    ticks: u32,
    amplitude: R,
}

impl<R: Real, const N: usize> Default for Shaper<R, N> {
    /// The reference as it is.
    fn default() -> Self {
        let mut impulses = Vec::new();
        // Fails at N = 0 alone, which no reference uses.
        let _ = impulses.push(Impulse { ticks: 0, amplitude: R::ONE });
        Self { impulses }
    }
}

impl<R: Real, const N: usize, const CIRCLES: u128> Shaper<R, N, CIRCLES> {
    /// The ticks by which the end is delayed.
    pub fn delay(&self) -> u32 {
        self.impulses.iter().map(|impulse| impulse.ticks).max().unwrap_or(0)
    }
}

impl<R: Real, const N: usize> Shaper<R, N> {
    /// The same shaper for a reference whose numbers leap by whole turns: those of the joints of
    /// [`Circles::bits`] are moved to within half a turn of the present one before they are added.
    /// The numbers of a [`Trajectory`](crate::reference::Trajectory) do not leap, and need this
    /// not.
    #[must_use]
    pub fn on_circles<const CIRCLES: u128>(self) -> Shaper<R, N, CIRCLES> {
        Shaper { impulses: self.impulses }
    }

    /// Zero vibration: two impulses for each vibration. The tick is in s.
    ///
    /// # Errors
    /// [`ShaperError`] names the link and the mode: a frequency that is not positive or is not
    /// finite, a damping ratio outside 0 ≤ ζ < 1, a tick that is not positive, a delay of more than
    /// 10⁶ ticks, more impulses than N.
    pub fn zv(vibrations: &[Vibration<R>], tick: R) -> Result<Self, ShaperError> {
        Self::of(vibrations, tick, |k| [R::ONE, k, R::ZERO])
    }

    /// Zero vibration and derivative: three impulses for each vibration.
    ///
    /// # Errors
    /// As [`Shaper::zv`].
    pub fn zvd(vibrations: &[Vibration<R>], tick: R) -> Result<Self, ShaperError> {
        Self::of(vibrations, tick, |k| [R::ONE, k + k, k * k])
    }

    fn of(
        vibrations: &[Vibration<R>],
        tick: R,
        amplitudes: impl Fn(R) -> [R; 3],
    ) -> Result<Self, ShaperError> {
        let mut shaper = Self::default();
        for vibration in vibrations {
            let &Vibration { link, mode, omega, damping_ratio } = vibration;
            let error = |problem| ShaperError { link, mode, problem };
            if !((omega > R::ZERO) & omega.is_finite()) {
                return Err(error(ShaperProblem::Frequency));
            }
            if !((damping_ratio >= R::ZERO) & (damping_ratio < R::ONE)) {
                return Err(error(ShaperProblem::Damping));
            }
            let pi = R::from_f64(core::f64::consts::PI);
            let root = (R::ONE - damping_ratio * damping_ratio).sqrt();
            let ticks = pi / (omega * root * tick);
            if !((ticks > R::ZERO) & (ticks < R::from_f64(1e6))) {
                return Err(error(ShaperProblem::Delay));
            }
            let parts = amplitudes((damping_ratio * pi / root).exp_neg());
            let all = parts.iter().fold(R::ZERO, |sum, &part| sum + part);
            let mut convolved = Vec::new();
            for impulse in &shaper.impulses {
                for (n, part) in parts.into_iter().enumerate() {
                    let at = ticks * R::from_f64(n as f64);
                    let amplitude = impulse.amplitude * part / all;
                    add(&mut convolved, impulse.ticks, at, amplitude)
                        .map_err(|()| error(ShaperProblem::Impulses))?;
                }
            }
            shaper.impulses = convolved;
        }
        Ok(shaper)
    }
}

/// Adds an impulse `at` ticks after `from`, divided between the two ticks that it is between.
fn add<R: Real, const N: usize>(
    to: &mut Vec<Impulse<R>, N>,
    from: u32,
    at: R,
    amplitude: R,
) -> Result<(), ()> {
    let whole = at.trunc_saturating();
    let (later, ticks) = (at - whole, from.saturating_add(whole.to_u32()));
    let halves = [(ticks, R::ONE - later), (ticks.saturating_add(1), later)];
    for (ticks, share) in halves {
        let amplitude = amplitude * share;
        if amplitude == R::ZERO {
            continue;
        }
        if let Some(same) = to.iter_mut().find(|other| other.ticks == ticks) {
            same.amplitude += amplitude;
        } else {
            to.push(Impulse { ticks, amplitude }).map_err(|_| ())?;
        }
    }
    Ok(())
}

/// A reference without the vibrations of a shaper.
///
/// ```
/// use motion_control::reference::{Reference, Shaped, Shaper, Vibration};
/// use dynamics_core::state::State;
/// /// A step at tick 1.
/// struct Step;
/// impl Reference<f32, 1> for Step {
///     fn at(&self, tick: u32) -> State<f32, 1, 1> {
///         State::at([if tick == 0 { 0.0 } else { 1.0 }])
///     }
///     fn ticks(&self) -> u32 {
///         1
///     }
/// }
/// let sway = Vibration { link: "boom", mode: 0, omega: 10.0 * core::f32::consts::PI, damping_ratio: 0.0 };
/// let shaped = Shaped { reference: Step, shaper: Shaper::<f32, 3>::zv(&[sway], 1e-3)? };
/// assert_eq!(shaped.at(50).q, [0.5]); // half of the step, and half of it half a period of 0.2 s later
/// assert!((shaped.at(102).q[0] - 1.0).abs() < 1e-6);
/// # Ok::<(), motion_control::reference::ShaperError>(())
/// ```
///
/// # Cost
/// A call of the reference and 6 V flops for each impulse.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaped<T, R, const N: usize, const CIRCLES: u128 = 0> {
    /// The reference.
    pub reference: T,
    /// Its shaper.
    pub shaper: Shaper<R, N, CIRCLES>,
}

impl<T, R: Real, const V: usize, const N: usize, const CIRCLES: u128> Reference<R, V>
    for Shaped<T, R, N, CIRCLES>
where
    T: Reference<R, V>,
{
    fn at(&self, tick: u32) -> State<R, V, V> {
        let circles = Circles::from_bits(CIRCLES);
        let mut sum = State::at([R::ZERO; V]);
        for impulse in &self.shaper.impulses {
            let mut part = self.reference.at(tick.saturating_sub(impulse.ticks));
            if circles.any() {
                part.q = circles.near(&part.q, &self.reference.at(tick).q);
            }
            let add = |to: &mut [R; V], part: &[R; V]| {
                for (k, to) in to.iter_mut().enumerate() {
                    *to += impulse.amplitude * entry(part, k);
                }
            };
            add(&mut sum.q, &part.q);
            add(&mut sum.qd, &part.qd);
            add(&mut sum.qdd, &part.qdd);
        }
        sum
    }

    fn ticks(&self) -> u32 {
        self.reference.ticks().saturating_add(self.shaper.delay())
    }
}

/// A vibration for which there is no shaper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ShaperError {
    /// The link of the vibration.
    pub link: &'static str,
    /// Its mode.
    pub mode: usize,
    /// The mistake in it.
    pub problem: ShaperProblem,
}

/// A mistake in a vibration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ShaperProblem {
    /// The frequency is zero, negative or not finite.
    Frequency,
    /// The damping ratio is negative, one or more, or not a number.
    Damping,
    /// Half a period is more than 10⁶ ticks, or the tick is not positive.
    Delay,
    /// There are more impulses than N.
    Impulses,
}

impl fmt::Display for ShaperError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { link, mode, problem } = self;
        let text = match problem {
            ShaperProblem::Frequency => "the frequency is not positive",
            ShaperProblem::Damping => "the damping ratio is not within 0 and 1",
            ShaperProblem::Delay => "half a period has no number of ticks below a million",
            ShaperProblem::Impulses => "the shaper has more impulses than there is room for",
        };
        write!(out, "link `{link}`, mode {mode}: {text}")
    }
}

impl core::error::Error for ShaperError {}
