//! Limits of torque of a goal that moves.
//!
//! The torques of a motion are sampled, and the limits of velocity and acceleration lowered until no
//! sample exceeds its limit. Along a path q(s) whose time is stretched, the torque beyond that at
//! rest c is proportional to ṡ² (Hollerbach, "Dynamic scaling of manipulator trajectories", 1984),
//!
//! ```text
//! τ = c + β (a s̈ + b ṡ²)      β_all = (τ_max − c)/(τ − c)      β_a = (τ_max − c − b ṡ²)/(a s̈)
//! ```
//!
//! so that velocities √β, accelerations β and jerks β^(3/2) times as great are within the limit. If
//! the accelerations alone take little more off, the velocities stay. A motion to rest from a state
//! that moves is no such path, and friction no such torque: the samples are then taken anew, in at
//! most [`ROUNDS`] rounds. No limit is lowered below what the state at the start has, but that of
//! velocity of a joint which is faster than the user allows, and brakes.

use super::{Fastest, GoalError, JerkLimits, KNOTS, Knot, MARGIN, MovingGoal, Start};
use crate::reference::Reference;
use crate::{entry, real, root};
use dynamics_core::scalar::{Real, positive_part};
use dynamics_core::state::State;

/// The number of intervals of equal times, with a sample at the end of each, and the parts of an
/// interval, which have samples of their own if a torque at its ends is near its limit.
const INTERVALS: usize = 32;
const PARTS: usize = 8;
const EVEN: usize = INTERVALS * PARTS;
/// The share of a limit that is near: the torque between two samples may be that much greater.
const NEAR: f64 = 0.625;
/// The number of samples of a joint: at the start of each jerk but the first, which is the start of
/// the motion, and after the joint turns back, when its friction has changed its sign.
const JERKS: usize = KNOTS - 2;
const OF_JOINT: usize = JERKS + 1;
/// The ticks between the turn of a joint and its sample.
const TURN: f64 = 2.0;
/// The greatest number of rounds.
const ROUNDS: u32 = 8;
/// The margin of the first round, as a share of τ_max − c; that of round n is n times as great.
const AIM: f64 = 1.0 / 32.0;
/// The least share of a limit: a motion that takes 64 times as long.
const LEAST: f64 = 1.0 / 4096.0;
/// The share of a limit by which the torque at the start may exceed it, and then the motion's too:
/// the last motion was sampled, and has its greatest torque between two samples.
const BETWEEN: f64 = 1.0 + 1.0 / 64.0;

/// A change of the goal that is computed in several ticks, with limits of torque or without:
/// [`MovingGoal::begin_within`].
#[derive(Clone, Copy, Debug)]
pub struct GoalChange<R, const V: usize> {
    start: u32,
    from: State<R, V, V>,
    goal: [R; V],
    joints: [(Start<R>, Fastest<R>); V],
    /// Whether the motion that is under way goes to this goal, and is sampled first.
    again: bool,
    /// The motion of this round, and its limits.
    motion: MovingGoal<R, V>,
    limits: [JerkLimits<R>; V],
    torque: [R; V],
    /// The shares of the velocities and the accelerations, and what the samples leave of them.
    shares: [R; 2],
    left: [R; 2],
    /// Whether a torque at the last end of an interval was near its limit.
    is_near: bool,
    step: usize,
    /// The steps of a round, which has no samples if no torque is limited.
    last: usize,
    round: u32,
    /// The joint whose torque is beyond its limit.
    joint: usize,
}

impl<R: Real> JerkLimits<R> {
    /// These shares of the limits, but no less than a joint with this state needs.
    fn lowered(&self, [speed, share]: [R; 2], v: R, a: R) -> Self {
        let (half, greatest) = (R::from_f64(0.5), |x: R, y: R| if x > y { x } else { y });
        let along = if a < R::ZERO { -v } else { v };
        let needed = half * a * a / (positive_part(self.velocity - along) + R::MIN_POSITIVE);
        let jerk = needed.clamped(self.jerk * share * root(share), self.jerk);
        let level = v + half * a * a.abs() / jerk;
        let has = greatest(v.abs(), level.abs());
        let brakes = has > self.velocity * R::from_f64(1.0 + 0.5 * MARGIN);
        Self {
            velocity: greatest(speed * self.velocity, R::either(brakes, R::ZERO, has)),
            acceleration: greatest(share * self.acceleration, a.abs()),
            jerk,
        }
    }
}

