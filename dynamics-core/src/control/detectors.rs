//! Faults that a supervisor does not see in one measurement or one torque: small detectors that a loop composes.
//!
//! Each is optional and has its own memory. A detector's fault is the measurement of the tick
//! ([`FrozenEncoder`]), or goes to [`MotionController::report`](super::MotionController::report) or `stop_by`.

use super::Fault;
use crate::scalar::Real;
use crate::state::State;

mod detect;
#[cfg(test)]
mod tests;

pub use detect::{Detect, Detectors};

/// Detects encoders whose positions do not change while their references move.
///
/// A joint that a gear or an obstacle blocks gives the same fault: its encoder has to be looked at in either case.
///
/// ```
/// use dynamics_core::control::{Fault, FrozenEncoder};
/// let mut frozen = FrozenEncoder::new([0.01_f32], 3);
/// for (tick, wanted) in [Ok(()), Ok(()), Ok(()), Err(Fault::Frozen { joint: 0 })].into_iter().enumerate() {
///     assert_eq!(frozen.check(&[0.2], &[0.2 + 0.006 * tick as f32]), wanted);
/// }
/// assert_eq!(frozen.check(&[0.2001], &[0.22]), Ok(())); // it moves again
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrozenEncoder<R, const V: usize> {
    distance: [R; V],
    ticks: u32,
    last: [R; V],
    /// The reference when the position last changed, and the ticks since then.
    origin: [R; V],
    unchanged: [u32; V],
    /// Ticks since the start, up to two: no reference acted before the first.
    ticks_measured: u8,
}

impl<R: Real, const V: usize> FrozenEncoder<R, V> {
    /// A detector that reports a position that is the same for `ticks` ticks while the reference has moved further than
    /// `distance`, rad or m: ten steps of the encoder, and more than the play and friction of the gear hide.
    pub const fn new(distance: [R; V], ticks: u32) -> Self {
        Self {
            distance,
            ticks,
            last: [R::ZERO; V],
            origin: [R::ZERO; V],
            unchanged: [0; V],
            ticks_measured: 0,
        }
    }

    /// Compares the measured positions of a tick with those of the tick before; `reference` is the reference of the
    /// joints that acted in between, [`MotionController::reference`](super::MotionController::reference).
    ///
    /// # Errors
    /// [`Fault::Frozen`] names the first joint, in each tick until its position changes.
    pub fn check(&mut self, q: &[R; V], reference: &[R; V]) -> Result<(), Fault> {
        let mut frozen = None;
        let (is_first, is_second) = (self.ticks_measured == 0, self.ticks_measured == 1);
        self.ticks_measured = if is_first { 1 } else { 2 };
        let memory = self
            .last
            .iter_mut()
            .zip(&mut self.origin)
            .zip(&mut self.unchanged);
        let inputs = q.iter().zip(reference).zip(&self.distance);
        for (joint, (((last, origin), unchanged), ((&q, &r), &distance))) in
            memory.zip(inputs).enumerate()
        {
            let is_same = !is_first & (q == *last);
            *last = q;
            *origin = if is_same & !is_second { *origin } else { r };
            *unchanged = if is_same {
                unchanged.saturating_add(1)
            } else {
                0
            };
            if (*unchanged >= self.ticks) & ((r - *origin).abs() > distance) {
                frozen = frozen.or(Some(Fault::Frozen { joint }));
                // Latched: the reference of a held arm may come back.
                *origin = R::ONE / R::ZERO;
            }
        }
        frozen.map_or(Ok(()), Err)
    }

    /// Forgets what was measured: in each tick with the brake set, since the reference of an arm that is started leaps to
    /// where it is.
    pub fn restart(&mut self) {
        self.ticks_measured = 0;
    }
}

/// Detects torques that stay at their limits.
///
/// A held arm is decelerated with q̈ = −λ q̇: choose [`decay_rate`](super::MotionControllerConfig::decay_rate) such that this
/// torque is below the limits at the speeds of the motion, or a hold becomes a stop.
///
/// ```
/// use dynamics_core::control::{Fault, Saturation};
/// let mut saturation = Saturation::new([10.0_f32], 2);
/// let faults = [10.0, 10.0, 10.0, -9.0].map(|torque| saturation.check(&[torque]).err());
/// assert_eq!(faults, [None, None, Some(Fault::Saturated { joint: 0 }), None]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saturation<R, const V: usize> {
    limit: [R; V],
    ticks: u32,
    saturated: [u32; V],
}

