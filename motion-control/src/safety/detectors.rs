//! Faults that a supervisor does not see in one measurement or one torque: small detectors that a
//! loop composes.
//!
//! Each is optional and has its own memory. A detector's fault is the measurement of the tick
//! ([`FrozenEncoder`]), or goes to
//! [`MotionController::report`](crate::motion::MotionController::report) or `stop_by`.

use crate::limits::{Circles, Fault};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::state::manifold::nearest_turn;

mod detect;
#[cfg(test)]
mod tests;

pub use detect::{Detect, Detectors};

/// Detects encoders whose positions do not change while their references move.
///
/// A joint that a gear or an obstacle blocks gives the same fault: its encoder has to be looked at
/// in either case.
///
/// # Cost
/// One joint is compared in each tick, in rotation: a position that froze is reported after two
/// comparisons of its joint at the earliest, up to 2 V − 1 ticks later.
///
/// ```
/// use motion_control::{limits::Fault, safety::FrozenEncoder};
/// let mut frozen = FrozenEncoder::new([0.01_f32], 3);
/// for tick in 0..5 {
///     let fault = frozen.check(&[0.2], &[0.2 + 0.006 * tick as f32]).err();
///     // No reference acted before the first tick.
///     assert_eq!(fault, (tick == 4).then_some(Fault::Frozen { joint: 0 }));
/// }
/// assert_eq!(frozen.check(&[0.2001], &[0.22]), Ok(())); // it moves again
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrozenEncoder<R, const V: usize, const CIRCLES: u128 = 0> {
    encoders: [Encoder<R>; V],
    /// Comparisons without a change that precede the one which reports it.
    patience: u32,
    /// The joint that is compared next; V if none is: before the first comparison, and while one is
    /// frozen.
    joint: usize,
    frozen: Option<usize>,
}

/// An encoder as it was when it was last compared.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Encoder<R> {
    distance: R,
    last: R,
    /// The reference when the position last changed, and what is left of the patience since then.
    origin: R,
    left: u32,
}

impl<R: Real, const V: usize> FrozenEncoder<R, V> {
    /// A detector that reports a position that is the same for `ticks` ticks while the reference
    /// has moved further than `distance`, rad or m: ten steps of the encoder, and more than the
    /// play and friction of the gear hide.
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
            patience: ticks.div_ceil(joints).saturating_sub(1),
            joint: V,
            frozen: None,
        }
    }

    /// The same detector for joints of which those of [`Circles::bits`] are circles: a reference
    /// that moves by a whole turn has not moved.
    #[must_use]
    pub const fn on_circles<const CIRCLES: u128>(self) -> FrozenEncoder<R, V, CIRCLES> {
        let Self { encoders, patience, joint, frozen } = self;
        FrozenEncoder { encoders, patience, joint, frozen }
    }
}

impl<R: Real, const V: usize, const CIRCLES: u128> FrozenEncoder<R, V, CIRCLES> {
    /// Compares the measured position of a joint with the one when it was compared before;
    /// `reference` is the reference of the joints that acted in between,
    /// [`MotionController::reference`](crate::motion::MotionController::reference).
    ///
    /// # Errors
    /// [`Fault::Frozen`] names the joint, in each tick until its position changes.
    #[inline(always)]
    pub fn check(&mut self, q: &[R; V], reference: &[R; V]) -> Result<(), Fault> {
        let joint = self.joint;
        let (Some(encoder), Some(&q), Some(&reference)) =
            (self.encoders.get_mut(joint), q.get(joint), reference.get(joint))
        else {
            return self.compare_none(q);
        };
        if q != encoder.last {
            (encoder.last, encoder.origin, encoder.left) = (q, reference, self.patience);
        } else if encoder.left > 0 {
            encoder.left -= 1;
        } else if (reference - encoder.origin).abs() > encoder.distance
            && !(Circles::from_bits(CIRCLES).has(joint) && encoder.near(reference))
        {
            (self.joint, self.frozen) = (V, Some(joint));
            return Err(Fault::Frozen { joint });
        }
        self.joint = if joint + 1 == V { 0 } else { joint + 1 };
        Ok(())
    }

