//! The safety gate that every measurement and every command passes, and the reaction to faults.
//!
//! ```text
//!          more than ride_through_ticks of fault   hold_ticks more
//!   Full ────────────────────────────────▶ Hold ───────────────▶ Stopped
//!    ▲                                      │                       │
//!    └──────────────────────────────────────┘ no fault              │
//!    ▲         authority() rises over reentry_ticks                 │
//!    └──────────────────────────────────────────────────────────────┘ reset()
//! ```
//!
//! [`StopCategory`](crate::safety::StopCategory) chooses what `Hold` and `Stopped` are for an arm.
//! Ticks with a fault are counted until `reentry_ticks` consecutive ticks had none. The state from
//! tick to tick (last good positions, last torques, counters) is updated only by accepted values.
//!
//! | state | mode | leads to |
//! |---|---|---|
//! | `Full` | `Full` | `Held`, `Torqueless`, `Stopping`, `Stopped` |
//! | `Held` | `Hold` | `Full` in the first tick without a fault; `Stopping`, `Stopped` |
//! | `Torqueless` | `Hold` | `Held` in the next tick; `Stopping`, `Stopped` |
//! | `Stopping` | `Hold` | `Stopped` or `Standing` after `hold_ticks` |
//! | `Standing` | `Hold` | `Held` by a release; `Stopped` |
//! | `Stopped` | `Stopped` | `Full` by a reset |
//! | `Unusable` | `Stopped` | |
//!
//! A reset leads from every state but `Unusable` to `Full`.

use crate::limits::{
    Circles, Command, ConfigError, ConfigParameter, Fault, Mode, Reaction, SafetyLimits, Status,
};
use crate::safety::stop_category::{Ending, StopRequest, Stopping};
use crate::{entry, real};
use dynamics_core::scalar::Real;

mod relimit;
mod stop;
#[cfg(test)]
mod tests;

/// The greatest plausible distance of a measurement from the last accepted one, in steps at full
/// speed; the resolution of the encoder is added. Speed itself is checked with the velocity of the
/// observer.
const JUMP: f64 = 2.0;
/// A position beyond this counts as infinite, in f64 too.
const FAR: f64 = f32::MAX as f64;
/// Beyond this, rad, f32 has no sine accurate to 10⁻⁷: positions beyond it are rejected for all
/// limits. For a joint that is a circle, the angle within a turn is measured,
/// `MultiTurnEncoder::within_turn` of `joint-drivers`.
const RANGE: f64 = 1e4;
/// The angle of a circle, rad, beyond which positions in f64 are rejected: its turns are subtracted.
const FAR_ANGLE: f64 = 1e8;

/// Value of `ramp` during a stop if the current tick has a fault: the increment at the begin of the
/// next tick wraps it to zero, so that this tick does not count as a good one.
const NOT_COUNTED: u32 = u32::MAX;

/// The parameters of the safety gate of a [`MotionController`](crate::motion::MotionController):
/// those of the arm and of the loop.
///
/// ```
/// use motion_control::{limits::SafetyLimits, safety::SupervisorConfig};
/// let config = SupervisorConfig {
///     limits: SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
///     tick: 1e-3,
///     resolution: core::f32::consts::TAU / 16_384.0, // 14 bits
///     ride_through_ticks: 5,
///     hold_ticks: 100,
///     reentry_ticks: 200,
/// };
/// assert_eq!(config.check(), Ok(()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SupervisorConfig<R, const V: usize> {
    /// The limits of each joint.
    pub limits: SafetyLimits<R, V>,
    /// Nominal length of a tick, s.
    pub tick: R,
    /// Step of the encoders, rad or m, by which a slow joint may seem to exceed its greatest speed;
    /// zero for none.
    pub resolution: R,
    /// Ticks with a fault for which the arm stays in [`Mode::Full`]: the prediction of an observer
    /// replaces the measurements, and the last torque replaces a torque that is not finite.
    /// Excessive speed has no ride-through.
    pub ride_through_ticks: u32,
    /// Ticks with a fault after those for which the arm is held, before it is stopped.
    pub hold_ticks: u32,
    /// Consecutive ticks without a fault after which earlier faults are no longer counted, and
    /// ticks of the return to the trajectory.
    pub reentry_ticks: u32,
}

