//! Claims about goals that move: durations against Ruckig, and limits on the way.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::ops::Range;

use dynamics_core::effects::{Armature, Coulomb, RIGID_BODY, Viscous, Width};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::recordings;
use motion_control::limits::MotionLimits;
use motion_control::reference::{
    GoalChange, GoalError, JerkLimits, JointFriction, MovingGoal, PathLimits, Reference, TimedPath,
};
use serde::Deserialize;

use crate::common::{Rng, few_or_many};

const TICK: f32 = 1e-3;
/// What random goals use of the limits at least, exceed without limits of torque, and one in how
/// many does: few goals less.
const LEAST: f64 = if cfg!(debug_assertions) { 0.999 } else { 0.9999 };
const WITHOUT: f32 = if cfg!(debug_assertions) { 1.5 } else { 1.9 };
const BEYOND: u32 = few_or_many(5, 2) as u32;
/// The delay of a change that is spread over ticks.
const SPREAD: u32 = 7;

/// The output of `host-tests/oracle/moving_goals.py`.
#[derive(Deserialize)]
struct Recording {
    problems: Vec<Problem>,
}

/// The limits of velocity, acceleration and jerk of each joint, its velocity and acceleration, and
/// the way to the goal.
#[derive(Deserialize)]
struct Problem {
    joints: [[f64; 6]; 6],
    seconds: f64,
}

/// Least and greatest duration as shares of those of Ruckig, in which the limits have a factor.
fn shares(problems: &[Problem], factor: f64) -> [f64; 2] {
    let mut range = [f64::INFINITY, 0.0_f64];
    for Problem { joints, seconds } in problems {
        let limits = joints.map(|[velocity, acceleration, jerk, ..]| {
            let [velocity, acceleration, jerk] = [velocity, acceleration, jerk].map(|x| factor * x);
            JerkLimits { velocity, acceleration, jerk }
        });
        let [qd, qdd, goal] = [3, 4, 5].map(|k| joints.map(|joint| joint[k]));
        let mut motion = MovingGoal::try_new(&[0.0; 6], limits, 1e-3).unwrap();
        let from = State { q: [0.0; 6], qd, qdd };
        motion.set_from(0, &from, &goal).unwrap();
        let share = motion.seconds() / seconds;
        range = [range[0].min(share), range[1].max(share)];
    }
    range
}

#[test]
fn durations_are_those_of_ruckig_within_five_per_cent() {
    let recording: Recording = recordings::read("moving_goals");
    assert_eq!(recording.problems.len(), 1500);
    let [least, most] = shares(&recording.problems, 1.0);
    assert!(least >= 1.0 && most < 1.05, "{least} {most}");
    // Other limits are found: all durations are then less, or the longest too long.
    let [least, _] = shares(&recording.problems, 1.001);
    assert!(least < 1.0, "{least}");
}

/// How far a motion goes beyond a limit, as shares of the limits of velocity, acceleration and jerk,
/// and how far its positions are from the integral of its velocities, rad.
#[derive(Debug, Default)]
struct Seen {
    shares: [f64; 3],
    apart: f64,
    goals: u32,
    /// Joints that move, and those that arrive before 0.95 of the duration.
    joints: u32,
    early: u32,
}

impl Seen {
    fn see(&mut self, of: usize, share: f64) {
        self.shares[of] = self.shares[of].max(share);
    }

    /// One tick of the motion: its jerk is constant, or changes once.
    fn tick(
        &mut self,
        motion: &impl Reference<f32, 6>,
        seconds: f32,
        limits: &[JerkLimits<f32>; 6],
        tick: u32,
    ) {
        let [before, after] = [tick, tick + 1].map(|tick| motion.at(tick));
        for (j, limits) in limits.iter().enumerate() {
            let of = |rate: fn(&State<f32, 6, 6>) -> &[f32; 6]| {
                [&before, &after].map(|state| f64::from(rate(state)[j]))
            };
            let [q, qd, qdd] = [of(|s| &s.q), of(|s| &s.qd), of(|s| &s.qdd)];
            let (h, jerk) = (f64::from(TICK), f64::from(limits.jerk));
            self.see(0, qd[1].abs() / f64::from(limits.velocity));
            self.see(1, qdd[1].abs() / f64::from(limits.acceleration));
            // Roundings of the acceleration and of the time are a jerk of their own.
            let time = f64::from(seconds) * jerk;
            let rounding = 2.0 * f64::from(f32::EPSILON) * (f64::from(limits.acceleration) + time);
            self.see(2, ((qdd[1] - qdd[0]).abs() - rounding) / (jerk * h));
            let trapezoid = 0.5 * h * (qd[0] + qd[1]);
            let curved = h * h * (qdd[1] - qdd[0]).abs() / 6.0 + jerk * h * h * h / 6.0;
            self.apart = self.apart.max((q[1] - q[0] - trapezoid).abs() - curved);
        }
    }
}