impl<R: Real> Knot<R> {
    /// The time at which a joint turns back for the first time.
    fn turn(knots: &[Self; KNOTS]) -> Option<R> {
        let mut phases = knots.iter().zip(knots.iter().skip(1));
        phases.find(|(knot, next)| knot.v * next.v < R::ZERO).map(|(knot, next)| {
            let side = R::either(knot.v < R::ZERO, R::ONE, -R::ONE);
            let square = knot.a * knot.a - (knot.jerk + knot.jerk) * knot.v;
            let t = -(knot.v + knot.v) / (knot.a + side * root(positive_part(square)));
            knot.time + t.clamped(R::ZERO, next.time - knot.time)
        })
    }
}

impl<R: Real, const V: usize> MovingGoal<R, V> {
    /// Moves the goal as [`Self::set`], with torques within `torque`, N·m or N. The motion to a goal
    /// that is set again goes on if it keeps them.
    ///
    /// `inverse_dynamics` returns the torques of a state with all that acts on the arm, friction as
    /// well: [`Engine::rnea`](dynamics_core::Engine::rnea). The limits leave what the feedback needs.
    ///
    /// ```
    /// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e};
    /// use motion_control::reference::{JerkLimits, MovingGoal, Reference};
    /// let limits = [JerkLimits { velocity: 3.0, acceleration: 20.0, jerk: 400.0 }; 6];
    /// let start = [0.0_f32, -1.57, 1.57, -1.57, -1.57, 0.0];
    /// let mut goal = MovingGoal::try_new(&start, limits, 1e-3)?;
    /// let torque = [60.0, 100.0, 60.0, 15.0, 15.0, 15.0];
    /// let torques = |state: &_| Engine::<Ur5e>::rnea(state, &RIGID_BODY);
    /// goal.set_within(0, &[1.5, -0.8, 1.2, -1.2, -1.57, 0.3], &torque, torques)?;
    /// for tick in 0..goal.ticks() {
    ///     let now = torques(&goal.at(tick));
    ///     assert!(now.iter().zip(torque).all(|(now, most)| now.abs() < 1.01 * most));
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Cost
    /// Not for a tick: up to eight motions, each with 32 to 256 samples and seven for each joint, of
    /// one to three calls of `inverse_dynamics`. [`Self::begin_within`] spreads them. On a way of
    /// several turns a sample is far from the next one.
    ///
    /// # Errors
    /// [`GoalError`]; the motion is then as before.
    pub fn set_within(
        &mut self,
        tick: u32,
        goal: &[R; V],
        torque: &[R; V],
        inverse_dynamics: impl Fn(&State<R, V, V>) -> [R; V],
    ) -> Result<u32, GoalError> {
        let mut change = self.begin_within(tick, goal, torque)?;
        while !change.step(&inverse_dynamics)? {}
        self.take(tick, &change)?.ok_or(GoalError::Missed)
    }

