//! The safety gate that every measurement and every command passes, and what happens on a fault.
//!
//! ```text
//!          more than ride_ticks of fault        hold_ticks more
//!   Full ────────────────────────────────▶ Hold ───────────────▶ Stopped
//!    ▲                                      │                       │
//!    └──────────────────────────────────────┘ no fault              │
//!    ▲         authority() rises over reentry_ticks                 │
//!    └──────────────────────────────────────────────────────────────┘ reset()
//! ```
//!
//! Ticks with a fault are counted until `reentry_ticks` in a row had none. What is kept from tick to
//! tick (last good positions, last torques, counters) takes in only what was accepted. With limits that allow
//! nothing (NaN, negative, an empty range) there is no supervisor, or one that keeps the arm stopped.

use super::{Command, Fault, Mode, SafetyLimits, SafetyLimitsError, Status, real};
use crate::scalar::Real;

mod reentry;
#[cfg(test)]
mod tests;
mod tick;

/// How many times the greatest step at full speed a measurement may be from the last good one; speed
/// itself is held against the observer's. The encoder's own step comes on top.
const JUMP: f64 = 2.0;
/// Positions beyond this are as good as infinite, in f64 too.
const FAR: f64 = f32::MAX as f64;
/// Beyond this, rad, f32 has no sine to 10⁻⁷: whatever the limits, no position is accepted there. Joints that
/// turn without end are told by what remains of whole turns, [`super::MultiTurnEncoder::within_turn`].
const RANGE: f64 = 1e4;

