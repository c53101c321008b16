//! Stops that are required from outside, and what follows a controlled one.

use super::state::{Ending, Required, State};
use super::{Command, Fault, Mode, StopCategory, Supervisor};
use crate::limits::Reaction;
use dynamics_core::scalar::Real;

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// The same supervisor with another stop category for lasting faults; without this call it is
    /// [`StopCategory::ControlledOff`].
    ///
    /// ```
    /// # use motion_control::{Fault, Mode, SafetyLimits, StopCategory, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let config = SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 0, hold_ticks: 2, reentry_ticks: 4,
    /// # };
    /// let mut supervisor = Supervisor::try_new(config)?.with_stop(StopCategory::TorqueOff);
    /// supervisor.tick(Ok(&[0.5]), |_| [7.0]);
    /// assert_eq!(supervisor.tick(Err(Fault::Stale), |_| [7.0]).status.mode, Mode::Stopped);
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    #[must_use]
    pub fn with_stop(mut self, category: StopCategory<R, V>) -> Self {
        self.stopping.configured = self.stopping.choose(&category);
        if matches!(self.state, State::Stopped { .. }) {
            self.state = self.stopping.stopped(self.stopping.configured);
        }
        self
    }

    /// Stops the arm from the next tick on, for an external reason such as a failed drive or an emergency stop;
    /// [`SupervisorTick::stop`](super::SupervisorTick::stop) stops it in the present tick, [`Self::stop_by`] by another stop category than 0.
    ///
    /// The stop is latched until [`Self::reset`], with its first reason. While a stop is still required after a reset,
    /// call this function in every tick.
    ///
    /// ```
    /// # use motion_control::{Fault, SafetyLimits, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::try_new(SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 5, hold_ticks: 2, reentry_ticks: 4,
    /// # })?;
    /// supervisor.stop(Fault::External);
    /// let command = supervisor.tick(Ok(&[0.5]), |_| [7.0]);
    /// assert_eq!((command.torque, command.brake), ([0.0], true));
    /// assert_eq!(command.status.fault, Some(Fault::External));
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        self.stop_at_once(fault, self.stopping.configured);
    }

    fn stop_at_once(&mut self, fault: Fault, ending: Option<Ending>) {
        if !matches!(self.mode(), Mode::Stopped) {
            self.state = self.stopping.stopped(ending);
            self.fault = Some(fault);
            self.ramp = 0;
        }
    }

    /// Stops the arm by a category, for a reason that leaves the drives usable: an operator, a safety controller, a
    /// lost connection. Between two ticks, the stop begins in the next one; within a tick it begins in this one.
    ///
    /// The stop is latched until [`Self::reset`], with its first reason. A later call with
    /// [`StopCategory::TorqueOff`] ends a controlled stop at once.
    #[cold]
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<R, V>) {
        if !matches!(self.mode(), Mode::Stopped) {
            let ending = self.stopping.choose(&category);
            self.stop_with(fault, ending);
        }
    }

    /// Stops the arm by the configured category.
    pub(crate) fn stop_as_configured(&mut self, fault: Fault) {
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
            required: Required {
                reason,
                again: false,
            },
            ending,
            ticks: self.hold_ticks,
        };
        self.fault = Some(reason);
        self.ramp = 0;
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
    pub(super) fn continue_stop(&mut self, required: Required, ending: Ending, ticks: u32) {
        self.fault = Some(required.reason);
        self.forget_faults();
        let ticks_left = ticks.saturating_sub(1);
        self.state = match ending {
            Ending::Hold if ticks_left == 0 => State::Standing(required),
            Ending::Off | Ending::Lowering if ticks == 0 => self.stopping.stopped(Some(ending)),
            _ => State::Stopping {
                required,
                ending,
                ticks: ticks_left,
            },
        };
    }

    /// A tick of an arm that is held after a stop of category 2.
    #[cold]
    pub(super) fn stand(&mut self, required: Required) {
        self.fault = Some(required.reason);
        self.forget_faults();
    }

    /// While the arm is held with power, faults are forgotten as in the full law. The ramp, which is not used in a
    /// hold, counts the good ticks.
    fn forget_faults(&mut self) {
        self.ramp = if self.accepted & !self.faulted {
            self.ramp.saturating_add(1)
        } else {
            0
        };
        if self.ramp >= self.reentry_ticks {
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
        matches!(self.state, State::Standing(Required { again: false, .. }))
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

    /// Whether a stopped arm sinks, and a motion from one position to another in a tick is plausible for it.
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
                *out = wanted
                    .clamped(-most, most)
                    .clamped(last - rate, last + rate);
            }
        }
        torque
    }
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// Reacts to a fault that the supervisor cannot detect, by its [`Fault::reaction`]. Between two ticks the reaction
    /// begins in the next one. While the fault lasts, call this function in every tick.
    ///
    /// ```
    /// # use motion_control::{Fault, Mode, SafetyLimits, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let config = SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 1, hold_ticks: 2, reentry_ticks: 4,
    /// # };
    /// let overrun = [Mode::Full, Mode::Hold, Mode::Hold];
    /// let external = [Mode::Hold, Mode::Hold, Mode::Stopped];
    /// let drive = [Mode::Stopped; 3];
    /// let faults = [Fault::Overrun, Fault::External, Fault::Drive { joint: 0 }];
    /// for (fault, modes) in faults.into_iter().zip([overrun, external, drive]) {
    ///     let mut supervisor = Supervisor::try_new(config)?;
    ///     supervisor.tick(Ok(&[0.5]), |_| [7.0]);
    ///     for mode in modes {
    ///         supervisor.react(fault);
    ///         let status = supervisor.tick(Ok(&[0.5]), |_| [7.0]).status;
    ///         assert_eq!((status.mode, status.fault), (mode, Some(fault)));
    ///     }
    /// }
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    #[cold]
    pub fn react(&mut self, fault: Fault) {
        match fault.reaction() {
            Reaction::RideThrough => self.report(fault),
            Reaction::ControlledStop => self.stop_as_configured(fault),
            Reaction::TorqueOff => self.stop(fault),
        }
    }
}