impl<R: Real, const V: usize> Saturation<R, V> {
    /// A detector that reports torques of |τ| ≥ `limit` (N·m, N) for longer than `ticks` ticks.
    pub const fn new(limit: [R; V], ticks: u32) -> Self {
        Self {
            limit,
            ticks,
            saturated: [0; V],
        }
    }

    /// Counts the torques of a command.
    ///
    /// # Errors
    /// [`Fault::Saturated`] names the first joint, in each tick until its torque is below the limit.
    pub fn check(&mut self, torque: &[R; V]) -> Result<(), Fault> {
        let joints = self
            .saturated
            .iter_mut()
            .zip(torque.iter().zip(&self.limit));
        let mut fault = Ok(());
        for (joint, (count, (torque, &limit))) in joints.enumerate() {
            *count = if torque.abs() >= limit {
                count.saturating_add(1)
            } else {
                0
            };
            if *count > self.ticks {
                fault = fault.and(Err(Fault::Saturated { joint }));
            }
        }
        fault
    }
}

/// Detects steps of the reference, and references that are not finite.
///
/// ```
/// use dynamics_core::control::{Fault, ReferenceStep};
/// use dynamics_core::state::State;
/// let mut steps = ReferenceStep::new([0.004_f32]); // 4 rad/s in ticks of 1 ms
/// let faults = [0.0, 0.003, 0.3, 0.3].map(|q| steps.check(&State::at([q])).err());
/// assert_eq!(faults, [None, None, Some(Fault::Reference { joint: 0 }), None]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceStep<R, const V: usize> {
    step: [R; V],
    last: [R; V],
    /// Whether there is a last one.
    started: bool,
}

impl<R: Real, const V: usize> ReferenceStep<R, V> {
    /// A detector that reports references that move further than `step` (rad, m) in a tick.
    pub const fn new(step: [R; V]) -> Self {
        Self {
            step,
            last: [R::ZERO; V],
            started: false,
        }
    }

    /// Compares a reference with the one before, and keeps it.
    ///
    /// # Errors
    /// [`Fault::Reference`] names the first joint.
    pub fn check(&mut self, reference: &State<R, V, V>) -> Result<(), Fault> {
        let State { q, qd, qdd } = reference;
        // One comparison for all joints: what exceeds its step or is not finite makes the sum exceed zero, or NaN.
        let mut excess = R::ZERO;
        let steps = q.iter().zip(&self.last).zip(&self.step);
        for (((&q, &last), &step), (&qd, &qdd)) in steps.zip(qd.iter().zip(qdd)) {
            let last = if self.started { last } else { q };
            let beyond = (q - last).abs() - step;
            excess += beyond + beyond.abs() + R::ZERO * (qd + qdd);
        }
        let fault = if excess <= R::ZERO {
            Ok(())
        } else {
            self.first_step(reference)
        };
        (self.last, self.started) = (*q, true);
        fault
    }

    #[cold]
    #[inline(never)]
    fn first_step(&self, reference: &State<R, V, V>) -> Result<(), Fault> {
        let State { q, qd, qdd } = reference;
        let rates = qd.iter().zip(qdd);
        let joints = q.iter().zip(&self.last).zip(&self.step).zip(rates);
        for (joint, (((&q, &last), &step), (qd, qdd))) in joints.enumerate() {
            let is_near = !self.started | ((q - last).abs() <= step);
            if !(is_near & q.is_finite() & qd.is_finite() & qdd.is_finite()) {
                return Err(Fault::Reference { joint });
            }
        }
        // Steps without a limit make the sum NaN as well.
        Ok(())
    }

    /// Forgets the last reference: after missed ticks, or at the start of another motion.
    pub fn restart(&mut self) {
        self.started = false;
    }
}