/// The safety gate: [`Self::admit`] starts a tick, [`Self::pass`] ends it.
///
/// ```
/// use dynamics_core::control::{SafetyLimits, Fault, Mode, Supervisor};
/// let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
/// let mut supervisor = Supervisor::new(bounds, 1e-3, 1, 4).riding(1);
///
/// assert_eq!(supervisor.admit(Ok(&[0.5])), Mode::Full);
/// assert_eq!(supervisor.pass(&[9.0]).torque, [8.0]); // not more than 8 N·m in one tick
///
/// assert_eq!(supervisor.admit(Ok(&[f32::NAN])), Mode::Full); // one is ridden through
/// assert_eq!(supervisor.last_good(), &[0.5]);
/// let command = supervisor.pass(&[9.0]);
/// assert_eq!(command.status.fault, Some(Fault::NotFinite { joint: 0 }));
///
/// assert_eq!(supervisor.admit(Err(Fault::Encoder { joint: 0 })), Mode::Hold);
/// supervisor.pass(&[5.0]); // the gravity torque
/// assert_eq!(supervisor.admit(Err(Fault::Encoder { joint: 0 })), Mode::Stopped);
/// let command = supervisor.pass(&[5.0]);
/// assert_eq!((command.torque, command.brake), ([0.0], true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Supervisor<R, const V: usize> {
    bounds: SafetyLimits<R, V>,
    /// Middle and half width of the range of positions.
    middle: [R; V],
    half: [R; V],
    /// Greatest plausible change of position in one tick.
    step: [R; V],
    /// Ticks since the last good position; very many before the first.
    reach: R,
    ride_ticks: u32,
    hold_ticks: u32,
    reentry_ticks: u32,
    reentry_inv: R,

    last_good: [R; V],
    /// The positions of this tick were accepted.
    seen: bool,
    /// Whether there is a last good position.
    known: bool,
    /// The last torque that was accepted.
    torque: [R; V],
    /// Ticks with a fault since `reentry_ticks` in a row had none.
    faults: u32,
    /// Ticks in a row without a fault, up to `reentry_ticks`.
    quiet: u32,
    /// Ticks of the full law since the last without it, up to `reentry_ticks`.
    ramp: u32,
    mode: Mode,
    fault: Option<Fault>,
    /// There was a fault in this tick.
    faulted: bool,
    /// There was an `admit` in this tick.
    fresh: bool,
    /// The next tick holds the arm, whatever is measured: the full law has no torque for it.
    hold_next: bool,
    /// The brake waits for the torque to be there after a reset.
    braked: bool,
    /// The limits allow nothing: the arm stays stopped.
    unusable: Option<Fault>,
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// A supervisor of an arm that holds itself, at full authority from the first tick; the torque
    /// rises from zero at the rate allowed. Call [`Self::reset`] first for an arm on its brake.
    ///
    /// `tick` is the nominal length of a tick in s. A fault that lasts for more than `hold_ticks`
    /// ticks, or comes back so often without `reentry_ticks` good ticks in between, stops the arm.
    ///
    /// With limits that allow nothing ([`SafetyLimits::check`]) the arm is stopped by [`Fault::Limits`], and no reset
    /// starts it: [`Self::try_new`] tells them while they are set.
    pub fn new(bounds: SafetyLimits<R, V>, tick: R, hold_ticks: u32, reentry_ticks: u32) -> Self {
        let unusable = bounds.check().err().map(|error| Fault::Limits {
            joint: error.joint(),
        });
        // Comparisons with NaN are false, so that a limit of NaN allows nothing.
        let allowed = |x| if x > R::ZERO { x } else { R::ZERO };
        let finite = |x: R| if x.is_finite() { allowed(x) } else { R::ZERO };
        // Finite ends, so that what lies between them is finite.
        let (far, range) = (R::from_f64(FAR), R::from_f64(RANGE));
        let end = |x: R| {
            if x.abs() > range {
                x.clamped(-range, range)
            } else {
                x
            }
        };
        let (mut middle, mut half) = (bounds.lower, bounds.upper);
        for (lower, upper) in middle.iter_mut().zip(&mut half) {
            let [a, b] = [*lower, *upper].map(|x| R::from_f64(0.5) * end(x));
            (*lower, *upper) = (a + b, b - a);
        }
        Self {
            bounds: SafetyLimits {
                torque: bounds.torque.map(finite),
                rate: bounds.rate.map(allowed),
                ..bounds
            },
            middle,
            half,
            step: bounds.speed.map(|speed| R::from_f64(JUMP) * speed * tick),
            reach: far,
            ride_ticks: 0,
            hold_ticks,
            reentry_ticks,
            reentry_inv: R::ONE / real(reentry_ticks.max(1)),
            last_good: [R::ZERO; V],
            seen: false,
            known: false,
            torque: [R::ZERO; V],
            faults: 0,
            quiet: reentry_ticks,
            ramp: reentry_ticks,
            mode: match unusable {
                None => Mode::Full,
                Some(_) => Mode::Stopped,
            },
            fault: unusable,
            faulted: false,
            fresh: false,
            hold_next: false,
            braked: false,
            unusable,
        }
    }

    /// As [`Self::new`], of limits that allow something.
    ///
    /// ```
    /// use dynamics_core::control::{SafetyLimits, SafetyLimitsError, Supervisor};
    /// let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [1.0], upper: [-1.0] };
    /// assert_eq!(Supervisor::try_new(bounds, 1e-3, 1, 4), Err(SafetyLimitsError::Empty { joint: 0 }));
    /// ```
    ///
    /// # Errors
    /// [`SafetyLimitsError`] names the joint and the limit.
    pub fn try_new(
        bounds: SafetyLimits<R, V>,
        tick: R,
        hold_ticks: u32,
        reentry_ticks: u32,
    ) -> Result<Self, SafetyLimitsError> {
        bounds.check()?;
        Ok(Self::new(bounds, tick, hold_ticks, reentry_ticks))
    }

    /// The same, which stays in [`Mode::Full`] for the first `ticks` ticks with a fault: for
    /// measurements that an observer can stand in for, and torques that the last one can.
    /// Too high a speed is not ridden through.
    pub fn riding(self, ticks: u32) -> Self {
        Self {
            ride_ticks: ticks,
            ..self
        }
    }

    /// The same for encoders whose step is `step` (rad, m), which slow joints would otherwise
    /// exceed their reach by. A step that is not positive counts as none.
    pub fn with_resolution(mut self, step: R) -> Self {
        let step = if step > R::ZERO { step } else { R::ZERO };
        self.step = self.step.map(|reach| reach + step);
        self
    }

    /// Starts a tick with the positions measured in it (rad, m), or why there are none, and returns
    /// what the arm does in it.
    ///
    /// Accepted are finite positions within their bounds (and within 10⁴ rad or m, beyond which f32 has no
    /// accurate sine) and within reach of the last good ones: up
    /// to twice the greatest speed times the ticks since. Without any good position yet there is
    /// nothing to hold: a fault stops the arm at once.
    ///
    /// Cost: 3 flops and 3 comparisons a joint; the same instructions whatever the data, except on
    /// a fault.
    #[inline]
    pub fn admit(&mut self, measured: Result<&[R; V], Fault>) -> Mode {
        self.begin();
        let fault = match measured {
            Ok(q) if self.plausible(q) => {
                self.last_good = *q;
                self.seen = true;
                self.known = true;
                self.reach = R::ONE;
                return self.mode;
            }
            Ok(q) => self.blame(q),
            Err(fault) => fault,
        };
        self.miss();
        self.raise(fault);
        self.mode
    }

    /// Says that so many ticks have passed without a call, as a timer has counted them: the joints may have moved on.
    /// Before [`Self::admit`]; of [`super::Observer::predict`] as many calls bring the estimate up to date.
    ///
    /// ```
    /// # use dynamics_core::control::{SafetyLimits, Fault, Mode, Supervisor};
    /// # let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let mut supervisor = Supervisor::new(bounds, 1e-3, 1, 4);
    /// supervisor.admit(Ok(&[0.5]));
    /// supervisor.missed(9); // 3 rad/s for 10 ms are no jump
    /// assert_eq!(supervisor.admit(Ok(&[0.53])), Mode::Full);
    /// assert_eq!(supervisor.admit(Ok(&[0.56])), Mode::Hold);
    /// ```
    #[cold]
    pub fn missed(&mut self, ticks: u32) {
        self.reach += real(ticks);
    }

    /// Whether the positions of this tick were accepted.
    #[inline(always)]
    pub fn seen(&self) -> bool {
        self.seen
    }

    /// Holds the observer's velocities (rad/s, m/s) against their bounds, and returns what the arm
    /// does in this tick. Between [`Self::admit`] and [`Self::pass`].
    ///
    /// ```
    /// # use dynamics_core::control::{SafetyLimits, Mode, Supervisor};
    /// # let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4).riding(5);
    /// assert_eq!(supervisor.admit(Ok(&[0.5])), Mode::Full);
    /// assert_eq!(supervisor.watch(&[-3.1]), Mode::Hold);
    /// ```
    #[inline]
    pub fn watch(&mut self, qd: &[R; V]) -> Mode {
        let slow = |(qd, bound): (&R, &R)| qd.abs() <= *bound;
        let joints = || qd.iter().zip(&self.bounds.speed);
        if !joints().fold(true, |ok, joint| ok & slow(joint)) {
            let joint = joints().position(|joint| !slow(joint)).unwrap_or(V);
            self.faults = self.faults.max(self.ride_ticks);
            self.faulted = false;
            self.raise(Fault::Speed { joint });
        }
        self.mode
    }

    /// Ends a tick: the torques that may go to the drives, of those asked for (N·m, N).
    ///
    /// Limits on torque and rate. A torque that is not finite is a fault: the last torques stand for
    /// all of its tick, and the next tick is a hold unless the fault is ridden through; in a hold, for
    /// which there is then no torque, it stops the arm. After a reset the brake opens when no limit
    /// keeps the torque from being there. A tick without [`Self::admit`] is [`Fault::Stale`].
    ///
    /// Cost: 7 flops and 4 comparisons a joint; the same instructions whatever the data, except on
    /// a fault.
    ///
    /// ```
    /// # use dynamics_core::control::{SafetyLimits, Fault, Mode, Supervisor};
    /// # let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4).riding(5);
    /// supervisor.admit(Ok(&[0.5]));
    /// supervisor.pass(&[7.0]);
    /// supervisor.admit(Ok(&[0.5]));
    /// let command = supervisor.pass(&[f32::NAN]);
    /// assert_eq!((command.torque, command.status.mode), ([7.0], Mode::Full));
    /// assert_eq!(command.status.fault, Some(Fault::Torque { joint: 0 }));
    /// ```
    #[inline]
    pub fn pass(&mut self, tau: &[R; V]) -> Command<R, V> {
        if !self.fresh {
            self.begin();
            self.miss();
            self.raise(Fault::Stale);
        }
        let mut off = R::ZERO;
        let mut torque = [R::ZERO; V];
        let asked = tau.iter().zip(&self.torque);
        let bounds = self.bounds.torque.iter().zip(&self.bounds.rate);
        for ((out, (&tau, &last)), (&most, &rate)) in torque.iter_mut().zip(asked).zip(bounds) {
            let next = tau.clamped(-most, most).clamped(last - rate, last + rate);
            // Zero within the limits; not finite if a torque is not, and otherwise no sum of so many.
            off += (next - tau).abs() * R::from_f64(1.0 / 64.0);
            *out = next;
        }
        if !off.is_finite() {
            self.refuse(tau);
            torque = self.torque;
        }
        if matches!(self.mode, Mode::Stopped) {
            torque = [R::ZERO; V];
        }
        self.torque = torque;
        self.end(torque, off != R::ZERO)
    }

    /// Stops the arm for a reason found outside, as a drive that fails or an emergency stop: before [`Self::pass`] in
    /// the same tick, after it from the next one on. Latched until [`Self::reset`]; the first reason stays. A stop that
    /// is still demanded after a reset is to be called again, every tick.
    ///
    /// ```
    /// # use dynamics_core::control::{SafetyLimits, Fault, Mode, Supervisor};
    /// # let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4).riding(5);
    /// supervisor.admit(Ok(&[0.5]));
    /// supervisor.stop(Fault::External);
    /// let command = supervisor.pass(&[7.0]);
    /// assert_eq!((command.torque, command.brake), ([0.0], true));
    /// assert_eq!(command.status.fault, Some(Fault::External));
    /// ```
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        if !matches!(self.mode, Mode::Stopped) {
            self.mode = Mode::Stopped;
            self.fault = Some(fault);
            self.ramp = 0;
        }
    }

    /// The last positions that were accepted, rad or m; zeros before the first.
    #[inline(always)]
    pub fn last_good(&self) -> &[R; V] {
        &self.last_good
    }

    /// What the arm does in this tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.mode
    }
}
