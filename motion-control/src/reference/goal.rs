//! A goal that may change at any tick.
//!
//! Each joint has the fastest motion within its limits (`course.rs`); those of the joints that
//! would arrive before the last one are slower, so that all arrive together. The crate `rsruckig`
//! does the same in f64 with a heap, which targets lack: `docs/decisions/0010-robots-from-files.md`.

use core::fmt;

use crate::limits::{ConfigError, ConfigParameter};
use crate::reference::{GeometricPath, PathPoint, Reference};
use crate::{entry, real};
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};

mod change;
mod course;
#[cfg(test)]
mod tests;

pub use change::GoalChange;

use course::{Course, Fastest, Phase, Start};

/// The limits of a joint's motion with limited jerk.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct JerkLimits<R> {
    /// Greatest |q̇|, rad/s or m/s.
    pub velocity: R,
    /// Greatest |q̈|, rad/s² or m/s².
    pub acceleration: R,
    /// Greatest |d³q/dt³|, rad/s³ or m/s³.
    pub jerk: R,
}

/// The motion to a goal that may change at any tick, from any state, with limits of velocity,
/// acceleration and jerk: the reference of a controller.
///
/// Every joint arrives with the last one, up to 2 % of the duration before it, or earlier if it
/// cannot: a joint that has to brake as fast as it can has no slower motion. Positions between start and goal
/// stay between them, but for what a joint needs to turn back.
///
/// Limits of torque are kept as well by [`MovingGoal::set_within`], which lowers the limits of
/// velocity and acceleration. The limits may change on the way: [`MovingGoal::set_limits`].
///
/// ```
/// use motion_control::reference::{JerkLimits, MovingGoal, Reference};
/// let limits = [JerkLimits { velocity: 2.0, acceleration: 10.0, jerk: 100.0 }];
/// let mut goal = MovingGoal::try_new(&[0.0_f32], limits, 1e-3)?;
/// // 1.5 rad at 2 rad/s, and the times of acceleration and jerk: 1.5/2 + 2/10 + 10/100 s.
/// assert_eq!(goal.set(0, &[1.5])?, 1051);
/// // On the way the goal moves back; the joint turns with all of its limits kept.
/// let before = goal.at(400);
/// goal.set(400, &[0.2])?;
/// assert_eq!(goal.at(400).q, before.q);
/// let end = goal.at(goal.ticks());
/// assert_eq!((end.q, end.qd, end.qdd), ([0.2], [0.0], [0.0]));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "online trajectory generation")]
#[doc(alias = "Ruckig")]
#[doc(alias = "jerk-limited")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingGoal<R, const V: usize> {
    limits: [JerkLimits<R>; V],
    /// Whether they have changed since the motion was found.
    is_relimited: bool,
    tick: R,
    joints: [[Knot<R>; KNOTS]; V],
    /// The tick of the last change of the goal, the ticks from there to the arrival, and the
    /// seconds.
    start: u32,
    ticks: u32,
    seconds: R,
}

/// The starts of a joint's seven jerks, and the rest at the goal.
const KNOTS: usize = 8;

/// The start of a time with one jerk.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot<R> {
    /// Since the start of the motion, s.
    time: R,
    q: R,
    v: R,
    a: R,
    jerk: R,
}

/// The share of the limits that is left for rounding.
const MARGIN: f64 = 1.0 / 65536.0;
/// A share of a limit by which rounding may exceed it.
const ROUNDED: f64 = 1.0 + MARGIN / 16.0;

/// The reason why a goal is refused; the motion is then as before. Joints are numbered from 0.
///
/// ```
/// use motion_control::reference::{GoalError, JerkLimits, MovingGoal};
/// let limits = [JerkLimits { velocity: 2.0, acceleration: 10.0, jerk: 100.0 }; 2];
/// let mut goal = MovingGoal::try_new(&[0.0_f32; 2], limits, 1e-3)?;
/// let error = goal.set(0, &[0.3, f32::NAN]).unwrap_err();
/// assert_eq!(error, GoalError::NotFinite { joint: 1 });
/// assert_eq!(error.to_string(), "joint 1: its goal or its state is not finite");
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum GoalError {
    /// A joint's goal or state is not finite.
    NotFinite {
        /// The joint.
        joint: usize,
    },
    /// A joint accelerates more than its limit allows. A velocity above its limit is no error.
    Start {
        /// The joint.
        joint: usize,
    },
    /// The motion takes 2³² ticks or more.
    TooLong,
    /// The tick in which a motion starts is over, or comes before the motion is found, or the goal
    /// was set meanwhile, or its limits.
    Missed,
    /// No slower motion from this state keeps the joint's limit of torque.
    Torque {
        /// The joint.
        joint: usize,
    },
}