impl<R: Real, const V: usize> SupervisorConfig<R, V> {
    /// Checks that every number is within its range and that every limit allows some motion or
    /// torque.
    ///
    /// # Errors
    /// [`ConfigError`]; if a limit is wrong, with the joint, the limit and its value.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::Tick.positive(self.tick)?;
        let step = self.resolution;
        ConfigParameter::Resolution.require(step.is_finite() & (step >= R::ZERO))?;
        Ok(self.limits.check()?)
    }
}

/// The supervisor's action on the arm, from tick to tick.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// The torque of the law was not finite: the arm is held in the next tick, whatever is
    /// measured.
    Torqueless,
    /// The full law; faults are ridden through.
    Full,
    /// A fault outlasted the ride-through: the arm is held until a tick has none.
    Held,
    /// A controlled stop: the arm is decelerated for `ticks` more, whatever is measured.
    Stopping { required: StopRequest, ending: Ending, ticks: u32 },
    /// Category 2 after the deceleration: the arm is held until it is released.
    Standing(StopRequest),
    /// Zero torque and the brake, or a damping, until a reset.
    Stopped { lowers: bool },
    /// The limits allow no motion or torque: zero torque and the brake, for ever.
    Unusable(Fault),
}

impl State {
    #[inline(always)]
    fn mode(&self) -> Mode {
        match self {
            Self::Full => Mode::Full,
            Self::Held | Self::Torqueless | Self::Stopping { .. } | Self::Standing(_) => Mode::Hold,
            Self::Stopped { .. } | Self::Unusable(_) => Mode::Stopped,
        }
    }

    /// The controlled stop that was required from outside, and what follows its deceleration.
    fn required(&mut self) -> Option<(&mut StopRequest, Ending)> {
        match self {
            Self::Stopping { required, ending, .. } => Some((required, *ending)),
            Self::Standing(required) => Some((required, Ending::Hold)),
            Self::Full
            | Self::Held
            | Self::Torqueless
            | Self::Stopped { .. }
            | Self::Unusable(_) => None,
        }
    }
}

