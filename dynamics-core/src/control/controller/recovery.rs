//! The reaction of the controller to a fault, and the return after it: decision 3.

use super::super::{Fault, Mode, Reference, hold};
use super::{MeasurementAge, MotionController};
use crate::scalar::Real;
use crate::state::State;

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// The estimate without a measurement, or without a torque computed from it.
    #[cold]
    pub(super) fn predict_estimate(&mut self, measured: Result<&[R; V], Fault>) {
        match (self.supervisor.mode(), measured) {
            // The brake holds the arm where it is.
            (Mode::Stopped, measured) => {
                self.dead_reckoning = measured.is_err();
                if let Ok(q) = measured {
                    self.observer.reset(q);
                }
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
        hold(&estimate, self.resume.decay_rate())
    }
}