impl fmt::Display for GoalError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite { joint } => {
                write!(out, "joint {joint}: its goal or its state is not finite")
            }
            Self::Start { joint } => {
                write!(out, "joint {joint}: its acceleration is beyond its limit")
            }
            Self::TooLong => out.write_str("the motion takes 2^32 ticks or more"),
            Self::Missed => out.write_str("the tick of the change is over, or the goal was set"),
            Self::Torque { joint } => {
                write!(out, "joint {joint}: no slower motion keeps its limit of torque")
            }
        }
    }
}

impl core::error::Error for GoalError {}

impl<R: Real> JerkLimits<R> {
    /// These limits of each joint without the share that is left for rounding.
    fn within<const V: usize>(limits: [Self; V]) -> Result<[Self; V], ConfigError> {
        for (joint, Self { velocity, acceleration, jerk }) in limits.into_iter().enumerate() {
            for limit in [velocity, acceleration, jerk] {
                let is_usual = (limit >= R::from_f64(1e-9)) & (limit <= R::from_f64(1e9));
                ConfigParameter::JerkLimit { joint }.require(is_usual)?;
            }
        }
        let less = |x| x * R::from_f64(1.0 - MARGIN);
        Ok(limits.map(|Self { velocity, acceleration, jerk }| Self {
            velocity: less(velocity),
            acceleration: less(acceleration),
            jerk: less(jerk),
        }))
    }
}

impl<R: Real, const V: usize> MovingGoal<R, V> {
    /// Rest at `q`, rad or m, with ticks of `tick` seconds.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] if the tick is not a positive number, a limit not within 10⁻⁹ and
    /// 10⁹, or a position not finite.
    pub fn try_new(q: &[R; V], limits: [JerkLimits<R>; V], tick: R) -> Result<Self, ConfigError> {
        ConfigParameter::Tick.positive(tick)?;
        ConfigParameter::RestPosition.require(all_finite(q))?;
        let limits = JerkLimits::within(limits)?;
        let joints = q.map(|q| [Knot::rest(R::ZERO, q); KNOTS]);
        let is_relimited = false;
        Ok(Self { limits, is_relimited, tick, joints, start: 0, ticks: 0, seconds: R::ZERO })
    }

    /// Replaces the limits of velocity, acceleration and jerk (rad/s, rad/s² and rad/s³, or with m)
    /// of the motions that are set from now on. The motion that is under way keeps its own until
    /// then; the next one starts anew, also if it goes to the same goal. Calls with limits that are
    /// not new do nothing.
    ///
    /// A joint that is faster than its new limit of velocity then brakes. The limits of
    /// acceleration and jerk hold in every tick, and that of velocity from the end of the braking
    /// on. Until then the speed is at most the greater of |v₀| and |v₀ + a₀|a₀|/2j|, at which the
    /// acceleration of the change can end at the earliest. The speed falls to the limit and not
    /// below it, unless the joint decelerates already so much that it must. If the goal is too near
    /// for a stop from the limit, the joint brakes further; if it is too near for any stop, the
    /// joint turns back. A goal that is refused leaves the motion under way, and its limits, as they
    /// are.
    ///
    /// ```
    /// use motion_control::reference::{JerkLimits, MovingGoal, Reference};
    /// let fast = JerkLimits { velocity: 2.0, acceleration: 10.0, jerk: 100.0 };
    /// let mut goal = MovingGoal::try_new(&[0.0_f32], [fast], 1e-3)?;
    /// goal.set(0, &[3.0])?;
    /// // A door opens while the joint has 2 rad/s: from there 1.5/10 + 10/100 s to 0.5 rad/s.
    /// goal.set_limits([JerkLimits { velocity: 0.5, ..fast }])?;
    /// let arrival = goal.set(500, &[3.0])?;
    /// assert!(goal.at(500).qd[0] > 1.99 && goal.at(700).qd[0] > 0.5);
    /// assert!((751..arrival).all(|tick| goal.at(tick).qd[0] <= 0.5));
    /// assert_eq!(goal.at(arrival).q, [3.0]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Cost
    /// Three comparisons for each joint, and those of the next motion.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] of a limit that is not within 10⁻⁹ and 10⁹, which changes
    /// nothing. The next motion is refused by [`GoalError::Start`] while a joint accelerates more
    /// than a lower limit of acceleration allows: lower that of velocity first.
    ///
    /// # Source
    /// The brake before the motion of Berscheid & Kröger (2021), which here ends without
    /// acceleration.
    pub fn set_limits(&mut self, limits: [JerkLimits<R>; V]) -> Result<(), ConfigError> {
        let limits = JerkLimits::within(limits)?;
        self.is_relimited |= limits != self.limits;
        self.limits = limits;
        Ok(())
    }

