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
/// # Cost
/// One joint is compared in each tick, in rotation: a position that froze is reported after two comparisons of its joint at
/// the earliest, up to 2 V − 1 ticks later.
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
    encoders: [Encoder<R>; V],
    /// Comparisons of a joint that `ticks` ticks have at least.
    comparisons: u32,
    /// The joint that is compared next: the frozen one as long as it is.
    joint: u16,
    /// Comparisons of this joint since the start, up to two: no reference acted before the first.
    compared: u8,
    frozen: bool,
}

/// An encoder as it was when it was last compared.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Encoder<R> {
    distance: R,
    last: R,
    /// The reference when the position last changed, and the comparisons since then.
    origin: R,
    unchanged: u32,
}

impl<R: Real, const V: usize> FrozenEncoder<R, V> {
    /// A detector that reports a position that is the same for `ticks` ticks while the reference has moved further than
    /// `distance`, rad or m: ten steps of the encoder, and more than the play and friction of the gear hide.
    pub const fn new(distance: [R; V], ticks: u32) -> Self {
        let mut encoders = [Encoder::NEW; V];
        let mut joint = 0;
        while joint < V {
            encoders[joint].distance = distance[joint];
            joint += 1;
        }
        let joints = if V == 0 { 1 } else { V as u32 };
        Self {
            encoders,
            comparisons: ticks.div_ceil(joints),
            joint: 0,
            compared: 0,
            frozen: false,
        }
    }

    /// Compares the measured position of a joint with the one when it was compared before; `reference` is the reference of
    /// the joints that acted in between, [`MotionController::reference`](super::MotionController::reference).
    ///
    /// # Errors
    /// [`Fault::Frozen`] names the joint, in each tick until its position changes.
    #[inline]
    pub fn check(&mut self, q: &[R; V], reference: &[R; V]) -> Result<(), Fault> {
        let joint = usize::from(self.joint);
        let (Some(encoder), Some(&q), Some(&r)) = (
            self.encoders.get_mut(joint),
            q.get(joint),
            reference.get(joint),
        ) else {
            return Ok(());
        };
        if self.frozen {
            // Compared with the position alone: the reference of a held arm may come back.
            if q != encoder.last {
                self.restart();
                return Ok(());
            }
        } else if !encoder.is_frozen(q, r, self.compared, self.comparisons) {
            self.joint += 1;
            if joint + 1 == V {
                (self.joint, self.compared) = (0, if self.compared == 0 { 1 } else { 2 });
            }
            return Ok(());
        }
        self.frozen = true;
        Err(Fault::Frozen { joint })
    }

    /// Forgets what was measured: in each tick with the brake set, since the reference of an arm that is started leaps to
    /// where it is.
    pub fn restart(&mut self) {
        (self.joint, self.compared, self.frozen) = (0, 0, false);
    }
}

impl<R: Real> Encoder<R> {
    const NEW: Self = Self {
        distance: R::ZERO,
        last: R::ZERO,
        origin: R::ZERO,
        unchanged: 0,
    };

    #[inline(always)]
    fn is_frozen(&mut self, q: R, reference: R, compared: u8, comparisons: u32) -> bool {
        let is_same = (compared > 0) & (q == self.last);
        if is_same & (compared > 1) {
            self.unchanged = self.unchanged.saturating_add(1);
            let distance = (reference - self.origin).abs();
            return (self.unchanged >= comparisons) & (distance > self.distance);
        }
        self.unchanged = u32::from(is_same);
        (self.last, self.origin) = (q, reference);
        false
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
        if !self.started {
            (self.last, self.started) = (*q, true);
        }
        // One comparison for all joints: what exceeds its step makes the sum exceed zero, what is not finite makes it NaN.
        let (mut excess, mut rates) = (R::ZERO, R::ZERO);
        let steps = q.iter().zip(&self.last).zip(&self.step);
        for (((&q, &last), &step), (&qd, &qdd)) in steps.zip(qd.iter().zip(qdd)) {
            let beyond = (q - last).abs() - step;
            excess += beyond + beyond.abs();
            rates += qd + qdd;
        }
        let fault = if excess + R::ZERO * rates <= R::ZERO {
            Ok(())
        } else {
            self.first_step(reference)
        };
        self.last = *q;
        fault
    }

    #[cold]
    #[inline(never)]
    fn first_step(&self, reference: &State<R, V, V>) -> Result<(), Fault> {
        let State { q, qd, qdd } = reference;
        let rates = qd.iter().zip(qdd);
        let joints = q.iter().zip(&self.last).zip(&self.step).zip(rates);
        for (joint, (((&q, &last), &step), (qd, qdd))) in joints.enumerate() {
            let is_near = (q - last).abs() <= step;
            if !(is_near & q.is_finite() & qd.is_finite() & qdd.is_finite()) {
                return Err(Fault::Reference { joint });
            }
        }
        // Steps without a limit, and rates whose sum is not finite, make the sum NaN as well.
        Ok(())
    }

    /// Forgets the last reference: after missed ticks, or at the start of another motion.
    pub fn restart(&mut self) {
        self.started = false;
    }
}