fn limits(rng: &mut Rng) -> JerkLimits<f32> {
    let mut factor =
        |low: f64, decades: f64| 10.0_f64.powf(low + decades * 0.5 * (1.0 + rng.within(1.0)));
    let velocity = factor(-0.5, 1.5);
    let acceleration = velocity * factor(-0.3, 1.5);
    let jerk = acceleration * factor(-0.3, 1.5);
    let [velocity, acceleration, jerk] = [velocity, acceleration, jerk].map(|x| x as f32);
    JerkLimits { velocity, acceleration, jerk }
}

/// Whether states differ by roundings alone.
fn is_near(state: &State<f32, 6, 6>, other: &State<f32, 6, 6>) -> bool {
    let near = |a: &[f32; 6], b: &[f32; 6]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
    state.q == other.q && near(&state.qd, &other.qd) && near(&state.qdd, &other.qdd)
}

/// Goals at random ticks: near, far, and where the joint is. A change that is spread over ticks, and
/// starts in the same one, is the same.
fn random_goals(goals: u32, mut out: impl Write) -> Seen {
    let mut rng = Rng::new(50);
    let mut seen = Seen::default();
    for _ in 0..goals / 20 {
        let limits: [_; 6] = std::array::from_fn(|_| limits(&mut rng));
        let start = [(); 6].map(|()| rng.within(1.0) as f32);
        let mut motion = MovingGoal::try_new(&start, limits, TICK).unwrap();
        let mut tick = SPREAD;
        for _ in 0..20 {
            let from = motion.at(tick);
            let goal = from.q.map(|q| match rng.below(10) {
                0 => q,
                1..5 => q + (rng.within(1.0) * 10.0_f64.powf(-2.0 + rng.within(2.0))) as f32,
                _ => rng.within(3.0) as f32,
            });
            let (mut spread, begin) = (motion, tick - SPREAD);
            let mut change = spread.begin_within(tick, &goal, &[f32::INFINITY; 6]).unwrap();
            for at in begin + 1..tick {
                change.step(|_| unreachable!()).unwrap();
                assert_eq!(spread.take(at, &change), Ok(None));
            }
            assert_eq!(change.step(|_| unreachable!()), Ok(true));
            let arrival = motion.set(tick, &goal).unwrap();
            assert_eq!((spread.take(tick, &change), spread), (Ok(Some(arrival)), motion));
            assert!(is_near(&motion.at(tick), &from), "{from:?} {motion:?}");
            assert_eq!(motion.at(arrival), State::at(goal));
            let ticks = arrival - tick;
            // Every tick of one motion in twenty, and twenty ticks of each other one.
            let all = seen.goals.is_multiple_of(20);
            for k in 0..if all { ticks } else { 20 } {
                let at = if all { k } else { rng.below(ticks as usize + 1) as u32 };
                seen.tick(&motion, motion.seconds(), &limits, tick + at);
            }
            seen.goals += 1;
            let late = motion.at(tick + (0.95 * f64::from(ticks)) as u32);
            for j in (0..6).filter(|&j| ticks > 100 && (goal[j] - from.q[j]).abs() > 1e-3) {
                seen.joints += 1;
                seen.early += u32::from(late.q[j] == goal[j] && late.qd[j] == 0.0);
            }
            for j in 0..6 {
                let JerkLimits { velocity, acceleration, jerk } = limits[j];
                let joint = [velocity, acceleration, jerk, from.qd[j], from.qdd[j]];
                let way = f64::from(goal[j]) - f64::from(from.q[j]);
                let all = joint.into_iter().map(f64::from).chain([way]);
                all.for_each(|x| out.write_all(&x.to_le_bytes()).unwrap());
            }
            out.write_all(&f64::from(motion.seconds()).to_le_bytes()).unwrap();
            tick += rng.below((1.1 * f64::from(ticks)) as usize + 2) as u32;
        }
    }
    seen
}

/// `GOALS=FILE` writes the problems and durations for `host-tests/oracle/moving_goals.py FILE`.
#[test]
fn random_goals_exceed_no_limit() {
    let file = std::env::var_os("GOALS").map(|path| File::create(path).unwrap());
    let goals = few_or_many(100, 100_000) as u32;
    let seen = match file {
        Some(file) => random_goals(goals, BufWriter::new(file)),
        None => random_goals(goals, std::io::sink()),
    };
    assert_eq!(seen.goals, goals);
    // The limits are used, but for what is left for rounding.
    for share in seen.shares {
        assert!((LEAST..=1.0).contains(&share), "{seen:?}");
    }
    assert!(seen.apart < 2e-6, "{seen:?}");
    assert!(seen.joints > 3 * goals && seen.early <= seen.joints / 1000, "{seen:?}");
}

