//! Stops that are required from outside, and what follows a controlled one.

use super::{NOT_COUNTED, State, Supervisor};
use crate::limits::{Command, Fault, Mode, Reaction};
use crate::safety::stop_category::{Ending, StopCategory, StopRequest, Stopping};
use dynamics_core::scalar::Real;

impl<R: Real, const V: usize> Stopping<R, V> {
    /// The state at the end of a stop. If a stop of category 2 ends early, the arm does what it is
    /// configured for.
    pub(super) fn stopped(&self, ending: Option<Ending>) -> State {
        let ending = match ending {
            Some(Ending::Hold) => self.configured,
            ending => ending,
        };
        State::Stopped { lowers: ending == Some(Ending::Lowering) }
    }
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// The same supervisor with another stop category for lasting faults; without this call it is
    /// [`StopCategory::ControlledOff`].
    pub(crate) fn with_stop(mut self, category: StopCategory<R, V>) -> Self {
        self.stopping.configured = self.stopping.choose(&category);
        if matches!(self.state, State::Stopped { .. }) {
            self.state = self.stopping.stopped(self.stopping.configured);
        }
        self
    }

    /// Stops the arm at once. The stop is latched until [`Self::reset`], with its first reason.
    #[cold]
    pub(crate) fn stop(&mut self, fault: Fault) {
        self.stop_at_once(fault, self.stopping.configured);
    }

    fn stop_at_once(&mut self, fault: Fault, ending: Option<Ending>) {
        if !matches!(self.mode(), Mode::Stopped) {
            self.state = self.stopping.stopped(ending);
            self.fault = Some(fault);
            self.ramp = 0;
        }
    }

    /// Stops the arm by a category. A later call with [`StopCategory::TorqueOff`] ends a controlled
    /// stop at once.
    #[cold]
    pub(crate) fn stop_by(&mut self, fault: Fault, category: StopCategory<R, V>) {
        if !matches!(self.mode(), Mode::Stopped) {
            let ending = self.stopping.choose(&category);
            self.stop_with(fault, ending);
        }
    }

    /// Stops the arm by the configured category.
    fn stop_as_configured(&mut self, fault: Fault) {
        self.stop_with(fault, self.stopping.configured);
    }

    fn stop_with(&mut self, fault: Fault, ending: Option<Ending>) {
        match (self.state.required(), ending) {
            // An arm whose position is not known cannot be decelerated.
            (None, Some(ending)) if self.known => self.decelerate(fault, ending),
            (None, ending) => self.stop_at_once(fault, ending),
            (Some((required, _)), None) => {
                let reason = required.reason;
                self.stop_at_once(reason, None);
            }
            (Some((required, _)), Some(_)) => required.again = true,
        }
    }

    /// Begins a controlled stop; within a tick, the law holds the arm already in this one.
    fn decelerate(&mut self, reason: Fault, ending: Ending) {
        if matches!(self.mode(), Mode::Stopped) {
            return;
        }
        self.state = State::Stopping {
            required: StopRequest { reason, again: false },
            ending,
            ticks: self.hold_ticks,
        };
        self.fault = Some(reason);
        self.ramp = NOT_COUNTED;
    }

    /// The ticks after the ride-through for which a lasting fault holds the arm.
    pub(super) fn held_ticks(&self) -> u32 {
        match self.stopping.configured {
            None => 0,
            Some(_) => self.hold_ticks,
        }
    }

    /// The state of an arm that a lasting fault stops.
    pub(super) fn stopped_by_fault(&mut self) -> State {
        let ending = match self.state.required() {
            Some((_, ending)) => Some(ending),
            None => self.stopping.configured,
        };
        self.stopping.stopped(ending)
    }

    /// A tick of a controlled stop.
    #[cold]
    pub(super) fn continue_stop(&mut self, required: StopRequest, ending: Ending, ticks: u32) {
        self.fault = Some(required.reason);
        self.forget_faults();
        let ticks_left = ticks.saturating_sub(1);
        self.state = match ending {
            Ending::Hold if ticks_left == 0 => State::Standing(required),
            Ending::Off | Ending::Lowering if ticks == 0 => self.stopping.stopped(Some(ending)),
            _ => State::Stopping { required, ending, ticks: ticks_left },
        };
    }