    /// Moves the goal at a tick: from its state there, the reference goes to rest at `goal`, rad or
    /// m. Returns the tick of the arrival. The motion to a goal that is set again goes on as it is.
    ///
    /// The tick is that of the controller:
    /// [`MotionController::trajectory_tick`](crate::motion::MotionController::trajectory_tick).
    ///
    /// # Cost
    /// Two to 29 evaluations of a motion for each joint, of some 150 instructions each, all in one
    /// tick: `docs/costs.md` in the repository. [`Self::begin_within`] spreads them.
    ///
    /// # Errors
    /// [`GoalError`]; the motion is then as before.
    ///
    /// # Source
    /// Haschke, Weitnauer & Ritter (2008); Berscheid & Kröger, "Jerk-limited real-time trajectory
    /// generation with arbitrary target states" (2021), whose durations are compared.
    pub fn set(&mut self, tick: u32, goal: &[R; V]) -> Result<u32, GoalError> {
        if self.goes_to(goal) {
            return Ok(tick.max(self.ticks()));
        }
        let state = self.at(tick);
        self.plan(tick, &state, goal, self.is_relimited)
    }

    /// Moves the goal as [`Self::set`], from a state that replaces that of the reference: of an arm
    /// that was led elsewhere. A joint that is too fast brakes as after [`Self::set_limits`].
    ///
    /// # Errors
    /// [`GoalError`]; the motion is then as before.
    pub fn set_from(
        &mut self,
        tick: u32,
        from: &State<R, V, V>,
        goal: &[R; V],
    ) -> Result<u32, GoalError> {
        self.plan(tick, from, goal, true)
    }

    /// The duration of the motion since the goal has moved, s.
    pub fn seconds(&self) -> R {
        self.seconds
    }

    fn goes_to(&self, goal: &[R; V]) -> bool {
        !self.is_relimited && self.joints.iter().zip(goal).all(|([.., end], q)| end.q == *q)
    }

    fn plan(
        &mut self,
        tick: u32,
        from: &State<R, V, V>,
        goal: &[R; V],
        is_new: bool,
    ) -> Result<u32, GoalError> {
        self.check(from, goal, is_new)?;
        let joints = core::array::from_fn(|joint| {
            let start = self.joint(joint, from, goal);
            (start, start.fastest())
        });
        self.adopt(tick, (from, goal), &joints)
    }