/// The safety gate that every measurement and every torque passes in each tick. Its steps are
/// [`Self::accept_positions`] or [`Self::accept_fault`], then [`Self::check_speed`], then
/// [`Self::gate`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Supervisor<R, const V: usize> {
    /// Greatest torque, the least of the limits and of what the motors bear; its greatest change in a
    /// tick, and greatest speed.
    torque_limit: [R; V],
    /// The limits of torque of the configuration, which no other lifts; those without the motors',
    /// and whether the motors' are given in each tick.
    configured_torque: [R; V],
    limits_torque: [R; V],
    is_thermal: bool,
    rate_limit: [R; V],
    speed_limit: [R; V],
    /// Middle and half width of the range of positions.
    middle: [R; V],
    half: [R; V],
    /// Greatest plausible change of position in one tick.
    plausible_step: [R; V],
    /// Ticks since the last good position; very many before the first.
    ticks_since_good: R,
    ride_through_ticks: u32,
    hold_ticks: u32,
    reentry_ticks: u32,
    reentry_inv: R,

    last_good: [R; V],
    /// The positions of this tick were accepted.
    accepted: bool,
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
    state: State,
    /// The first fault of this tick, or the one that stopped the arm.
    fault: Option<Fault>,
    /// There was a fault in this tick.
    faulted: bool,
    /// A tick has begun and has no torque yet.
    open: bool,
    /// The brake waits for the torque to be there after a reset.
    braked: bool,
    stopping: Stopping<R, V>,
    /// The fault of [`Self::report`] for the next tick.
    reported: Option<Fault>,
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// A supervisor of an arm that holds its position, at full authority from the first tick; the
    /// torque rises from zero at the allowed rate.
    ///
    /// If a limit allows no motion or torque ([`SafetyLimits::check`]), the arm is stopped by
    /// [`Fault::Limits`], and a reset does not restart it. If the tick is not a positive number, no
    /// step of the joints is plausible; a resolution that is not a positive number is treated as
    /// zero.
    pub(crate) fn new(config: SupervisorConfig<R, V>) -> Self {
        let (limits, tick) = (&config.limits, config.tick);
        let unusable = limits.check().err().map(|error| Fault::Limits { joint: error.joint() });
        // Comparisons with NaN are false, so that a limit of NaN allows nothing.
        let allowed = |x| if x > R::ZERO { x } else { R::ZERO };
        let finite = |x: R| if x.is_finite() { allowed(x) } else { R::ZERO };
        let Ranges { middle, half } = Ranges::of(limits);
        let resolution = allowed(config.resolution);
        Self {
            torque_limit: limits.torque.map(finite),
            configured_torque: limits.torque.map(finite),
            limits_torque: limits.torque.map(finite),
            is_thermal: false,
            rate_limit: limits.rate.map(allowed),
            speed_limit: limits.speed,
            middle,
            half,
            plausible_step: limits.speed.map(|speed| step(speed, tick) + resolution),
            ticks_since_good: R::from_f64(FAR),
            ride_through_ticks: config.ride_through_ticks,
            hold_ticks: config.hold_ticks,
            reentry_ticks: config.reentry_ticks,
            reentry_inv: R::ONE / real(config.reentry_ticks.max(1)),
            last_good: [R::ZERO; V],
            accepted: false,
            known: false,
            torque: [R::ZERO; V],
            faults: 0,
            quiet: config.reentry_ticks,
            ramp: config.reentry_ticks,
            state: match unusable {
                None => State::Full,
                Some(fault) => State::Unusable(fault),
            },
            fault: unusable,
            faulted: false,
            open: false,
            braked: false,
            stopping: Stopping::new(),
            reported: None,
        }
    }

    /// This supervisor for an arm that is on its brake: stopped without a fault until
    /// [`Self::reset`].
    pub(crate) fn on_brake(mut self) -> Self {
        if matches!(self.state, State::Full) {
            self.state = self.stopping.stopped(self.stopping.configured);
        }
        self.ramp = 0;
        self
    }

    /// Refuses the range of a joint, for ever.
    #[cold]
    pub(crate) fn refuse(&mut self, joint: usize) {
        let fault = Fault::Limits { joint };
        (self.state, self.fault) = (State::Unusable(fault), Some(fault));
    }

    /// The measured positions, of circles within half a turn of the middles of their ranges; the
    /// last good ones of circles without a range follow by whole turns. `None` if a number has lost
    /// the digits of its angle, or is none.
    pub(crate) fn turn_to(&mut self, circles: Circles, q: &[R; V]) -> Option<[R; V]> {
        let far = R::select(FAR_ANGLE, RANGE as f32);
        if !q.iter().all(|q| q.abs() <= far) {
            return None;
        }
        let q = circles.near(q, &self.middle);
        self.last_good = circles.near(&self.last_good, &self.centres(&q));
        Some(q)
    }

    /// [`Circles::centres`] in the ranges of the positions.
    pub(crate) fn centres(&self, q: &[R; V]) -> [R; V] {
        Circles::centres(&self.middle, &self.half, q)
    }

    /// Whether any positions were accepted since the start or the last reset.
    #[inline(always)]
    pub(crate) fn knows_positions(&self) -> bool {
        self.known
    }

    /// Reports ticks that have passed without a call, as counted by a timer: the joints may have
    /// moved.
    #[cold]
    pub(crate) fn missed(&mut self, ticks: u32) {
        self.ticks_since_good += real(ticks);
    }

    /// Whether the positions of the last tick were accepted.
    #[inline(always)]
    pub(crate) fn measurement_accepted(&self) -> bool {
        self.accepted
    }

    /// The greatest number of ticks for which a fault may last before the arm is stopped.
    pub(crate) fn longest_fault(&self) -> u32 {
        self.ride_through_ticks.saturating_add(self.hold_ticks)
    }

    /// The mode of the arm: that of the last tick, or of a stop since.
    #[inline(always)]
    pub(crate) fn mode(&self) -> Mode {
        self.state.mode()
    }

    /// Starts a tick with its measured positions. [`Self::gate`] must follow.
    #[inline(always)]
    pub(crate) fn accept_positions(&mut self, q: &[R; V]) {
        self.begin();
        if self.plausible(q) {
            self.last_good = *q;
            self.accepted = true;
            self.known = true;
            self.ticks_since_good = R::ONE;
        } else {
            self.no_measurement(self.diagnose(q));
        }
    }

    /// As [`Self::accept_positions`], with the fault that prevented them: a function of its own, so
    /// that the usual tick has no case for it.
    #[cold]
    #[inline(never)]
    pub(crate) fn accept_fault(&mut self, fault: Fault) {
        self.begin();
        self.no_measurement(fault);
        // Measurements that come again do not end a fault that stops the arm.
        if !matches!(fault.reaction(), Reaction::RideThrough) {
            self.react(fault);
        }
    }

    /// Compares the observer's velocities with their limits, before [`Self::gate`].
    #[inline]
    pub(crate) fn check_speed(&mut self, qd: &[R; V]) -> Mode {
        let slow = |(qd, limit): (&R, &R)| qd.abs() <= *limit;
        let joints = || qd.iter().zip(&self.speed_limit);
        if !joints().fold(true, |ok, joint| ok & slow(joint)) {
            let joint = joints().position(|joint| !slow(joint)).unwrap_or(V);
            self.faults = self.faults.max(self.ride_through_ticks);
            self.faulted = false;
            self.record_fault(Fault::Speed { joint });
        }
        self.mode()
    }

    /// Ends a tick: limits the torques of the law and returns the command to the drives. The
    /// velocities damp a stopped arm that sinks.
    #[inline]
    pub(crate) fn gate(&mut self, tau: &[R; V], qd: &[R; V]) -> Command<R, V> {
        let mut off = R::ZERO;
        let mut torque = [R::ZERO; V];
        let wanted = tau.iter().zip(&self.torque);
        let limits = self.torque_limit.iter().zip(&self.rate_limit);
        for ((out, (&tau, &last)), (&most, &rate)) in torque.iter_mut().zip(wanted).zip(limits) {
            let next = tau.clamped(-most, most).clamped(last - rate, last + rate);
            // Zero if no torque was limited, and not finite if a torque is not; the factor keeps
            // the sum of finite terms from overflowing.
            off += (next - tau).abs() * R::from_f64(1.0 / 64.0);
            *out = next;
        }
        if !off.is_finite() {
            self.reject_torque(tau);
            torque = self.repeated();
        }
        let limited = off != R::ZERO;
        if matches!(self.state, State::Full) {
            self.torque = torque;
            return self.end(Mode::Full, torque, limited);
        }
        if !matches!(self.mode(), Mode::Stopped) {
            self.torque = torque;
        }
        self.command_otherwise(qd, limited)
    }

    /// The last torque again, towards a limit that has fallen since.
    #[cold]
    fn repeated(&self) -> [R; V] {
        let mut torque = self.torque;
        let limits = self.torque_limit.iter().zip(&self.rate_limit);
        for (tau, (&most, &rate)) in torque.iter_mut().zip(limits) {
            *tau = tau.clamped(-most, most).clamped(*tau - rate, *tau + rate);
        }
        torque
    }

    /// The command of an arm that is held or stopped: a function of its own, so that the usual tick
    /// has no case for it.
    #[cold]
    #[inline(never)]
    fn command_otherwise(&mut self, qd: &[R; V], limited: bool) -> Command<R, V> {
        if matches!(self.mode(), Mode::Stopped) {
            return self.stopped_command(qd);
        }
        self.end(Mode::Hold, self.torque, limited)
    }

    #[inline(always)]
    fn begin(&mut self) {
        if self.open {
            self.unfinished();
        }
        self.open = true;
        if !matches!(self.state, State::Full | State::Held) {
            self.begin_otherwise();
        } else if !self.faulted {
            self.state = State::Full;
            self.fault = None;
        }
    }

    /// The begin of a tick in the states that the usual tick does not know: out of its machine
    /// code, which would have a table of jumps.
    #[cold]
    #[inline(never)]
    fn begin_otherwise(&mut self) {
        match self.state {
            State::Torqueless => self.state = State::Held,
            State::Stopping { required, ending, ticks } => {
                self.continue_stop(required, ending, ticks)
            }
            State::Standing(required) => self.stand(required),
            State::Full | State::Held | State::Stopped { .. } | State::Unusable(_) => {}
        }
    }

    #[inline(always)]
    fn end(&mut self, mode: Mode, torque: [R; V], limited: bool) -> Command<R, V> {
        let stopped = matches!(mode, Mode::Stopped);
        let full = matches!(mode, Mode::Full);
        let moving = full & !self.braked;
        self.braked &= !full | limited;
        // Sums and products for the same instructions during the return as after it.
        self.ramp += u32::from(moving & (self.ramp < self.reentry_ticks));
        let quiet = full & !self.faulted;
        self.quiet += u32::from(self.quiet < self.reentry_ticks);
        self.quiet *= u32::from(quiet);
        let calm = quiet & (self.quiet >= self.reentry_ticks);
        self.faults *= u32::from(!calm);
        self.open = false;
        self.faulted = false;
        Command {
            torque,
            brake: stopped | self.braked,
            status: Status { mode, fault: self.fault, limited: limited & !stopped },
        }
    }

    #[inline(always)]
    fn next_ramp(&self) -> u32 {
        self.ramp.saturating_add(1).min(self.reentry_ticks)
    }

    /// The previous tick ended without a torque: a fault of this tick, even if the previous one had
    /// another fault.
    #[cold]
    fn unfinished(&mut self) {
        self.faulted = false;
        let fault = self.reported.take().unwrap_or(Fault::Unfinished);
        self.record_fault(fault);
    }

    /// Makes a fault that the supervisor cannot detect one of the next tick.
    #[cold]
    pub(crate) fn report(&mut self, fault: Fault) {
        // The usual path examines one flag for both.
        self.reported = self.reported.or(Some(fault));
        self.open = true;
    }

    /// No positions in this tick: the joints may have moved on.
    #[cold]
    fn no_measurement(&mut self, fault: Fault) {
        self.accepted = false;
        self.ticks_since_good += R::ONE;
        self.record_fault(fault);
    }

    #[inline(always)]
    fn plausible(&self, q: &[R; V]) -> bool {
        let ranges = self.middle.iter().zip(&self.half);
        let steps = self.last_good.iter().zip(&self.plausible_step);
        // The ranges are finite, and so is what lies in them. Not `all`: joints need not wait for
        // each other's verdict.
        q.iter().zip(ranges).zip(steps).fold(
            true,
            |ok, ((&q, (&middle, &half)), (&last, &step))| {
                ok & ((q - middle).abs() <= half)
                    & ((q - last).abs() <= step * self.ticks_since_good)
            },
        )
    }

    /// The first joint outside its bounds.
    pub(crate) fn outside(&self, q: &[R; V]) -> Option<usize> {
        let mut joints = q.iter().zip(self.middle.iter().zip(&self.half));
        joints.position(|(&q, (&middle, &half))| {
            let inside = (q - middle).abs() <= half;
            !inside
        })
    }

    /// The fault of positions that are not plausible; the most severe one if there are several.
    #[cold]
    fn diagnose(&self, q: &[R; V]) -> Fault {
        if let Some(joint) = q.iter().position(|q| !q.is_finite()) {
            return Fault::NotFinite { joint };
        }
        let ranges = self.middle.iter().zip(&self.half);
        let inside = |(&q, (&middle, &half)): (&R, (&R, &R))| (q - middle).abs() <= half;
        if let Some(joint) = q.iter().zip(ranges).position(|joint| !inside(joint)) {
            return Fault::Position { joint };
        }
        let steps = self.last_good.iter().zip(&self.plausible_step);
        let near =
            |(&q, (&last, &step)): (&R, (&R, &R))| (q - last).abs() <= step * self.ticks_since_good;
        let joint = q.iter().zip(steps).position(|joint| !near(joint));
        Fault::Jump { joint: joint.unwrap_or(V) }
    }

    /// A torque that is not finite.
    #[cold]
    fn reject_torque(&mut self, tau: &[R; V]) {
        let joint = tau.iter().position(|tau| !tau.is_finite()).unwrap_or(V);
        let fault = Fault::Torque { joint };
        if !matches!(self.state, State::Full) {
            self.stop(fault);
            return;
        }
        self.record_fault(fault);
        if matches!(self.state, State::Held) {
            self.state = State::Torqueless;
        }
    }

    #[cold]
    fn record_fault(&mut self, fault: Fault) {
        if matches!(self.mode(), Mode::Stopped) {
            return;
        }
        if !self.faulted {
            self.faulted = true;
            self.fault = Some(fault);
            self.faults = self.faults.saturating_add(1);
        }
        let in_hold = self.faults.saturating_sub(self.ride_through_ticks);
        if !self.known | (in_hold > self.held_ticks()) {
            self.state = self.stopped_by_fault();
        } else if (in_hold > 0) & matches!(self.state, State::Full | State::Torqueless) {
            self.state = State::Held;
        }
        if self.state.required().is_some() {
            self.ramp = NOT_COUNTED;
        } else if !matches!(self.state, State::Full) {
            self.ramp = 0;
        }
    }

    /// The progress of the return to the full law in this tick, 0 to 1, for the reference. It is
    /// zero while the arm is held and before the brake opens.
    #[inline(always)]
    pub(crate) fn authority(&self) -> R {
        if !matches!(self.state, State::Full) | self.braked {
            R::ZERO
        } else if self.next_ramp() >= self.reentry_ticks {
            R::ONE
        } else {
            real::<R>(self.next_ramp()) * self.reentry_inv
        }
    }

    /// Restarts the arm with zero torque and the brake set: clears a latched fault and accepts the
    /// next positions that are within their limits.
    ///
    /// The brake opens when the torque of the law is reached; then [`Self::authority`] rises.
    pub(crate) fn reset(&mut self) {
        self.known = false;
        self.accepted = false;
        self.ticks_since_good = R::from_f64(FAR);
        // The rate is limited from the torque of the drives: that of a sinking arm, or of a stop
        // without a tick since.
        if !matches!(self.mode(), Mode::Stopped) {
            self.torque = [R::ZERO; V];
        }
        self.faults = 0;
        self.quiet = 0;
        self.ramp = 0;
        if let State::Unusable(fault) = self.state {
            self.fault = Some(fault);
        } else {
            self.state = State::Full;
        }
        self.faulted = false;
        self.open = false;
        self.braked = true;
        self.reported = None;
    }
}

