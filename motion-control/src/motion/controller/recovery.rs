//! The reaction of the controller to a fault, and the return after it: decision 3.

use super::{MeasurementAge, MotionController};
use crate::limits::{Fault, Mode};
use crate::motion::hold;
use crate::reference::Reference;
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// The estimate without a measurement, or without a torque computed from it.
    #[cold]
    pub(super) fn predict_estimate(&mut self, measured: Result<&[R; V], Fault>) {
        match (self.supervisor.mode(), measured) {
            (Mode::Stopped, measured) => {
                self.dead_reckoning = measured.is_err();
                self.stopped_estimate(measured);
            }
            (_, Ok(q)) if self.supervisor.measurement_accepted() => {
                self.dead_reckoning = false;
                A::correct_position(&mut self.observer, q);
            }
            (mode, _) => {
                self.dead_reckoning |= matches!(mode, Mode::Hold);
                self.observer.predict(&self.reference.qdd);
            }
        }
    }

    /// The estimate of a stopped arm: at rest where the brake holds it, or the motion of one that sinks. Without a
    /// usable measurement the velocity is zero, and with it the damping.
    fn stopped_estimate(&mut self, measured: Result<&[R; V], Fault>) {
        let last = self.observer.estimate().q;
        match measured {
            Ok(q) if self.observer.started() && self.supervisor.lowers(&last, q) => {
                self.observer.follow(q);
            }
            Ok(q) if all_finite(q) => self.observer.reset(q),
            _ if self.supervisor.knows_positions() => self.observer.reset(&last),
            _ => {}
        }
    }

    /// Updates the reference of the joints in this tick.
    #[inline(always)]
    pub(super) fn next_reference<T: Reference<R, V>>(&mut self, trajectory: &T) {
        let full = matches!(self.supervisor.mode(), Mode::Full);
        if (!full | self.resume.active()) && !self.recovery_done(full) {
            self.recovery_reference(trajectory, full);
        } else {
            self.reference = trajectory.at(self.clock);
        }
    }

    /// Whether the return onto the trajectory ends in this tick.
    #[cold]
    fn recovery_done(&mut self, full: bool) -> bool {
        let done = full & (self.supervisor.authority() >= R::ONE);
        if done {
            self.clock = self.resume.finish();
        }
        done
    }

    /// While the arm is held, the reference is its estimated position with a decaying velocity, so that the same law
    /// brings all joints to rest together. Then the return onto the trajectory.
    #[cold]
    #[inline(never)]
    fn recovery_reference<T: Reference<R, V>>(&mut self, trajectory: &T, full: bool) {
        let State { q, qd, qdd } = if full {
            let share = self.supervisor.authority();
            self.resume.at(trajectory, share)
        } else {
            self.stop_reference()
        };
        // A state of six joints in one piece would be copied by `memcpy`, which adds 0.9 kB to a tick's code.
        self.reference.q = q;
        self.reference.qd = qd;
        self.reference.qdd = qdd;
    }

    /// The reference of a stop that began after that of the tick was computed.
    pub(super) fn hold_now(&mut self) {
        if !matches!(self.supervisor.mode(), Mode::Full) {
            self.reference = self.stop_reference();
        }
    }

    /// Updates the reference of the joints by one that is not the trajectory's, whose clock stands still: a return onto it
    /// begins in each of these ticks.
    #[cold]
    pub(super) fn replace_reference(&mut self, reference: &State<R, V, V>) {
        if self.resume.active() {
            self.clock = self.resume.cancel();
        }
        self.resume.start(self.observer.estimate(), self.clock);
        self.standing = false;
        self.reference.q = reference.q;
        self.reference.qd = reference.qd;
        self.reference.qdd = reference.qdd;
    }

    /// The rate at which the speed of a held arm decays, 1/s.
    pub(crate) fn decay_rate(&self) -> R {
        self.resume.decay_rate()
    }

    /// Decelerates the arm at its present position. The clock stops when the deceleration begins, and the return is
    /// initialised again in each of these ticks.
    fn stop_reference(&mut self) -> State<R, V, V> {
        if self.resume.active() {
            self.clock = self.resume.cancel();
        } else {
            self.clock = self.resume.resume_tick(self.clock);
        }
        let estimate = *self.observer.estimate();
        self.resume.start(&estimate, self.clock);
        // With a reference at the estimate, errors of the model would let an arm that is held for long drift.
        self.standing =
            self.supervisor.stands() & (self.standing | self.supervisor.at_rest(&estimate.qd));
        if self.standing {
            return State::at(self.reference.q);
        }
        hold(&estimate, self.resume.decay_rate())
    }
}