    /// A state that is `is_new` to the limits may be beyond them.
    fn check(&self, from: &State<R, V, V>, goal: &[R; V], is_new: bool) -> Result<(), GoalError> {
        for (joint, limits) in self.limits.iter().enumerate() {
            let [v, a] = [&from.qd, &from.qdd].map(|rate| entry(rate, joint));
            let length = entry(goal, joint) - entry(&from.q, joint);
            if !all_finite(&[length, v, a]) {
                return Err(GoalError::NotFinite { joint });
            }
            // A time is rounded, too.
            let late = || R::from_f64(2.0) * R::EPSILON * self.seconds;
            let most = || limits.acceleration * R::from_f64(ROUNDED) + limits.jerk * late();
            if is_new && a.abs() > most() {
                return Err(GoalError::Start { joint });
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn joint(&self, joint: usize, from: &State<R, V, V>, goal: &[R; V]) -> Start<R> {
        let limits = self.limits.get(joint).copied().unwrap_or(JerkLimits {
            velocity: R::ONE,
            acceleration: R::ONE,
            jerk: R::ONE,
        });
        let [q, v, a] = [&from.q, &from.qd, &from.qdd].map(|numbers| entry(numbers, joint));
        Start::new(&limits, v, a, entry(goal, joint) - q)
    }

    /// The motion from a tick on, whose fastest motions are known; all joints arrive with the last.
    #[inline(never)]
    fn adopt(
        &mut self,
        tick: u32,
        (from, goal): (&State<R, V, V>, &[R; V]),
        joints: &[(Start<R>, Fastest<R>); V],
    ) -> Result<u32, GoalError> {
        let mut seconds = R::ZERO;
        for (_, Fastest { time, .. }) in joints {
            // A duration that is not finite stays.
            seconds = if seconds >= *time { seconds } else { *time + R::ZERO * seconds };
        }
        let exact = seconds / self.tick;
        let whole = exact.to_u32();
        let ticks = whole.checked_add(u32::from(real::<R>(whole) < exact));
        let arrival = ticks.and_then(|ticks| tick.checked_add(ticks)).filter(|_| exact.is_finite());
        let (Some(ticks), Some(arrival)) = (ticks, arrival) else {
            return Err(GoalError::TooLong);
        };
        let ways = from.q.iter().zip(goal);
        for ((knots, joint), (&q, &goal)) in self.joints.iter_mut().zip(joints).zip(ways) {
            let (start, fastest) = joint;
            let course = start.course(fastest, seconds);
            *knots = Knot::knots(q, start.direction, &course, goal);
        }
        (self.start, self.ticks, self.seconds) = (tick, ticks, seconds);
        self.is_relimited = false;
        Ok(arrival)
    }

    /// The state at a time since the goal has moved, s.
    fn state(&self, time: R) -> State<R, V, V> {
        let mut state = State::at([R::ZERO; V]);
        let rates = state.qd.iter_mut().zip(&mut state.qdd);
        for ((knots, q), (qd, qdd)) in self.joints.iter().zip(&mut state.q).zip(rates) {
            let [first, ..] = knots;
            let mut knot = first;
            for next in knots {
                knot = if next.time <= time { next } else { knot };
            }
            (*q, *qd, *qdd) = knot.after(time - knot.time);
        }
        state
    }
}

impl<R: Real> Knot<R> {
    fn rest(time: R, q: R) -> Self {
        Self { time, q, v: R::ZERO, a: R::ZERO, jerk: R::ZERO }
    }

    /// Position, velocity and acceleration after a time.
    fn after(&self, t: R) -> (R, R, R) {
        let half = R::from_f64(0.5);
        let at = self.jerk * t;
        let change = half * (self.a + R::from_f64(1.0 / 3.0) * at);
        (self.q + t * (self.v + t * change), self.v + t * (self.a + half * at), self.a + at)
    }

    /// The knots of a course from a position.
    fn knots(mut q: R, direction: R, course: &Course<R>, goal: R) -> [Self; KNOTS] {
        let mut knots = [Self::rest(R::ZERO, goal); KNOTS];
        let mut start = R::ZERO;
        for (knot, &Phase { time, way, v, a, jerk }) in knots.iter_mut().zip(course) {
            let [v, a, jerk] = [v, a, jerk].map(|rate| direction * rate);
            *knot = Self { time: start, q, v, a, jerk };
            q += direction * way;
            start += time;
        }
        let [.., end] = &mut knots;
        end.time = start;
        knots
    }
}

impl<R: Real, const V: usize> Reference<R, V> for MovingGoal<R, V> {
    /// Cost: 50 flops and comparisons for each joint.
    #[inline]
    fn at(&self, tick: u32) -> State<R, V, V> {
        let ticks = tick.saturating_sub(self.start);
        let time = real::<R>(ticks) * self.tick;
        // The times of the jerks may round to more than that of the arrival.
        self.state(if ticks < self.ticks { time } else { time + self.seconds })
    }

    /// The tick of the arrival.
    fn ticks(&self) -> u32 {
        self.start.saturating_add(self.ticks)
    }
}

/// The way from where the goal was set, for a [`TimedPath`](crate::reference::TimedPath), which
/// limits the torques as well, up to some 2 % at its ends: for a goal that was set at rest.
impl<R: Real, const V: usize> GeometricPath<R, V> for MovingGoal<R, V> {
    fn point(&self, s: R) -> PathPoint<R, V> {
        let State { q, qd, qdd } = self.state(s * self.seconds);
        PathPoint {
            q,
            slope: qd.map(|v| v * self.seconds),
            curvature: qdd.map(|a| a * (self.seconds * self.seconds)),
        }
    }
}
