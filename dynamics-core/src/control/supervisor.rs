//! The safety gate that every measurement and every command passes, and what happens on a fault.
//!
//! ```text
//!            fault                       more than hold_ticks of fault
//!   Full ────────────▶ Hold ──────────────────────────────────────────▶ Stopped
//!    ▲                  │                                                  │
//!    └──────────────────┘ no fault: the full law fades in over             │
//!    ▲                      reentry_ticks                                  │
//!    └─────────────────────────────────────────────────────────────────────┘ reset()
//! ```
//!
//! What is kept from tick to tick (last good positions, last torques, counters) takes in only
//! what was accepted. Useless limits fail on the safe side: a torque limit that is not finite allows
//! no torque, a rate of NaN no change, any other limit of NaN is a fault at once.

use core::fmt;

use super::real;
use crate::scalar::Real;
use crate::state::all_finite;

/// How many times the greatest step at full speed a measurement may be from the last good one. The
/// rest is the encoder's resolution: speed itself is held against the observer's.
const JUMP: f64 = 2.0;

/// Why a measurement or a command was rejected. Joints count from 0.
///
/// ```
/// use dynamics_core::control::Fault;
/// assert_eq!(format!("{}", Fault::Jump { joint: 2 }), "joint 2: its position jumped");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fault {
    /// The encoder reported an error, or its answer was damaged.
    Encoder {
        /// The joint.
        joint: usize,
    },
    /// There is no measurement of this tick.
    Stale,
    /// The measured position is not finite.
    NotFinite {
        /// The joint.
        joint: usize,
    },
    /// The measured position is outside its bounds.
    Position {
        /// The joint.
        joint: usize,
    },
    /// The measured position is further from the last good one than the joint can have moved.
    Jump {
        /// The joint.
        joint: usize,
    },
    /// The joint is faster than it may be.
    Speed {
        /// The joint.
        joint: usize,
    },
    /// The torque asked for is not finite.
    Torque {
        /// The joint.
        joint: usize,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (joint, text) = match *self {
            Self::Stale => return write!(out, "no measurement of this tick"),
            Self::Encoder { joint } => (joint, "its encoder reports an error"),
            Self::NotFinite { joint } => (joint, "its measured position is not finite"),
            Self::Position { joint } => (joint, "its position is outside its bounds"),
            Self::Jump { joint } => (joint, "its position jumped"),
            Self::Speed { joint } => (joint, "it is faster than it may be"),
            Self::Torque { joint } => (joint, "the torque asked for is not finite"),
        };
        write!(out, "joint {joint}: {text}")
    }
}

impl core::error::Error for Fault {}

/// What the arm does, in the order in which faults take it down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// The full control law.
    Full,
    /// Gravity compensation and damping on the last good position.
    Hold,
    /// Zero torque and the brake, until [`Supervisor::reset`].
    Stopped,
}

/// What the supervisor did in a tick, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Status {
    /// What the arm did.
    pub mode: Mode,
    /// The first fault of this tick; in [`Mode::Stopped`] the one that stopped the arm.
    pub fault: Option<Fault>,
    /// A limit on torque or rate took effect.
    pub limited: bool,
}

/// What goes to the drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command<R, const V: usize> {
    /// Torques, N·m or N: finite and within their limits.
    pub torque: [R; V],
    /// Whether the brake is to hold the arm.
    pub brake: bool,
    /// Why so.
    pub status: Status,
}

/// The limits of each joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<R, const V: usize> {
    /// Greatest |τ|, N·m or N.
    pub torque: [R; V],
    /// Greatest change of τ from one tick to the next, N·m or N.
    pub rate: [R; V],
    /// Greatest |q̇|, rad/s or m/s.
    pub speed: [R; V],
    /// Least position, rad or m.
    pub lower: [R; V],
    /// Greatest position, rad or m.
    pub upper: [R; V],
}