/// The middles and half widths of the ranges of positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ranges<R, const V: usize> {
    middle: [R; V],
    half: [R; V],
}

impl<R: Real, const V: usize> Ranges<R, V> {
    /// Those of limits, with finite ends, so that what lies between them is finite. Inlined only
    /// after the optimiser has seen its caller, it takes 72 bytes of flash and 8 of stack more.
    #[inline(always)]
    fn of(limits: &SafetyLimits<R, V>) -> Self {
        let range = R::from_f64(RANGE);
        let end = |x: R| {
            if x.abs() > range { x.clamped(-range, range) } else { x }
        };
        let (mut middle, mut half) = (limits.lower, limits.upper);
        for (lower, upper) in middle.iter_mut().zip(&mut half) {
            let [a, b] = [*lower, *upper].map(|x| R::from_f64(0.5) * end(x));
            (*lower, *upper) = (a + b, b - a);
        }
        Self { middle, half }
    }
}

/// The greatest plausible change of position in a tick, of a joint with this greatest speed, less
/// the resolution of its encoder.
fn step<R: Real>(speed: R, tick: R) -> R {
    R::from_f64(JUMP) * speed * tick
}

/// The range of accepted positions, which a [`crate::motion::BackOff`] replaces within its ticks.
impl<R: Real, const V: usize> Supervisor<R, V> {
    /// The least and the greatest position of each joint.
    pub(crate) fn bounds(&self) -> [[R; 2]; V] {
        let mut bounds = [[R::ZERO; 2]; V];
        let ranges = self.middle.iter().zip(&self.half);
        for (bounds, (&middle, &half)) in bounds.iter_mut().zip(ranges) {
            *bounds = [middle - half, middle + half];
        }
        bounds
    }