    /// Begins to move the goal in a tick whose time is short: the old motion goes on until the new
    /// one is computed. This starts in the tick `start`, from the state that the reference has then:
    /// until then [`GoalChange::step`] is called in each tick as often as there is time for, and
    /// [`Self::take`] once. Limits of torque may be infinite: with no other, V + 1 steps are enough,
    /// which call no inverse dynamics.
    ///
    /// ```
    /// use motion_control::reference::{JerkLimits, MovingGoal, Reference};
    /// let limits = [JerkLimits { velocity: 2.0, acceleration: 20.0, jerk: 400.0 }];
    /// let mut goal = MovingGoal::try_new(&[0.0_f32], limits, 1e-3)?;
    /// let mut change = goal.begin_within(600, &[1.5], &[10.0])?;
    /// let mut arrival = None;
    /// for tick in 0..=600 {
    ///     change.step(|state| [2.0 * state.qdd[0]])?;
    ///     arrival = goal.take(tick, &change)?;
    ///     let _reference = goal.at(tick);
    /// }
    /// // 2 kg·m² within 10 N·m: 4.8 rad/s² in place of 20, and 1.5/2 + 2/4.8 + 4.8/48 s.
    /// assert!((1860..1870).contains(&arrival.unwrap()));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`GoalError`]: [`GoalError::Torque`] of a limit that is not positive.
    pub fn begin_within(
        &self,
        start: u32,
        goal: &[R; V],
        torque: &[R; V],
    ) -> Result<GoalChange<R, V>, GoalError> {
        let from = self.at(start);
        self.check(&from, goal, self.is_relimited)?;
        // Written so that a NaN is refused, too.
        let allows = |limit: &R| *limit > R::ZERO;
        if let Some(joint) = torque.iter().position(|limit| !allows(limit)) {
            return Err(GoalError::Torque { joint });
        }
        let is_limited = torque.iter().any(|limit| limit.is_finite());
        let again = self.goes_to(goal);
        let last = if is_limited { GoalChange::<R, V>::STEPS } else { V + 2 };
        let joints = core::array::from_fn(|j| (self.joint(j, &from, goal), Fastest::UNKNOWN));
        Ok(GoalChange {
            start,
            from,
            goal: *goal,
            joints,
            again,
            motion: *self,
            limits: self.limits,
            torque: *torque,
            shares: [R::ONE; 2],
            left: [R::ONE; 2],
            is_near: true,
            step: if is_limited {
                0
            } else if again {
                last
            } else {
                1
            },
            last,
            round: 0,
            joint: 0,
        })
    }

    /// Starts the motion of a change in its tick: the tick of the arrival, None in those before.
    ///
    /// # Errors
    /// [`GoalError::Missed`] if the tick is over, the motion not found yet, or the goal has moved
    /// meanwhile; the motion is then as before.
    pub fn take(&mut self, tick: u32, change: &GoalChange<R, V>) -> Result<Option<u32>, GoalError> {
        if tick < change.start {
            return Ok(None);
        }
        let is_late = tick > change.start || !change.is_found();
        if is_late || self.limits != change.limits || self.at(tick) != change.from {
            return Err(GoalError::Missed);
        }
        *self = MovingGoal { limits: self.limits, ..change.motion };
        Ok(Some(tick.max(self.ticks())))
    }
}

impl<R: Real, const V: usize> GoalChange<R, V> {
    /// The steps of a round: one for the state at the start, one for each joint, one for the motion,
    /// and the samples.
    const STEPS: usize = 2 + V + EVEN + OF_JOINT * V;

    /// The greatest number of steps of a search: 2,448 for six joints. Most take a tenth of them.
    pub const MOST_STEPS: u32 = ROUNDS * Self::STEPS as u32;

    /// Whether the motion is found, and further steps do nothing.
    pub fn is_found(&self) -> bool {
        self.step >= self.last
    }

    /// A step of the search: true when the motion is found.
    ///
    /// # Cost
    /// At most the search for one joint, which takes 23 evaluations of a motion at most, or six
    /// evaluations for each joint, or a state of the reference and three calls of
    /// `inverse_dynamics`.
    ///
    /// # Errors
    /// [`GoalError::Torque`] if no slower motion keeps the limits: if gravity exceeds one on the way,
    /// or the state at the start is too fast. [`GoalError::NotFinite`] of a torque,
    /// [`GoalError::TooLong`].
    pub fn step(
        &mut self,
        inverse_dynamics: impl Fn(&State<R, V, V>) -> [R; V],
    ) -> Result<bool, GoalError> {
        if self.is_found() {
            return Ok(true);
        }
        if self.round >= ROUNDS {
            return Err(GoalError::Torque { joint: self.joint });
        }
        match self.step.checked_sub(V + 2) {
            Some(sample) => self.sample(sample, inverse_dynamics)?,
            None if self.step == 0 => {
                for (limit, tau) in self.torque.iter_mut().zip(inverse_dynamics(&self.from)) {
                    *limit = tau.abs().clamped(*limit, *limit * R::from_f64(BETWEEN));
                }
                if self.again {
                    self.step = V + 1;
                }
            }
            None => match self.joints.get_mut(self.step - 1) {
                Some((start, fastest)) => *fastest = start.fastest(),
                None => {
                    self.motion.adopt(self.start, (&self.from, &self.goal), &self.joints)?;
                }
            },
        }
        self.step += 1;
        if self.is_found() && self.left != [R::ONE; 2] {
            self.slow_down();
        }
        Ok(self.is_found())
    }

