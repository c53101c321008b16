//! The two halves of a tick: the check of the measurements, and the limits of the torques.

use super::Supervisor;
use super::state::State;
use crate::limits::{Command, Fault, Mode};
use dynamics_core::scalar::Real;

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// Starts a tick with its measured positions, or with the fault that prevented them, and returns the mode of the
    /// arm. [`Self::gate`] must follow.
    #[inline]
    pub(crate) fn accept_measurement(&mut self, measured: Result<&[R; V], Fault>) -> Mode {
        match measured {
            Ok(q) => self.accept_positions(q),
            Err(fault) => self.accept_fault(fault),
        }
        self.mode()
    }

    /// As [`Self::accept_measurement`], with positions.
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

    /// As [`Self::accept_measurement`], without positions: a function of its own, so that the usual tick has no case for
    /// it.
    #[cold]
    #[inline(never)]
    pub(crate) fn accept_fault(&mut self, fault: Fault) {
        self.begin();
        self.no_measurement(fault);
    }

    /// Compares the observer's velocities with their limits, between [`Self::accept_measurement`] and [`Self::gate`].
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

    /// Ends a tick: limits the torques of the law and returns the command to the drives. The velocities damp a stopped
    /// arm that sinks.
    #[inline]
    pub(crate) fn gate(&mut self, tau: &[R; V], qd: &[R; V]) -> Command<R, V> {
        let mut off = R::ZERO;
        let mut torque = [R::ZERO; V];
        let wanted = tau.iter().zip(&self.torque);
        let limits = self.torque_limit.iter().zip(&self.rate_limit);
        for ((out, (&tau, &last)), (&most, &rate)) in torque.iter_mut().zip(wanted).zip(limits) {
            let next = tau.clamped(-most, most).clamped(last - rate, last + rate);
            // Zero if no torque was limited, and not finite if a torque is not; the factor keeps the sum of finite
            // terms from overflowing.
            off += (next - tau).abs() * R::from_f64(1.0 / 64.0);
            *out = next;
        }
        if !off.is_finite() {
            self.reject_torque(tau);
            torque = self.torque;
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

    /// The command of an arm that is held or stopped: a function of its own, so that the usual tick has no case for it.
    #[cold]
    #[inline(never)]
    fn command_otherwise(&mut self, qd: &[R; V], limited: bool) -> Command<R, V> {
        if matches!(self.mode(), Mode::Stopped) {
            return self.stopped_command(qd);
        }
        self.end(Mode::Hold, self.torque, limited)
    }
}