    /// A tick of an arm that is held after a stop of category 2.
    #[cold]
    pub(super) fn stand(&mut self, required: StopRequest) {
        self.fault = Some(required.reason);
        self.forget_faults();
    }

    /// While the arm is held with power, faults are forgotten as in the full law. The ramp, which
    /// is not used in a hold, counts the good ticks.
    fn forget_faults(&mut self) {
        if self.faulted {
            self.ramp = NOT_COUNTED; // the tick that begins has a fault already
            return;
        }
        let good = self.ramp.wrapping_add(1);
        self.ramp = if self.accepted { good } else { 0 };
        if self.ramp >= self.reentry_ticks.max(1) {
            self.faults = 0;
            self.ramp = 0;
        }
    }

    /// Whether the arm is held by a stop of category 2 whose controlled part is over.
    pub(crate) fn stands(&self) -> bool {
        matches!(self.state, State::Standing(_))
    }

    /// Whether it is, and no other stop has been required since: that one may be an operator's.
    pub(crate) fn stands_by_one_stop(&self) -> bool {
        matches!(self.state, State::Standing(StopRequest { again: false, .. }))
    }

    /// Whether every joint is slower than a hundredth of its limit, or as slow as 1 mrad/s.
    pub(crate) fn at_rest(&self, qd: &[R; V]) -> bool {
        let slow =
            |(qd, limit): (&R, &R)| qd.abs() <= R::from_f64(1e-2) * *limit + R::from_f64(1e-3);
        qd.iter().zip(&self.speed_limit).all(slow)
    }

    /// Ends a stop of category 2: the full law returns over `reentry_ticks`, without the brake.
    pub(crate) fn release(&mut self) {
        self.ramp = 0;
        self.state = State::Held;
    }

    /// Whether the arm sinks while it is stopped.
    fn sinks(&self) -> bool {
        matches!(self.state, State::Stopped { lowers: true })
    }

    /// Whether a stopped arm sinks, and a motion from one position to another in a tick is
    /// plausible for it.
    pub(crate) fn lowers(&self, from: &[R; V], to: &[R; V]) -> bool {
        let mut steps = from.iter().zip(to).zip(&self.plausible_step);
        self.sinks() && steps.all(|((&from, &to), &step)| (to - from).abs() <= step)
    }

    /// The command of a stopped arm.
    #[cold]
    #[inline(never)]
    pub(super) fn stopped_command(&mut self, qd: &[R; V]) -> Command<R, V> {
        let torque = self.stopped_torque(qd);
        self.torque = torque;
        self.end(Mode::Stopped, torque, false)
    }

    /// Zero, or the damping of a sinking arm within the limits of torque and rate.
    fn stopped_torque(&self, qd: &[R; V]) -> [R; V] {
        let mut torque = [R::ZERO; V];
        if !self.sinks() {
            return torque;
        }
        let limits = self.torque_limit.iter().zip(&self.rate_limit);
        let damped = self.stopping.damping.iter().zip(qd).zip(&self.torque);
        for ((out, ((&d, &qd), &last)), (&most, &rate)) in torque.iter_mut().zip(damped).zip(limits)
        {
            let wanted = -(d * qd);
            if wanted.is_finite() {
                *out = wanted.clamped(-most, most).clamped(last - rate, last + rate);
            }
        }
        torque
    }

    /// Reacts to a fault that the supervisor cannot detect, by its [`Fault::reaction`].
    #[cold]
    pub(crate) fn react(&mut self, fault: Fault) {
        match fault.reaction() {
            Reaction::RideThrough => self.report(fault),
            Reaction::ControlledStop => self.stop_as_configured(fault),
            Reaction::TorqueOff => self.stop(fault),
        }
    }
}
