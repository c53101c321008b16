//! Joints that are circles: measurement, estimate and reference on the same turn.
//!
//! Nothing is measured or subtracted across turns: the measured position is moved by whole turns to
//! within half a turn of the middle of the joint's range, or of zero where it has none; estimate
//! and reference are moved to the turn of the measurement. A difference of any two of them is then
//! the short way, and of small numbers.

use core::marker::PhantomData;

use super::{MeasurementAge, MotionController, PreviousTick, sealed};
use crate::estimate::Observer;
use crate::limits::Circles;
use crate::reference::Reference;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

#[cfg(test)]
mod tests;

/// Measurements of age A whose positions are points on a circle for the joints of
/// [`Circles::bits`].
///
/// A [`MotionController`] of this type takes the short way on circles: in the feedback, in
/// [`MotionController::reset`], [`MotionController::approach`] and
/// [`BackOff`](crate::motion::BackOff), and it accepts any number of turns. Measure the angle
/// within a turn, then velocities are as accurate after ten thousand turns as after none. Without a
/// circle it is the machine code of the age alone.
///
/// ```
/// use dynamics_core::{model::Robot, robots::Gen3};
/// use motion_control::limits::Circles;
/// use motion_control::motion::{CurrentTick, MotionController, OnCircles};
/// const CIRCLES: u128 = Circles::of(&Gen3::MODEL).bits();
/// type Controller = MotionController<f32, 7, OnCircles<CIRCLES, CurrentTick>>;
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OnCircles<const CIRCLES: u128, A = PreviousTick>(PhantomData<A>);

impl<const CIRCLES: u128, A: MeasurementAge> sealed::Sealed for OnCircles<CIRCLES, A> {}

impl<const CIRCLES: u128, A: MeasurementAge> MeasurementAge for OnCircles<CIRCLES, A> {
    const CIRCLES: Circles = Circles::from_bits(CIRCLES);

    #[inline(always)]
    fn correct<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V], qdd: &[R; V]) {
        A::correct(observer, q, qdd);
    }

    #[inline(always)]
    fn correct_position<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V]) {
        A::correct_position(observer, q);
    }
}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// The measured positions on the turn of the controller, whose estimate and reference follow
    /// them across a seam.
    ///
    /// The reference is that of the tick before, which a standing arm keeps.
    pub(crate) fn turn_to(&mut self, q: &[R; V]) -> [R; V] {
        let circles = A::CIRCLES;
        let Some(q) = self.supervisor.turn_to(circles, q) else {
            return *q;
        };
        let centres = self.supervisor.centres(&q);
        self.observer.turn_to(circles, &centres);
        self.reference.q = circles.near(&self.reference.q, &centres);
        self.resume.turn_to(circles, &centres);
        q
    }

    /// Positions of a motion, of circles on the turn of the estimate.
    pub(super) fn turned(&self, q: [R; V]) -> [R; V] {
        if !A::ON_CIRCLES {
            return q;
        }
        let centres = self.supervisor.centres(&self.observer.estimate().q);
        A::CIRCLES.near(&q, &centres)
    }

    /// Moves the reference of circles to the turn of the estimate.
    #[inline(always)]
    pub(super) fn turn_reference(&mut self) {
        if A::ON_CIRCLES {
            self.reference.q = self.turned(self.reference.q);
        }
    }

    /// The reference of the return onto a motion, which for circles is on the turn of the estimate.
    #[inline(always)]
    pub(super) fn resume_reference<T: Reference<R, V>>(
        &mut self,
        motion: &T,
        share: R,
    ) -> State<R, V, V> {
        if !A::ON_CIRCLES {
            return self.resume.at(motion, share);
        }
        let centres = self.supervisor.centres(&self.observer.estimate().q);
        let circles = A::CIRCLES;
        let motion = NearMotion { motion, circles, centres };
        self.resume.at(&motion, share)
    }
}

/// A motion within half a turn of the centres.
struct NearMotion<'a, T, R, const V: usize> {
    motion: &'a T,
    circles: Circles,
    centres: [R; V],
}

impl<T: Reference<R, V>, R: Real, const V: usize> Reference<R, V> for NearMotion<'_, T, R, V> {
    fn at(&self, tick: u32) -> State<R, V, V> {
        let state = self.motion.at(tick);
        State { q: self.circles.near(&state.q, &self.centres), ..state }
    }

    fn ticks(&self) -> u32 {
        self.motion.ticks()
    }
}
