//! The steps of a tick: its begin and end, the check of plausibility, and the transitions on faults.

use super::state::State;
use super::{Command, Fault, Mode, Status, Supervisor};
use dynamics_core::scalar::Real;

impl<R: Real, const V: usize> Supervisor<R, V> {
    #[inline(always)]
    pub(super) fn begin(&mut self) {
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

    /// The begin of a tick in the states that the usual tick does not know: out of its machine code, which would have a
    /// table of jumps.
    #[cold]
    #[inline(never)]
    fn begin_otherwise(&mut self) {
        match self.state {
            State::Torqueless => self.state = State::Held,
            State::Stopping {
                required,
                ending,
                ticks,
            } => self.continue_stop(required, ending, ticks),
            State::Standing(required) => self.stand(required),
            State::Full | State::Held | State::Stopped { .. } | State::Unusable(_) => {}
        }
    }

    #[inline(always)]
    pub(super) fn end(&mut self, mode: Mode, torque: [R; V], limited: bool) -> Command<R, V> {
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
            status: Status {
                mode,
                fault: self.fault,
                limited: limited & !stopped,
            },
        }
    }

    #[inline(always)]
    pub(super) fn next_ramp(&self) -> u32 {
        self.ramp.saturating_add(1).min(self.reentry_ticks)
    }

    /// The previous tick ended without a torque: a fault of this tick, even if the previous one had another fault.
    #[cold]
    fn unfinished(&mut self) {
        self.faulted = false;
        let fault = self.reported.take().unwrap_or(Fault::Unfinished);
        self.record_fault(fault);
    }

    /// Reports a fault that the supervisor cannot detect, which is then a fault of the next tick: ridden through, held
    /// and stopped as any other. While it lasts, report it in every tick.
    ///
    /// For faults that allow no deceleration, see [`Self::stop`]; for a stop without ride-through, [`Self::stop_by`].
    ///
    /// ```
    /// # use motion_control::{Fault, Mode, SafetyLimits, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::try_new(SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 1, hold_ticks: 1, reentry_ticks: 4,
    /// # })?;
    /// supervisor.tick(Ok(&[0.5]), |_| [7.0]);
    /// for mode in [Mode::Full, Mode::Hold, Mode::Stopped] {
    ///     supervisor.report(Fault::Overrun);
    ///     let status = supervisor.tick(Ok(&[0.5]), |_| [7.0]).status;
    ///     assert_eq!((status.mode, status.fault), (mode, Some(Fault::Overrun)));
    /// }
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    #[cold]
    pub fn report(&mut self, fault: Fault) {
        // The usual path examines one flag for both.
        self.reported = self.reported.or(Some(fault));
        self.open = true;
    }

    /// No positions in this tick: the joints may have moved on.
    #[cold]
    pub(super) fn no_measurement(&mut self, fault: Fault) {
        self.accepted = false;
        self.ticks_since_good += R::ONE;
        self.record_fault(fault);
    }

    #[inline(always)]
    pub(super) fn plausible(&self, q: &[R; V]) -> bool {
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
    pub(super) fn diagnose(&self, q: &[R; V]) -> Fault {
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
        Fault::Jump {
            joint: joint.unwrap_or(V),
        }
    }

    /// A torque that is not finite.
    #[cold]
    pub(super) fn reject_torque(&mut self, tau: &[R; V]) {
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
    pub(super) fn record_fault(&mut self, fault: Fault) {
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
        if !matches!(self.state, State::Full) {
            self.ramp = 0;
        }
    }
}