/// A motion whose positions are off by this factor.
struct Off<'a>(&'a MovingGoal<f32, 6>, f32);

impl Reference<f32, 6> for Off<'_> {
    fn at(&self, tick: u32) -> State<f32, 6, 6> {
        let state = self.0.at(tick);
        State { q: state.q.map(|q| self.1 * q), ..state }
    }

    fn ticks(&self) -> u32 {
        Reference::<f32, 6>::ticks(self.0)
    }
}

#[test]
fn limits_that_are_exceeded_and_other_positions_are_seen() {
    let limits = [JerkLimits { velocity: 1.0, acceleration: 4.0, jerk: 40.0 }; 6];
    let mut motion = MovingGoal::try_new(&[0.0; 6], limits, TICK).unwrap();
    let arrival = motion.set(0, &[1.5; 6]).unwrap();
    let seen = |limits: &[JerkLimits<f32>; 6], factor| {
        let mut seen = Seen::default();
        let off = Off(&motion, factor);
        (0..arrival).for_each(|tick| seen.tick(&off, motion.seconds(), limits, tick));
        seen
    };
    let right = seen(&limits, 1.0);
    assert!(right.shares.iter().all(|share| (0.999..=1.0).contains(share)), "{right:?}");
    assert!(right.apart < 2e-6, "{right:?}");
    let less = limits.map(|JerkLimits { velocity, acceleration, jerk }| JerkLimits {
        velocity: 0.99 * velocity,
        acceleration: 0.99 * acceleration,
        jerk: 0.99 * jerk,
    });
    assert!(seen(&less, 1.0).shares.iter().all(|share| *share > 1.0));
    assert!(seen(&limits, 1.01).apart > 2e-6);
}

/// The same way within limits of torque takes longer, and its torques are within them.
#[test]
fn the_way_of_a_goal_has_a_time_within_limits_of_torque() {
    let limits = [JerkLimits { velocity: 3.0, acceleration: 20.0, jerk: 400.0 }; 6];
    let start = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
    let mut goal = MovingGoal::try_new(&start, limits, 1e-3).unwrap();
    goal.set(0, &[1.5, -0.8, 1.2, -1.2, -1.57, 0.3]).unwrap();
    let effects = (RIGID_BODY, Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]));
    let torques = |state: &State<f64, 6, 6>| Core::<Ur5e>::rnea(state, &effects);
    let torque = [60.0, 100.0, 60.0, 15.0, 15.0, 15.0];
    let most = |motion: &dyn Fn(u32) -> State<f64, 6, 6>, ticks: u32| {
        let shares = (0..=ticks).map(|tick| {
            let tau = torques(&motion(tick));
            (0..6).map(|j| tau[j].abs() / torque[j]).fold(0.0, f64::max)
        });
        shares.fold(0.0, f64::max)
    };
    let path = PathLimits {
        torque,
        motion: [MotionLimits { velocity: 3.0, acceleration: 20.0 }; 6],
        friction: [JointFriction::NONE; 6],
    };
    let timed = TimedPath::<_, _, 201>::new(&goal, 1e-3, &path, torques).unwrap();
    let fast = most(&|tick| goal.at(tick), Reference::<f64, 6>::ticks(&goal));
    let slow = most(&|tick| timed.at(tick), Reference::<f64, 6>::ticks(&timed));
    // Between the points of the grid the limits are exceeded by what the coefficients curve, which is
    // most at the ends, where q′ vanishes.
    assert!(fast > 1.15 && slow < 1.02, "{fast} {slow}");
    assert!(timed.seconds() < 2.0 * goal.seconds(), "{} {}", timed.seconds(), goal.seconds());
    assert_eq!(timed.at(u32::MAX).q, goal.at(u32::MAX).q);
}

/// What random goals within limits of torque show: the greatest torques as shares of the limits, and
/// without the limits; the goals that exceed them then; those that are refused; the most steps.
#[derive(Debug, Default)]
struct Within {
    within: f32,
    without: f32,
    beyond: u32,
    refused: u32,
    steps: u32,
}

