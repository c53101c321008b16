//! Tips of a UR5e and a Panda under random twists, through singular postures and at the ends of
//! ranges.

use crate::common::{Rng, few_or_many};
use dynamics_core::Engine;
use dynamics_core::algorithms::frame::{LocalWorldAligned, Pose};
use dynamics_core::model::{OnBody, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::spatial::Motion;
use dynamics_core::state::ArmState;
use glam::{DVec3, Vec3};
use host_tests::measured::largest;
use host_tests::recordings::{columns, load, row};
use motion_control::limits::MotionLimits;
use motion_control::motion::{TipGoal, TipMotion, TipMotionConfig, TipStatus};

const TICK: f32 = 1e-3;
const ACCELERATION: f32 = 10.0;
/// The twists of a random motion.
const TWISTS: u32 = few_or_many(20, 10_000) as u32;
/// The bound of positions within which so few reach the ends of ranges, rad.
const NARROW: f32 = 0.5;

fn tip<T: Robot<N, N, N>, const N: usize, const TIP: usize>(
    q: &[f32; N],
) -> (Pose<f32>, [Motion<f32>; N]) {
    let trig = Engine::<T>::joint_trig(q);
    let [pose] = Engine::<T>::poses_of(&trig, OnBody::<TIP>);
    (pose, Engine::<T>::jacobian(&trig, OnBody::<TIP>, LocalWorldAligned))
}

/// The robot's own limits, the ranges no wider than ±`range`.
fn config<T: Robot<N, N, N>, const N: usize>(range: f32, gain: f32) -> TipMotionConfig<f32, N> {
    let limits: [_; N] = core::array::from_fn(|j| T::MODEL_F32.links[j].limits);
    let lower = limits.map(|l| l.lower.max(-range));
    let upper = limits.map(|l| l.upper.min(range));
    TipMotionConfig {
        tick: TICK,
        lower,
        upper,
        limits: limits.map(|l| MotionLimits { velocity: l.velocity, acceleration: ACCELERATION }),
        damping: 0.01,
        length: 0.3,
        posture: core::array::from_fn(|j| 0.5 * (lower[j] + upper[j])),
        posture_gain: gain,
    }
}

fn velocity<const N: usize>(jacobian: &[Motion<f32>; N], qd: &[f32; N]) -> Motion<f32> {
    let columns = jacobian.iter().zip(qd);
    columns.fold(Motion::ZERO, |sum, (column, qd)| sum + *column * *qd)
}

/// The findings about a motion.
#[derive(Debug, Default, PartialEq)]
struct Seen {
    /// Joints beyond a limit in a tick, or whose numbers are not those of a motion.
    beyond: u32,
    /// Ticks of joints that rest at an end of their range, and changes of the sign of an
    /// acceleration of at least a hundredth of the greatest one in them.
    at_end: u32,
    reversals: u32,
    /// The most changes of sign of a joint's acceleration in one twist, away from the ends too.
    chatter: u32,
}

impl Seen {
    /// Compares a tick with its limits.
    fn look<const N: usize>(
        &mut self,
        config: &TipMotionConfig<f32, N>,
        before: &ArmState<f32, N>,
        now: &ArmState<f32, N>,
        changes: &mut [u32; N],
    ) {
        for (j, changes) in changes.iter_mut().enumerate() {
            let (lower, upper, limits) = (config.lower[j], config.upper[j], config.limits[j]);
            let (q, qd, qdd) = (now.q[j], now.qd[j], now.qdd[j]);
            let way = 0.5 * TICK * (qd + before.qd[j]);
            let within = q >= lower && q <= upper && qd.abs() <= limits.velocity
                && qdd.abs() <= limits.acceleration
                // Two roundings of a speed.
                && (qd - before.qd[j] - qdd * TICK).abs() <= 1e-6
                && (q - before.q[j] - way).abs() <= 1e-6;
            self.beyond += u32::from(!within);
            let at_end = (q - lower).min(upper - q) < 1e-4;
            let reversal = qdd * before.qdd[j] < 0.0
                && qdd.abs().min(before.qdd[j].abs()) > 0.01 * limits.acceleration;
            self.at_end += u32::from(at_end);
            self.reversals += u32::from(at_end & reversal);
            *changes += u32::from(reversal);
        }
    }
}

/// Random [`TWISTS`] of up to 0.3 m/s and 0.9 rad/s for up to half a second each.
fn jog<T: Robot<N, N, N>, const N: usize, const TIP: usize>(range: f32, gain: f32) -> Seen {
    let config = config::<T, N>(range, gain);
    let mut motion = TipMotion::try_new(config, &config.posture).unwrap();
    let (mut rng, mut seen) = (Rng::new(3), Seen::default());
    for _ in 0..TWISTS {
        let mut random = |bound| Vec3::from_array(rng.vector(bound).map(|x: f64| x as f32));
        let twist = Motion::new(random(0.9), random(0.3));
        let mut changes = [0; N];
        for _ in 0..20 + rng.below(500) {
            let before = *motion.state();
            let (_, jacobian) = tip::<T, N, TIP>(&before.q);
            assert_ne!(motion.step(&jacobian, &twist), TipStatus::NotFinite);
            seen.look(&config, &before, motion.state(), &mut changes);
        }
        seen.chatter = changes.into_iter().fold(seen.chatter, u32::max);
    }
    seen
}

/// No limit is exceeded, and joints rest at the ends of their ranges, for `at_end` ticks a twist: less than a change of sign in
/// a second there, and no more than `chatter` within half a second anywhere.
#[track_caller]
fn expect(seen: &Seen, at_end: u32, chatter: u32) {
    assert_eq!(seen.beyond, 0, "{seen:?}");
    assert!(seen.at_end > at_end * TWISTS && seen.reversals * 1000 < seen.at_end, "{seen:?}");
    assert!(seen.chatter <= chatter, "{seen:?}");
}

#[test]
fn a_ur5e_follows_random_twists_within_its_limits() {
    expect(&jog::<Ur5e, 6, 5>(NARROW, 0.0), 50, 8);
    if !cfg!(debug_assertions) {
        expect(&jog::<Ur5e, 6, 5>(6.2, 0.0), 5, 8);
        expect(&jog::<Ur5e, 6, 5>(1.5, 0.0), 50, 8);
    }
}

#[test]
fn a_panda_follows_random_twists_within_its_limits() {
    expect(&jog::<Panda, 7, 6>(NARROW, 2.0), 20, 8);
    if !cfg!(debug_assertions) {
        expect(&jog::<Panda, 7, 6>(9.0, 0.0), 30, 8);
        expect(&jog::<Panda, 7, 6>(9.0, 2.0), 20, 8);
    }
}

#[test]
fn what_is_beyond_a_limit_is_seen() {
    let config = config::<Ur5e, 6>(1.0, 0.0);
    let at = |q: f32, qd: f32, qdd: f32| ArmState { q: [q; 6], qd: [qd; 6], qdd: [qdd; 6] };
    let look = |before, now| {
        let mut seen = Seen::default();
        seen.look(&config, &before, &now, &mut [0; 6]);
        seen
    };
    assert_eq!(look(at(0.0, 0.0, 0.0), at(0.0, 0.0, 0.0)), Seen::default());
    let way = 0.5 * TICK * 0.01;
    assert_eq!(look(at(0.0, 0.0, 0.0), at(way, 0.01, 10.0)).beyond, 0);
    assert_eq!(look(at(0.0, 0.0, 0.0), at(0.0, 0.02, 20.0)).beyond, 6);
    assert_eq!(look(at(0.0, 0.0, 0.0), at(1e-4, 0.0, 0.0)).beyond, 6);
    assert_eq!(look(at(0.0, 3.15, 0.0), at(0.003_15, 3.15, 0.0)).beyond, 6);
    assert_eq!(look(at(1.001, 0.0, 0.0), at(1.001, 0.0, 0.0)).beyond, 6);
    assert_eq!(look(at(f32::NAN, 0.0, 0.0), at(f32::NAN, 0.0, 0.0)).beyond, 6);
    let seen = look(at(1.0, 0.0, -1.0), at(1.0, 0.000_2, 0.2));
    assert_eq!((seen.at_end, seen.reversals), (6, 6));
}

/// The share of the twist that the tip has along it, and the greatest speed of a joint, over a
/// motion from a posture.
fn through(q: [f32; 6], twist: &Motion<f32>, ticks: u32) -> (f32, f32) {
    let config = config::<Ur5e, 6>(6.2, 0.0);
    let mut motion = TipMotion::try_new(config, &q).unwrap();
    let (mut fastest, mut share) = (0.0_f32, 0.0);
    let mut seen = Seen::default();
    for _ in 0..ticks {
        let before = *motion.state();
        let (_, jacobian) = tip::<Ur5e, 6, 5>(&before.q);
        motion.step(&jacobian, twist);
        seen.look(&config, &before, motion.state(), &mut [0; 6]);
        let qd = motion.state().qd;
        fastest = qd.iter().fold(fastest, |fastest, qd| fastest.max(qd.abs()));
        let v = velocity(&jacobian, &qd);
        share = v.lin.dot(twist.lin) / twist.lin.length_squared();
    }
    assert_eq!(seen.beyond, 0);
    (share, fastest)
}

/// The largest part of Jᵀ (v − J q̇) − λ² q̇ over the recorded states, with the Jacobian of Pinocchio
/// in which lengths are multiples of ℓ, and the speeds of a tick from rest.
fn off<T: Robot<N, N, N>, const N: usize, const TIP: usize>() -> f64 {
    let (recording, length) = (load(T::MODEL.name), 0.3);
    let scaled = |v: [f64; 6]| core::array::from_fn(|k| if k < 3 { v[k] } else { v[k] / length });
    let dot = |a: &[f64; 6], b: &[f64; 6]| (0..6).map(|k| a[k] * b[k]).sum::<f64>();
    let (ang, lin) = (DVec3::new(0.3, -0.2, 0.5), DVec3::new(0.1, -0.2, 0.15));
    let v = scaled([ang.x, ang.y, ang.z, lin.x, lin.y, lin.z]);
    largest((0..recording.first_states()).map(|i| {
        let q = row::<N>(&recording.q, i);
        let config = TipMotionConfig {
            tick: 1e-3,
            lower: [f64::NEG_INFINITY; N],
            upper: [f64::INFINITY; N],
            limits: [MotionLimits { velocity: f64::INFINITY, acceleration: 1e9 }; N],
            damping: 0.01,
            length,
            posture: q,
            posture_gain: 0.0,
        };
        let mut motion = TipMotion::try_new(config, &q).unwrap();
        let jacobian = Engine::<T>::jacobian(&q, OnBody::<TIP>, LocalWorldAligned);
        assert_eq!(motion.step(&jacobian, &Motion::new(ang, lin)), TipStatus::Follows);
        let qd = motion.state().qd;
        let j = columns::<N>(&recording.jacobian_mixed, i).map(scaled);
        let rest = core::array::from_fn(|k| v[k] - (0..N).map(|n| j[n][k] * qd[n]).sum::<f64>());
        let square = 0.01 * dot(&v, &v).sqrt() + 1e-3;
        largest((0..N).map(|n| (dot(&j[n], &rest) - square * qd[n]).abs()))
    }))
}

#[test]
fn the_speeds_of_a_tick_are_the_damped_least_squares_of_pinocchios_jacobian() {
    let off = [off::<Ur5e, 6, 5>(), off::<Panda, 7, 6>()];
    println!("{off:?}");
    assert!(off.iter().all(|&off| off < 1e-13), "{off:?}");
}

#[test]
fn a_ur5e_goes_through_its_singular_postures() {
    // The wrist: straight through the posture in which the axes of joints 4 and 6 are parallel.
    let wrist = [0.0, -1.2, 1.5, -1.9, -0.2, 0.0];
    for speed in [0.05, 0.25, 0.5] {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            let (share, _) = through(wrist, &Motion::new(Vec3::ZERO, axis * speed), 300);
            assert!(share > 0.5, "{axis} at {speed}: {share}");
        }
    }
    // The elbow: the arm comes to the end of its reach without a bounce, and the tip goes on as
    // its other joints can.
    let out = Motion::new(Vec3::ZERO, Vec3::NEG_X * 0.25);
    let (share, fastest) = through([0.0, -0.4, 0.8, -0.4, -1.57, 0.0], &out, 4000);
    assert!(share > 0.0 && share < 0.25 && fastest < 2.8, "{share} {fastest}");
    // The shoulder: the wrist's centre comes to the cylinder around the first axis that it cannot
    // enter, where a little aside decides which way the arm turns.
    let across = Motion::new(Vec3::ZERO, Vec3::X * 0.25);
    let (_, fastest) = through([0.0, -1.2, 2.2, -1.0, -1.57, 0.0], &across, 5000);
    assert!(0.5 < fastest && fastest < 3.15, "{fastest}");
}