    /// Replaces the ranges by those between these bounds, and returns what they were.
    pub(crate) fn replace_bounds(&mut self, bounds: &[[R; 2]; V]) -> Ranges<R, V> {
        let before = Ranges { middle: self.middle, half: self.half };
        let ranges = self.middle.iter_mut().zip(&mut self.half);
        for ((middle, half), &[lower, upper]) in ranges.zip(bounds) {
            let [a, b] = [lower, upper].map(|x| R::from_f64(0.5) * x);
            (*middle, *half) = (a + b, b - a);
        }
        before
    }

    /// Restores what [`Self::replace_bounds`] returned, to the bit.
    pub(crate) fn restore_bounds(&mut self, before: Ranges<R, V>) {
        (self.middle, self.half) = (before.middle, before.half);
    }

    /// Lowers the limits of torque to those that the motors bear in the next tick.
    pub(crate) fn limit_torques(&mut self, most: &[R; V]) {
        self.is_thermal = true;
        self.torque_limit = Self::least(&self.limits_torque, most);
    }

    /// The lesser limit of each joint; a NaN of the motors allows nothing.
    fn least(a: &[R; V], b: &[R; V]) -> [R; V] {
        core::array::from_fn(|i| {
            let (a, b) = (entry(a, i), entry(b, i));
            let least = R::either(a < b, a, b);
            R::either(least > R::ZERO, least, R::ZERO)
        })
    }

    /// The greatest torque of each joint.
    pub(crate) fn torque_limit(&self) -> &[R; V] {
        &self.torque_limit
    }

    /// The greatest plausible change of position in one tick.
    pub(crate) fn plausible_step(&self) -> &[R; V] {
        &self.plausible_step
    }
}