    /// Begins another round with lower limits.
    fn slow_down(&mut self) {
        let Self { from, goal, motion, shares, left, .. } = self;
        for (share, left) in shares.iter_mut().zip(left) {
            *share = (*share * *left).clamped(R::from_f64(LEAST), R::ONE);
            *left = R::ONE;
        }
        let rates = from.qd.iter().zip(&from.qdd);
        for ((to, limits), (&v, &a)) in motion.limits.iter_mut().zip(&self.limits).zip(rates) {
            *to = limits.lowered(*shares, v, a);
        }
        self.joints = core::array::from_fn(|j| (motion.joint(j, from, goal), Fastest::UNKNOWN));
        self.is_near = true;
        self.step = 1;
        self.round += 1;
    }

    /// The torques of a sample, and what they leave of velocities and accelerations.
    fn sample(
        &mut self,
        sample: usize,
        inverse_dynamics: impl Fn(&State<R, V, V>) -> [R; V],
    ) -> Result<(), GoalError> {
        let end = self.motion.seconds;
        let time = match sample.checked_sub(EVEN) {
            None => {
                // The end of an interval is before its parts.
                let (interval, part) = (sample / PARTS, sample % PARTS);
                let part = interval * PARTS + if part == 0 { PARTS } else { part };
                end * real::<R>(part as u32) * R::from_f64(1.0 / EVEN as f64)
            }
            Some(of_joints) => {
                let knots = self.motion.joints.get(of_joints / OF_JOINT);
                let of_joint = 1 + of_joints % OF_JOINT;
                let time = knots.and_then(|knots| match of_joint {
                    ..=JERKS => knots.get(of_joint).map(|knot| knot.time),
                    _ => Knot::turn(knots).map(|t| t + R::from_f64(TURN) * self.motion.tick),
                });
                time.unwrap_or(end)
            }
        };
        // A motion that goes on is sampled from here on.
        let now = real::<R>(self.start.saturating_sub(self.motion.start)) * self.motion.tick;
        let state = self.motion.state(if time > now { time } else { now });
        let torques = inverse_dynamics(&state);
        let keep = |share: R| {
            let mut limits = torques.iter().zip(&self.torque);
            limits.all(|(tau, limit)| tau.abs() <= share * *limit)
        };
        let (keeps, is_near) = (keep(R::ONE), !keep(R::from_f64(NEAR)));
        if sample < EVEN && sample.is_multiple_of(PARTS) {
            let was_near = core::mem::replace(&mut self.is_near, is_near);
            if !(is_near || was_near) || !keeps || self.left != [R::ONE; 2] {
                self.step += PARTS - 1;
            }
        }
        if keeps {
            return Ok(());
        }
        let steady = inverse_dynamics(&State { qdd: [R::ZERO; V], ..state });
        let rest = inverse_dynamics(&State::at(state.q));
        let aim = R::ONE - real::<R>(self.round + 1) * R::from_f64(AIM);
        for (joint, (&tau, &limit)) in torques.iter().zip(&self.torque).enumerate() {
            let side = if tau < R::ZERO { -R::ONE } else { R::ONE };
            let [tau, steady, rest] =
                [tau, entry(&steady, joint), entry(&rest, joint)].map(|tau| side * tau);
            if !(tau + steady + rest).is_finite() {
                return Err(GoalError::NotFinite { joint });
            }
            if tau <= limit {
                continue;
            }
            self.joint = joint;
            if rest >= limit {
                return Err(GoalError::Torque { joint });
            }
            // If the torque is beyond the limit without acceleration, nothing of it is left.
            let [all, accelerations] = [rest, steady]
                .map(|from| aim * ((limit - from) / (tau - from)).clamped(R::ZERO, R::ONE));
            let [speed, share] = if accelerations + accelerations >= all {
                [R::ONE, accelerations]
            } else {
                [root(all), all]
            };
            for (left, now) in self.left.iter_mut().zip([speed, share]) {
                *left = if now < *left { now } else { *left };
            }
        }
        Ok(())
    }
}