#[test]
fn a_goal_is_reached_straight_on() {
    let start = [0.0, -1.2, 1.5, 0.3, 0.7, 0.0];
    let config = config::<Ur5e, 6>(6.2, 0.0);
    let mut motion = TipMotion::try_new(config, &start).unwrap();
    let (from, _) = tip::<Ur5e, 6, 5>(&start);
    let (pose, _) = tip::<Ur5e, 6, 5>(&[0.3, -1.0, 1.2, 0.5, 0.9, 0.3]);
    let goal = TipGoal { pose, gain: 4.0, linear: 0.25, angular: 1.0 };
    let (way, mut aside) = ((pose.pos - from.pos).normalize(), 0.0_f32);
    for _ in 0..6000 {
        let (pose, jacobian) = tip::<Ur5e, 6, 5>(&motion.state().q);
        assert_eq!(motion.step(&jacobian, &goal.twist(&pose)), TipStatus::Follows);
        aside = aside.max((pose.pos - from.pos).reject_from(way).length());
    }
    let (end, _) = tip::<Ur5e, 6, 5>(&motion.state().q);
    assert!((end.pos - pose.pos).length() < 2e-6, "{}", end.pos - pose.pos);
    assert!(goal.twist(&end).ang.length() < 2e-5, "{}", goal.twist(&end).ang);
    assert!(aside < 4e-3, "{aside}"); // m, of a way of 0.3 m
}

#[test]
fn a_redundant_arm_goes_on_along_the_twist_while_a_joint_is_at_its_end() {
    let mut config = config::<Panda, 7>(9.0, 0.0);
    let start = [0.0, -0.2, 0.4, -1.9, 0.3, 1.9, 0.7];
    config.upper[0] = start[0] + 0.02;
    let mut motion = TipMotion::try_new(config, &start).unwrap();
    let twist = Motion::new(Vec3::ZERO, Vec3::Y * 0.1);
    let (mut limited, mut wrong) = (0, 0.0_f32);
    for tick in 0..1500 {
        let (_, jacobian) = tip::<Panda, 7, 6>(&motion.state().q);
        let status = motion.step(&jacobian, &twist);
        limited += u32::from(status == TipStatus::Limited(0));
        if tick > 300 {
            let off = velocity(&jacobian, &motion.state().qd) - twist;
            wrong = wrong.max(off.lin.length()).max(0.3 * off.ang.length());
        }
    }
    assert!(limited > 500 && wrong < 0.01, "{limited} {wrong}");
}