/// The safety gate: [`Self::admit`] starts a tick, [`Self::pass`] ends it.
///
/// ```
/// use dynamics_core::control::{Bounds, Fault, Mode, Supervisor};
/// let bounds = Bounds { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
/// let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4);
///
/// assert_eq!(supervisor.admit(Ok(&[0.5])), Mode::Full);
/// assert_eq!(supervisor.pass(&[9.0]).torque, [8.0]); // not more than 8 N·m in one tick
///
/// assert_eq!(supervisor.admit(Ok(&[f32::NAN])), Mode::Hold);
/// assert_eq!(supervisor.last_good(), &[0.5]);
/// let command = supervisor.pass(&[5.0]); // the gravity torque of that position
/// assert_eq!(command.status.fault, Some(Fault::NotFinite { joint: 0 }));
///
/// supervisor.admit(Err(Fault::Encoder { joint: 0 }));
/// supervisor.pass(&[5.0]);
/// assert_eq!(supervisor.admit(Err(Fault::Encoder { joint: 0 })), Mode::Stopped);
/// let command = supervisor.pass(&[5.0]);
/// assert_eq!((command.torque, command.brake), ([0.0], true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Supervisor<R, const V: usize> {
    bounds: Bounds<R, V>,
    /// Greatest plausible change of position in one tick.
    step: [R; V],
    hold_ticks: u32,
    per_hold: R,
    reentry_ticks: u32,
    per_reentry: R,

    last_good: [R; V],
    /// Ticks since the last good position was measured.
    age: u32,
    /// Whether there is a last good position.
    known: bool,
    /// The last torque that was accepted.
    torque: [R; V],
    /// What the full law fades in from.
    base: [R; V],
    /// Ticks with a fault since the last at full authority.
    held: u32,
    /// Ticks without a fault since the last with one, up to `reentry_ticks`.
    ramp: u32,
    mode: Mode,
    fault: Option<Fault>,
    /// There was a fault in this tick.
    faulted: bool,
    /// There was an `admit` in this tick.
    fresh: bool,
    /// The brake waits for the torque to be back after a stop.
    braked: bool,
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// A supervisor of an arm that holds itself, at full authority from the first tick; the torque
    /// rises from zero at the rate allowed. Call [`Self::reset`] first for an arm on its brake.
    ///
    /// `tick` is the nominal length of a tick in s. A fault that lasts for more than `hold_ticks`
    /// ticks, or comes back so often without `reentry_ticks` good ticks in between, stops the arm.
    pub fn new(bounds: Bounds<R, V>, tick: R, hold_ticks: u32, reentry_ticks: u32) -> Self {
        // Comparisons with NaN are false, so that a limit of NaN allows nothing.
        let allowed = |x| if x > R::ZERO { x } else { R::ZERO };
        let finite = |x: R| if x.is_finite() { allowed(x) } else { R::ZERO };
        Self {
            bounds: Bounds {
                torque: bounds.torque.map(finite),
                rate: bounds.rate.map(allowed),
                ..bounds
            },
            step: bounds.speed.map(|speed| R::from_f64(JUMP) * speed * tick),
            hold_ticks,
            per_hold: R::ONE / real(hold_ticks.max(1)),
            reentry_ticks,
            per_reentry: R::ONE / real(reentry_ticks.max(1)),
            last_good: [R::ZERO; V],
            age: 1,
            known: false,
            torque: [R::ZERO; V],
            base: [R::ZERO; V],
            held: 0,
            ramp: reentry_ticks,
            mode: Mode::Full,
            fault: None,
            faulted: false,
            fresh: false,
            braked: false,
        }
    }

    /// Starts a tick with the positions measured in it (rad, m), or why there are none, and returns
    /// what the arm does in it.
    ///
    /// Accepted are finite positions within their bounds and within reach of the last good ones: up
    /// to twice the greatest speed times the ticks since. Without any good position yet there is
    /// nothing to hold: a fault stops the arm at once.
    ///
    /// Cost: 5 flops and 3 comparisons a joint; the same instructions whatever the data, except on
    /// a fault.
    #[inline]
    pub fn admit(&mut self, measured: Result<&[R; V], Fault>) -> Mode {
        self.begin();
        let fault = match measured {
            Ok(q) if self.plausible(q) => {
                self.last_good = *q;
                self.known = true;
                self.age = 1;
                return self.mode;
            }
            Ok(q) => self.blame(q),
            Err(fault) => fault,
        };
        self.age = self.age.saturating_add(1);
        self.raise(fault);
        self.mode
    }

    /// Holds the observer's velocities (rad/s, m/s) against their bounds, and returns what the arm
    /// does in this tick. Between [`Self::admit`] and [`Self::pass`].
    ///
    /// ```
    /// # use dynamics_core::control::{Bounds, Mode, Supervisor};
    /// # let bounds = Bounds { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4);
    /// assert_eq!(supervisor.admit(Ok(&[0.5])), Mode::Full);
    /// assert_eq!(supervisor.watch(&[-3.1]), Mode::Hold);
    /// ```
    #[inline]
    pub fn watch(&mut self, qd: &[R; V]) -> Mode {
        let slow = |(qd, bound): (&R, &R)| qd.abs() <= *bound;
        let joints = || qd.iter().zip(&self.bounds.speed);
        if !joints().fold(true, |ok, joint| ok & slow(joint)) {
            let joint = joints().position(|joint| !slow(joint)).unwrap_or(V);
            self.raise(Fault::Speed { joint });
        }
        self.mode
    }

    /// Ends a tick: the torques that may go to the drives, of those asked for (N·m, N).
    ///
    /// Limits on torque and rate; after a hold the full law fades in from the torque that held the
    /// arm; after a stop the brake opens when the torque is there. A torque that is not finite makes
    /// all torques of its tick zero, and a fault. A tick without [`Self::admit`] is
    /// [`Fault::Stale`].
    ///
    /// Cost: 8 flops and 6 comparisons a joint; the same instructions whatever the data, except on
    /// a fault.
    ///
    /// ```
    /// # use dynamics_core::control::{Bounds, Fault, Mode, Supervisor};
    /// # let bounds = Bounds { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4);
    /// supervisor.admit(Ok(&[0.5]));
    /// let command = supervisor.pass(&[f32::NAN]);
    /// assert_eq!(command.torque, [0.0]);
    /// assert_eq!(command.status.fault, Some(Fault::Torque { joint: 0 }));
    /// ```
    #[inline]
    pub fn pass(&mut self, tau: &[R; V]) -> Command<R, V> {
        if !self.fresh {
            self.begin();
            self.raise(Fault::Stale);
        }
        let finite = all_finite(tau);
        if !finite {
            let joint = tau.iter().position(|tau| !tau.is_finite()).unwrap_or(V);
            self.raise(Fault::Torque { joint });
        }
        let full = matches!(self.mode, Mode::Full);
        let stopped = matches!(self.mode, Mode::Stopped);
        let live = finite & !stopped;
        let share = if full { self.authority() } else { R::ONE };
        let rest = R::ONE - share;

        let (mut limited, mut behind) = (false, false);
        let mut torque = [R::ZERO; V];
        let asked = tau.iter().zip(&self.base);
        let kept = self.torque.iter();
        let bounds = self.bounds.torque.iter().zip(&self.bounds.rate);
        for (((out, (&tau, &base)), &last), (&most, &rate)) in
            torque.iter_mut().zip(asked).zip(kept).zip(bounds)
        {
            // The zero makes −0 + 0 and 0 + 0 the same bits: no trace of the base at full share.
            let wanted = (tau * share + base * rest) + R::ZERO;
            let bounded = wanted.limit(-most, most);
            let next = bounded.limit(last - rate, last + rate);
            limited |= next != wanted;
            behind |= next != bounded;
            *out = if live { next } else { R::ZERO };
        }
        if finite {
            self.torque = torque;
            if !full {
                self.base = torque;
            }
        }
        let whole = full & (share == R::ONE);
        self.braked &= !whole | behind;
        self.ramp = if full { self.next_ramp() } else { self.ramp };
        self.held = if whole { 0 } else { self.held };
        self.fresh = false;
        self.faulted = false;
        Command {
            torque,
            brake: stopped | self.braked,
            status: Status {
                mode: self.mode,
                fault: self.fault,
                limited: limited & live,
            },
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

    /// The share of the full law in this tick's command, 0 to 1; the rest is the torque that held
    /// the arm before.
    ///
    /// ```
    /// # use dynamics_core::control::{Bounds, Fault, Supervisor};
    /// # let bounds = Bounds { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4);
    /// for (measured, share) in [(Ok(&[0.5]), 1.0), (Err(Fault::Stale), 0.0), (Ok(&[0.5]), 0.25)] {
    ///     supervisor.admit(measured);
    ///     assert_eq!(supervisor.authority(), share);
    ///     supervisor.pass(&[1.0]);
    /// }
    /// ```
    #[inline(always)]
    pub fn authority(&self) -> R {
        let ramp = self.next_ramp();
        let share = if ramp >= self.reentry_ticks {
            R::ONE
        } else {
            real::<R>(ramp) * self.per_reentry
        };
        if matches!(self.mode, Mode::Full) {
            share
        } else {
            R::ZERO
        }
    }

    /// The factor of the damping in [`Mode::Hold`], 1 to 0 over `hold_ticks`: the velocity it acts
    /// on is the older the longer the fault lasts.
    ///
    /// ```
    /// # use dynamics_core::control::{Bounds, Fault, Supervisor};
    /// # let bounds = Bounds { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4);
    /// for (measured, fade) in [(Ok(&[0.5]), 1.0), (Err(Fault::Stale), 0.5), (Err(Fault::Stale), 0.0)] {
    ///     supervisor.admit(measured);
    ///     assert_eq!(supervisor.hold_fade(), fade);
    ///     supervisor.pass(&[1.0]);
    /// }
    /// ```
    #[inline(always)]
    pub fn hold_fade(&self) -> R {
        match self.mode {
            Mode::Full => R::ONE,
            Mode::Hold => real::<R>(self.hold_ticks.saturating_sub(self.held)) * self.per_hold,
            Mode::Stopped => R::ZERO,
        }
    }

    /// Starts again, from zero torque on the brake: clears a latched fault and takes the next
    /// plausible positions as they are. The brake opens when the full law has faded in.
    ///
    /// ```
    /// # use dynamics_core::control::{Bounds, Fault, Mode, Supervisor};
    /// # let bounds = Bounds { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let mut supervisor = Supervisor::new(bounds, 1e-3, 0, 2);
    /// assert_eq!(supervisor.admit(Err(Fault::Stale)), Mode::Stopped);
    /// supervisor.reset();
    /// for (torque, brake) in [([2.0], true), ([4.0], false)] {
    ///     assert_eq!(supervisor.admit(Ok(&[0.5])), Mode::Full);
    ///     let command = supervisor.pass(&[4.0]);
    ///     assert_eq!((command.torque, command.brake), (torque, brake));
    /// }
    /// ```
    pub fn reset(&mut self) {
        self.known = false;
        self.age = 1;
        self.torque = [R::ZERO; V];
        self.base = [R::ZERO; V];
        self.held = 0;
        self.ramp = 0;
        self.mode = Mode::Full;
        self.fault = None;
        self.faulted = false;
        self.fresh = false;
        self.braked = true;
    }

    #[inline(always)]
    fn begin(&mut self) {
        self.fresh = true;
        let clear = !self.faulted & !matches!(self.mode, Mode::Stopped);
        self.mode = if clear { Mode::Full } else { self.mode };
        self.fault = if clear { None } else { self.fault };
    }

    #[inline(always)]
    fn next_ramp(&self) -> u32 {
        self.ramp.saturating_add(1).min(self.reentry_ticks)
    }

    #[inline(always)]
    fn plausible(&self, q: &[R; V]) -> bool {
        let reach = real::<R>(self.age);
        let ranges = self.bounds.lower.iter().zip(&self.bounds.upper);
        let steps = self.last_good.iter().zip(&self.step);
        let mut ok = all_finite(q);
        for ((&q, (&lower, &upper)), (&last, &step)) in q.iter().zip(ranges).zip(steps) {
            let near = (q - last).abs() <= step * reach;
            ok &= (lower <= q) & (q <= upper) & (near | !self.known);
        }
        ok
    }

    /// What is wrong with positions that are not plausible, the worst first.
    #[cold]
    fn blame(&self, q: &[R; V]) -> Fault {
        if let Some(joint) = q.iter().position(|q| !q.is_finite()) {
            return Fault::NotFinite { joint };
        }
        let ranges = self.bounds.lower.iter().zip(&self.bounds.upper);
        let inside = |(q, (lower, upper)): (&R, (&R, &R))| lower <= q && q <= upper;
        if let Some(joint) = q.iter().zip(ranges).position(|joint| !inside(joint)) {
            return Fault::Position { joint };
        }
        let reach = real::<R>(self.age);
        let steps = self.last_good.iter().zip(&self.step);
        let near = |(&q, (&last, &step)): (&R, (&R, &R))| (q - last).abs() <= step * reach;
        let joint = q.iter().zip(steps).position(|joint| !near(joint));
        Fault::Jump {
            joint: joint.unwrap_or(V),
        }
    }

    #[cold]
    fn raise(&mut self, fault: Fault) {
        if matches!(self.mode, Mode::Stopped) {
            return;
        }
        if !self.faulted {
            self.faulted = true;
            self.fault = Some(fault);
            self.held = self.held.saturating_add(1);
        }
        if matches!(self.mode, Mode::Full) {
            self.base = self.torque;
        }
        self.ramp = 0;
        let hold = self.known & (self.held <= self.hold_ticks);
        self.mode = if hold { Mode::Hold } else { Mode::Stopped };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds<f32, 2> = Bounds {
        torque: [10.0, 5.0],
        rate: [4.0, 4.0],
        speed: [2.0, 2.0],
        lower: [-1.0, -1.0],
        upper: [1.0, 1.0],
    };
    const TICK: f32 = 0.01;
    const HOLD: u32 = 3;
    const REENTRY: u32 = 4;

    fn supervisor() -> Supervisor<f32, 2> {
        Supervisor::new(BOUNDS, TICK, HOLD, REENTRY)
    }

    /// A tick with good positions.
    fn good(supervisor: &mut Supervisor<f32, 2>, tau: [f32; 2]) -> Command<f32, 2> {
        let q = *supervisor.last_good();
        supervisor.admit(Ok(&q));
        supervisor.pass(&tau)
    }

    fn bad(supervisor: &mut Supervisor<f32, 2>, tau: [f32; 2]) -> Command<f32, 2> {
        supervisor.admit(Err(Fault::Encoder { joint: 1 }));
        supervisor.pass(&tau)
    }

    #[test]
    fn torque_and_rate_are_limited_and_said_so() {
        let mut supervisor = supervisor();
        for (expected, limited) in [
            ([4.0, -4.0], true),
            ([8.0, -5.0], true),
            ([10.0, -5.0], true),
        ] {
            let command = good(&mut supervisor, [20.0, -20.0]);
            assert_eq!(
                (command.torque, command.status.limited),
                (expected, limited)
            );
        }
        let command = good(&mut supervisor, [9.0, -4.5]);
        assert_eq!(
            (command.torque, command.status.limited),
            ([9.0, -4.5], false)
        );
        assert_eq!((command.brake, command.status.fault), (false, None));
    }

    #[test]
    fn each_fault_names_its_joint() {
        let joint = 1;
        for (q, fault) in [
            ([0.0, f32::NAN], Fault::NotFinite { joint }),
            ([0.0, f32::NEG_INFINITY], Fault::NotFinite { joint }),
            ([0.0, 1.01], Fault::Position { joint }),
            ([0.0, -1.01], Fault::Position { joint }),
            ([0.0, 0.041], Fault::Jump { joint }),
        ] {
            let mut supervisor = supervisor();
            good(&mut supervisor, [0.0; 2]);
            assert_eq!(supervisor.admit(Ok(&q)), Mode::Hold);
            assert_eq!(supervisor.last_good(), &[0.0; 2]);
            assert_eq!(supervisor.pass(&[0.0; 2]).status.fault, Some(fault));
        }
        let mut supervisor = supervisor();
        good(&mut supervisor, [0.0; 2]);
        supervisor.admit(Ok(&[0.0, 0.039]));
        assert_eq!(supervisor.watch(&[2.0, -2.01]), Mode::Hold);
        assert_eq!(
            supervisor.pass(&[0.0; 2]).status.fault,
            Some(Fault::Speed { joint })
        );
        supervisor.admit(Ok(&[0.0; 2]));
        assert_eq!(supervisor.watch(&[f32::NAN, 0.0]), Mode::Hold);
        let status = supervisor.pass(&[0.0; 2]).status;
        assert_eq!(status.fault, Some(Fault::Speed { joint: 0 }));
    }

    #[test]
    fn a_lasting_fault_goes_from_full_to_hold_to_stopped_and_stays_there() {
        let mut supervisor = supervisor();
        good(&mut supervisor, [3.0; 2]);
        for fade in [2.0 / 3.0, 1.0 / 3.0, 0.0] {
            supervisor.admit(Err(Fault::Stale));
            assert_eq!(
                (supervisor.mode(), supervisor.authority()),
                (Mode::Hold, 0.0)
            );
            assert!((supervisor.hold_fade() - fade).abs() < 1e-6);
            let command = supervisor.pass(&[2.0; 2]);
            assert_eq!((command.torque, command.brake), ([2.0; 2], false));
        }
        let stopped = |command: Command<f32, 2>| {
            assert_eq!((command.torque, command.brake), ([0.0; 2], true));
            assert_eq!(command.status.mode, Mode::Stopped);
            assert_eq!(command.status.fault, Some(Fault::Encoder { joint: 1 }));
        };
        stopped(bad(&mut supervisor, [2.0; 2]));
        for _ in 0..10 {
            stopped(good(&mut supervisor, [2.0; 2]));
        }
        stopped(good(&mut supervisor, [f32::NAN; 2]));
        assert_eq!(supervisor.hold_fade(), 0.0);
    }

    #[test]
    fn the_full_law_fades_in_from_the_torque_that_held_the_arm() {
        let mut supervisor = supervisor();
        good(&mut supervisor, [3.0; 2]);
        bad(&mut supervisor, [2.0; 2]);
        for expected in [2.5, 3.0, 3.5, 4.0, 4.0] {
            let command = good(&mut supervisor, [4.0; 2]);
            assert_eq!(
                (command.torque, command.status.limited),
                ([expected; 2], false)
            );
        }
    }

    #[test]
    fn a_fault_that_keeps_coming_back_stops_the_arm() {
        let mut supervisor = supervisor();
        good(&mut supervisor, [0.0; 2]);
        let mut modes = (0..HOLD + 1).map(|_| {
            for _ in 1..REENTRY {
                assert_eq!(good(&mut supervisor, [0.0; 2]).status.mode, Mode::Full);
            }
            bad(&mut supervisor, [0.0; 2]).status.mode
        });
        assert!(modes.by_ref().take(3).all(|mode| mode == Mode::Hold));
        assert_eq!(modes.next(), Some(Mode::Stopped));
    }

    #[test]
    fn good_ticks_up_to_full_authority_forget_a_fault() {
        let mut supervisor = supervisor();
        good(&mut supervisor, [0.0; 2]);
        for _ in 0..20 {
            assert_eq!(bad(&mut supervisor, [0.0; 2]).status.mode, Mode::Hold);
            for _ in 0..REENTRY {
                good(&mut supervisor, [0.0; 2]);
            }
        }
    }

    #[test]
    fn a_torque_that_is_no_number_is_zero_in_all_joints_and_not_remembered() {
        let mut supervisor = supervisor();
        good(&mut supervisor, [4.0; 2]);
        let command = good(&mut supervisor, [4.0, f32::NAN]);
        assert_eq!((command.torque, command.status.limited), ([0.0; 2], false));
        assert_eq!(command.status.fault, Some(Fault::Torque { joint: 1 }));
        assert_eq!(command.status.mode, Mode::Hold);
        assert_eq!(good(&mut supervisor, [4.0; 2]).torque, [4.0; 2]);
    }

    #[test]
    fn a_tick_without_a_measurement_is_stale() {
        let mut supervisor = supervisor();
        good(&mut supervisor, [1.0; 2]);
        let status = supervisor.pass(&[1.0; 2]).status;
        assert_eq!(
            (status.mode, status.fault),
            (Mode::Hold, Some(Fault::Stale))
        );
    }

    #[test]
    fn without_any_good_position_a_fault_stops_the_arm_at_once() {
        let mut supervisor = supervisor();
        assert_eq!(supervisor.admit(Ok(&[2.0; 2])), Mode::Stopped);
        supervisor.reset();
        assert_eq!(supervisor.admit(Ok(&[0.9; 2])), Mode::Full);
    }

    #[test]
    fn the_reach_of_a_joint_grows_with_the_ticks_that_were_lost() {
        let mut supervisor = supervisor();
        good(&mut supervisor, [0.0; 2]);
        bad(&mut supervisor, [0.0; 2]);
        assert_eq!(supervisor.admit(Ok(&[0.07; 2])), Mode::Full);
        supervisor.pass(&[0.0; 2]);
        assert_eq!(supervisor.admit(Ok(&[0.12; 2])), Mode::Hold);
    }

    #[test]
    fn after_a_reset_the_brake_waits_for_the_torque() {
        let mut supervisor = supervisor();
        supervisor.reset();
        let mut brakes = [true; 8];
        for brake in &mut brakes {
            supervisor.admit(Ok(&[0.5; 2]));
            *brake = supervisor.pass(&[10.0, 0.0]).brake;
        }
        assert_eq!(
            brakes,
            [true, true, true, false, false, false, false, false]
        );
        // A rate that is slower than the ramp makes it wait longer.
        supervisor.bounds.rate = [1.5; 2];
        supervisor.reset();
        for _ in 0..6 {
            supervisor.admit(Ok(&[0.5; 2]));
            assert!(supervisor.pass(&[10.0, 0.0]).brake);
        }
        supervisor.admit(Ok(&[0.5; 2]));
        assert!(!supervisor.pass(&[10.0, 0.0]).brake);
    }

    #[test]
    fn useless_limits_allow_nothing() {
        for bad in [f32::NAN, -1.0] {
            for which in 0..5 {
                let mut bounds = BOUNDS;
                let field = match which {
                    0 => &mut bounds.torque,
                    1 => &mut bounds.rate,
                    2 => &mut bounds.speed,
                    3 => &mut bounds.upper,
                    _ => &mut bounds.lower,
                };
                *field = [bad; 2];
                let mut supervisor = Supervisor::new(bounds, TICK, HOLD, REENTRY);
                for _ in 0..2 {
                    supervisor.admit(Ok(&[0.0; 2]));
                    supervisor.watch(&[0.0; 2]);
                    let command = supervisor.pass(&[1.0; 2]);
                    // −1 rad is a good lower bound.
                    let torque = if which == 4 && bad == -1.0 { 1.0 } else { 0.0 };
                    let held = which == 2 && command.status.mode == Mode::Hold;
                    assert!(command.torque == [torque; 2] || held, "{which} {command:?}");
                }
            }
        }
    }
}
