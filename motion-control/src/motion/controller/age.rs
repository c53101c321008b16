//! How old a measurement is when it arrives.

use crate::estimate::Observer;
use dynamics_core::scalar::Real;

mod sealed {
    pub trait Sealed {}
}

/// The age of the measurements of a [`MotionController`](super::MotionController), a property of the encoders, as a
/// type.
pub trait MeasurementAge: sealed::Sealed {
    /// Updates the estimate by positions that were accepted.
    #[doc(hidden)]
    fn correct<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V], qdd: &[R; V]);

    /// Replaces the estimated positions after ticks without measurements.
    #[doc(hidden)]
    fn correct_position<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V]);
}

/// The positions are those of the previous tick: for encoders that latch at the end of a frame and send in the next
/// one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreviousTick;

/// The positions are those of the tick in which they arrive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurrentTick;

impl sealed::Sealed for PreviousTick {}
impl sealed::Sealed for CurrentTick {}

impl MeasurementAge for PreviousTick {
    #[inline(always)]
    fn correct<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V], qdd: &[R; V]) {
        observer.update_delayed(q, qdd);
    }

    #[inline(always)]
    fn correct_position<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V]) {
        observer.correct_position_delayed(q);
    }
}

impl MeasurementAge for CurrentTick {
    #[inline(always)]
    fn correct<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V], qdd: &[R; V]) {
        observer.update(q, qdd);
    }

    #[inline(always)]
    fn correct_position<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V]) {
        observer.correct_position(q);
    }
}