    /// The first tick, before which no reference acted; or one with a frozen joint, whose position
    /// alone is compared: the reference of a held arm may come back.
    #[cold]
    #[inline(never)]
    fn compare_none(&mut self, q: &[R; V]) -> Result<(), Fault> {
        if let Some(joint) = self.frozen {
            let encoder = self.encoders.get(joint);
            if q.get(joint) == encoder.map(|encoder| &encoder.last) {
                return Err(Fault::Frozen { joint });
            }
            self.restart();
        } else {
            // Different from whatever is measured next.
            (self.encoders.iter_mut()).for_each(|encoder| encoder.last = R::from_f64(f64::NAN));
            // This tick was that of the first joint.
            self.joint = if V > 1 { 1 } else { 0 };
        }
        Ok(())
    }

    /// Forgets what was measured: in each tick with the brake set, since the reference of an arm
    /// that is started leaps to where it is.
    #[cold]
    pub fn restart(&mut self) {
        (self.joint, self.frozen) = (V, None);
    }
}

impl<R: Real> Encoder<R> {
    const NEW: Self = Self { distance: R::ZERO, last: R::ZERO, origin: R::ZERO, left: 0 };

    /// Whether the reference of a circle is within the distance, on whichever turn.
    #[cold]
    #[inline(never)]
    fn near(&self, reference: R) -> bool {
        (nearest_turn(reference, self.origin) - self.origin).abs() <= self.distance
    }
}

/// Detects torques that stay at their limits, or swing from one to the other: the limit cycle of
/// gains that are too great, whatever its period.
///
/// A held arm is decelerated with q̈ = −λ q̇: choose
/// [`decay_rate`](crate::motion::MotionControllerConfig::decay_rate) such that this torque is below
/// the limits at the speeds of the motion, or a hold becomes a stop.
///
/// ```
/// use motion_control::{limits::Fault, safety::Saturation};
/// let mut saturation = Saturation::new([10.0_f32], 2);
/// let faults = [10.0, 10.0, 10.0, -9.0].map(|torque| saturation.check(&[torque]).err());
/// assert_eq!(faults, [None, None, Some(Fault::Saturated { joint: 0 }), None]);
/// let cycle = (0..20).map(|tick| [[10.0], [1.0], [-10.0], [-1.0]][tick % 4]);
/// let fault = cycle.map(|torque| saturation.check(&torque)).find(Result::is_err);
/// assert_eq!(fault, Some(Err(Fault::LimitCycle { joint: 0 })));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saturation<R, const V: usize> {
    limit: [R; V],
    ticks: u32,
    joints: [Excess; V],
    /// Whether one of these is not that of a torque below its limit.
    counts: bool,
}

/// A torque at its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Excess {
    /// The ticks at one of them until now.
    at_limit: u32,
    /// The ticks since it was at one, and whether that was the upper one.
    since: u32,
    upper: bool,
    /// The changes from one to the other.
    swings: u32,
}

impl Excess {
    const NONE: Self = Self { at_limit: 0, since: u32::MAX, upper: false, swings: 0 };
    /// The number of swings in a row that are a limit cycle.
    const MOST: u32 = 8;
    /// A motion, too, has torques at both limits, but with a longer time between them: this multiple
    /// of the ticks that a torque may be at its limit.
    const APART: u32 = 4;
}

impl<R: Real, const V: usize> Saturation<R, V> {
    /// A detector that reports torques of |τ| ≥ `limit` (N·m, N) for longer than `ticks` ticks, and
    /// the eighth swing in a row from limit to limit that took less than four times as long.
    pub const fn new(limit: [R; V], ticks: u32) -> Self {
        Self { limit, ticks, joints: [Excess::NONE; V], counts: false }
    }

    /// Counts the torques of a command.
    ///
    /// # Errors
    /// [`Fault::Saturated`] names the first joint, in each tick until its torque is below the
    /// limit; [`Fault::LimitCycle`], until it no longer swings.
    #[inline(always)]
    pub fn check(&mut self, torque: &[R; V]) -> Result<(), Fault> {
        // Not `any`: joints need not wait for each other's verdict.
        let limits = torque.iter().zip(&self.limit);
        let at_limit =
            limits.fold(self.counts, |at, (torque, &limit)| at | (torque.abs() >= limit));
        if at_limit {
            return self.count(torque);
        }
        Ok(())
    }