/// Goals at random ticks, from rest and on the way, each with 16 steps of its search in a tick: so
/// far around a position, and with friction so wide.
fn goals_within_torques(goals: u32, around: f64, width: f32) -> Within {
    let limits = [JerkLimits { velocity: 3.0, acceleration: 20.0, jerk: 400.0 }; 6];
    let torque = [60.0, 100.0, 60.0, 15.0, 15.0, 15.0];
    let friction = Coulomb { torque: [5.0, 5.0, 4.0, 1.0, 1.0, 1.0], width: Width::f32(width) };
    let armature = Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]);
    let effects = (RIGID_BODY, armature, friction, Viscous([4.0, 4.0, 4.0, 1.0, 1.0, 1.0]));
    let torques = |state: &State<f32, 6, 6>| Engine::<Ur5e>::rnea(state, &effects);
    let most = |motion: &MovingGoal<f32, 6>, ticks: Range<u32>| {
        let taus = ticks.flat_map(|tick| torques(&motion.at(tick)).into_iter().zip(torque));
        taus.map(|(tau, limit)| tau.abs() / limit).fold(0.0, f32::max)
    };
    let (mut rng, home) = (Rng::new(51), [0.0, -1.57, 1.57, -1.57, -1.57, 0.0]);
    let mut motion = MovingGoal::try_new(&home, limits, TICK).unwrap();
    let (mut seen, mut tick, delay) = (Within::default(), 0, 153);
    for _ in 0..goals {
        let (start, goal) = (tick + delay, home.map(|q| q + rng.within(around) as f32));
        seen.within = seen.within.max(most(&motion, tick..start));
        let mut change = motion.begin_within(start, &goal, &torque).unwrap();
        let (mut steps, mut found) = (0, Ok(false));
        for now in tick..start {
            assert_eq!(motion.take(now, &change), Ok(None));
            for _ in 0..16 {
                steps += u32::from(found == Ok(false));
                found = change.step(torques);
            }
        }
        seen.steps = seen.steps.max(steps);
        let (mut without, before) = (motion, motion);
        let free = without.set(start, &goal).unwrap();
        let share = most(&without, start..free);
        (seen.without, seen.beyond) =
            (seen.without.max(share), seen.beyond + u32::from(share > 1.0));
        let arrival = match found {
            Ok(_) => motion.take(start, &change).unwrap().unwrap(),
            Err(error) => {
                assert!(matches!(error, GoalError::Torque { .. }), "{error}");
                assert_eq!((motion.take(start, &change), motion), (Err(GoalError::Missed), before));
                seen.refused += 1;
                continue;
            }
        };
        assert_eq!(motion.at(arrival), State::at(goal));
        seen.within = seen.within.max(most(&motion, start..arrival));
        tick = start + rng.below((1.1 * f64::from(arrival - start)) as usize) as u32;
    }
    seen
}

#[test]
fn random_goals_keep_limits_of_torque() {
    for (many, around, width) in [(3_000, 1.2, 0.02), (1_000, 3.0, 0.02), (1_000, 2.5, 0.002)] {
        let goals = few_or_many(many / 200, many) as u32;
        let seen = goals_within_torques(goals, around, width);
        assert!(seen.within < 1.02 && seen.refused <= goals / 100, "{seen:?}");
        assert!(seen.steps <= GoalChange::<f32, 6>::MOST_STEPS, "{seen:?}");
        // Without the limits of torque they are exceeded.
        assert!(seen.without > WITHOUT && seen.beyond >= goals / BEYOND, "{seen:?}");
    }
}

/// Gravity alone is beyond a limit on the way, and a joint that is fast cannot brake.
#[test]
fn a_goal_that_no_slower_motion_reaches_is_refused() {
    let limits = [JerkLimits { velocity: 3.0, acceleration: 20.0, jerk: 400.0 }];
    let mut goal = MovingGoal::try_new(&[0.0_f64], limits, 1e-3).unwrap();
    let torques = |state: &State<f64, 1, 1>| [2.0 * state.qdd[0] + 12.0 * state.q[0].sin()];
    let error = Err(GoalError::Torque { joint: 0 });
    assert_eq!(goal.set_within(0, &[1.5], &[11.0], torques), error);
    assert_eq!(goal.set_within(0, &[1.5], &[f64::NAN], torques), error);
    let not_finite = Err(GoalError::NotFinite { joint: 0 });
    assert_eq!(goal.set_within(0, &[1.5], &[11.0], |_| [f64::NAN]), not_finite);
    assert_eq!(goal, MovingGoal::try_new(&[0.0], limits, 1e-3).unwrap());
    goal.set_within(0, &[1.5], &[13.0], torques).unwrap();
    assert_eq!(goal.set_within(400, &[0.0], &[1.0], torques), error);
}