    /// Counts the torques of a tick in which one is at its limit, or that follows it.
    #[cold]
    #[inline(never)]
    fn count(&mut self, torque: &[R; V]) -> Result<(), Fault> {
        self.counts = false;
        let (mut fault, apart) = (Ok(()), Excess::APART.saturating_mul(self.ticks));
        let limits = torque.iter().zip(&self.limit);
        for (joint, (excess, (&torque, &limit))) in self.joints.iter_mut().zip(limits).enumerate() {
            if torque.abs() >= limit {
                let upper = torque > R::ZERO;
                let swings = excess.since <= apart && upper != excess.upper;
                excess.swings += u32::from(swings && excess.swings < Excess::MOST);
                (excess.since, excess.upper) = (0, upper);
                excess.at_limit = excess.at_limit.saturating_add(1);
            } else {
                excess.at_limit = 0;
                excess.since = excess.since.saturating_add(1);
            }
            if excess.since > apart {
                *excess = Excess::NONE;
                continue;
            }
            self.counts = true;
            if excess.at_limit > self.ticks {
                fault = fault.and(Err(Fault::Saturated { joint }));
            } else if excess.swings == Excess::MOST {
                fault = fault.and(Err(Fault::LimitCycle { joint }));
            }
        }
        fault
    }
}

/// Detects steps of the reference, and references that are not finite.
///
/// ```
/// use motion_control::{limits::Fault, safety::ReferenceStep};
/// use dynamics_core::state::State;
/// let mut steps = ReferenceStep::new([0.004_f32]); // 4 rad/s in ticks of 1 ms
/// let faults = [0.0, 0.003, 0.3, 0.3].map(|q| steps.check(&State::at([q])).err());
/// assert_eq!(faults, [None, None, Some(Fault::Reference { joint: 0 }), None]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceStep<R, const V: usize, const CIRCLES: u128 = 0> {
    step: [R; V],
    last: [R; V],
    /// Whether there is a last one.
    started: bool,
}

impl<R: Real, const V: usize> ReferenceStep<R, V> {
    /// A detector that reports references that move further than `step` (rad, m) in a tick.
    pub const fn new(step: [R; V]) -> Self {
        Self { step, last: [R::ZERO; V], started: false }
    }

    /// The same detector for joints of which those of [`Circles::bits`] are circles: a step of a
    /// whole turn is none.
    ///
    /// ```
    /// use dynamics_core::state::State;
    /// use motion_control::{limits::Circles, safety::ReferenceStep};
    /// let mut steps = ReferenceStep::new([0.004_f32]).on_circles::<{ Circles::NONE.with(0).bits() }>();
    /// assert!([3.14, -3.142, 3.14].iter().all(|&q| steps.check(&State::at([q])).is_ok()));
    /// ```
    #[must_use]
    pub const fn on_circles<const CIRCLES: u128>(self) -> ReferenceStep<R, V, CIRCLES> {
        let Self { step, last, started } = self;
        ReferenceStep { step, last, started }
    }
}

impl<R: Real, const V: usize, const CIRCLES: u128> ReferenceStep<R, V, CIRCLES> {
    /// Compares a reference with the one before, and keeps it.
    ///
    /// # Errors
    /// [`Fault::Reference`] names the first joint.
    #[inline(always)]
    pub fn check(&mut self, reference: &State<R, V, V>) -> Result<(), Fault> {
        let State { q, qd, qdd } = reference;
        if !self.started {
            (self.last, self.started) = (*q, true);
        }
        let mut rates = -R::ZERO;
        for (&qd, &qdd) in qd.iter().zip(qdd) {
            rates += qd + qdd;
        }
        for ((&q, last), &step) in q.iter().zip(&mut self.last).zip(&self.step) {
            // False for what is not finite, too.
            let is_near = (q - *last).abs() < step;
            if !is_near {
                return self.first_step(reference);
            }
            *last = q;
        }
        if !rates.is_finite() {
            return self.first_step(reference);
        }
        Ok(())
    }

    /// Compares joint by joint; those that were compared before have not moved since.
    #[cold]
    #[inline(never)]
    fn first_step(&mut self, reference: &State<R, V, V>) -> Result<(), Fault> {
        let State { q, qd, qdd } = reference;
        let rates = qd.iter().zip(qdd);
        let near = Circles::from_bits(CIRCLES).near(q, &self.last);
        let joints = near.iter().zip(&self.last).zip(&self.step).zip(rates);
        let mut fault = Ok(());
        for (joint, (((&q, &last), &step), (qd, qdd))) in joints.enumerate() {
            let is_near = (q - last).abs() <= step;
            if !(is_near & q.is_finite() & qd.is_finite() & qdd.is_finite()) {
                fault = fault.and(Err(Fault::Reference { joint }));
            }
        }
        // Without a fault: a step at its limit, or rates whose sum is not finite.
        self.last = *q;
        fault
    }

    /// Forgets the last reference: after missed ticks, or at the start of another motion.
    pub fn restart(&mut self) {
        self.started = false;
    }
}
