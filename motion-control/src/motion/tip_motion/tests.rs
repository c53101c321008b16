//! One and two joints: refusals, ends of ranges, starts beyond limits, wild numbers.

use super::*;
use crate::law::pose_error;
use crate::tests::refused;
use core::f64::consts::PI;
use dynamics_core::glam::{DMat3, DVec3, Vec3};

/// Two joints that turn about z and move along x.
fn columns<R: Real>() -> [Motion<R>; 2] {
    let axis = |x: f64, z: f64| R::Vec3::new(R::from_f64(x), R::ZERO, R::from_f64(z));
    [Motion::new(axis(0.0, 1.0), axis(0.0, 0.0)), Motion::new(axis(0.0, 0.0), axis(0.3, 0.0))]
}

fn twist(turn: f32, along: f32) -> Motion<f32> {
    Motion::new(Vec3::Z * turn, Vec3::X * along)
}

const CONFIG: TipMotionConfig<f32, 2> = TipMotionConfig {
    tick: 1e-3,
    lower: [-1.0, -1.0],
    upper: [1.0, 1.0],
    limits: [MotionLimits { velocity: 2.0, acceleration: 10.0 }; 2],
    damping: 0.01,
    length: 0.3,
    posture: [0.0; 2],
    posture_gain: 0.0,
};

fn at(config: TipMotionConfig<f32, 2>, q: [f32; 2], qd: [f32; 2]) -> TipMotion<f32, 2> {
    let mut tip = TipMotion::try_new(config, &[0.0; 2]).unwrap();
    assert!(tip.restart(&State { q, qd, qdd: [0.0; 2] }));
    tip
}

#[test]
fn what_is_no_limit_is_refused() {
    let refuse = |change: fn(&mut TipMotionConfig<f32, 2>)| {
        let mut config = CONFIG;
        change(&mut config);
        refused(TipMotion::try_new(config, &[0.0; 2])).unwrap()
    };
    let tip = ConfigParameter::TipMotion;
    assert_eq!(refuse(|c| c.tick = 0.0), tip);
    assert_eq!(refuse(|c| c.damping = f32::NAN), tip);
    assert_eq!(refuse(|c| c.length = -0.3), tip);
    assert_eq!(refuse(|c| c.posture[1] = f32::INFINITY), tip);
    assert_eq!(refuse(|c| c.posture_gain = -1.0), tip);
    let range = |joint| ConfigParameter::JointRange { joint };
    assert_eq!(refuse(|c| c.lower[1] = 1.1), range(1));
    assert_eq!(refuse(|c| c.upper[0] = f32::NAN), range(0));
    assert_eq!(refuse(|c| c.limits[1].velocity = 0.0), range(1));
    assert_eq!(refuse(|c| c.limits[0].acceleration = f32::INFINITY), range(0));
    assert_eq!(refused(TipMotion::try_new(CONFIG, &[f32::NAN, 0.0])), Some(range(0)));
    assert!(!at(CONFIG, [0.5; 2], [0.0; 2]).restart(&State::at([0.0, f32::NAN])));
}

#[test]
fn a_joint_rests_at_its_end_and_the_other_goes_on() {
    for bound in [1e-4_f32, 1.0, 300.0] {
        let config = TipMotionConfig { upper: [bound, 1e6], ..CONFIG };
        let mut tip = at(config, [bound - 0.2, 0.0], [0.0; 2]);
        let (mut signs, mut last) = (0, 0.0);
        for _ in 0..3000 {
            tip.step(&columns(), &twist(1.0, 0.05));
            let State { q, qdd, .. } = *tip.state();
            assert!(q[0] <= bound);
            signs += u32::from(qdd[0] * last < 0.0);
            last = if qdd[0] == 0.0 { last } else { qdd[0] };
        }
        let State { q, qd, qdd } = *tip.state();
        assert!(bound - q[0] <= 16.0 * f32::EPSILON * bound.max(1e-3), "{bound}: {}", bound - q[0]);
        assert_eq!((qd[0], qdd[0]), (0.0, 0.0));
        assert!((qd[1] - 0.166).abs() < 2e-3, "{qd:?}");
        // It speeds up and brakes: one change.
        assert_eq!(signs, 1, "{bound}");
        assert_eq!(tip.step(&columns(), &twist(1.0, 0.0)), TipStatus::Limited(0));
        tip.step(&columns(), &twist(-0.1, 0.0));
        assert_eq!(tip.step(&columns(), &twist(-0.1, 0.0)), TipStatus::Follows);
        assert!(tip.state().qd[0] < 0.0);
    }
}

#[test]
fn a_start_beyond_a_limit_comes_back_at_the_greatest_acceleration() {
    // Outwards beyond the end: it stops there, and moves inwards only.
    let mut tip = at(CONFIG, [1.5, 0.0], [0.5, 5.0]);
    for k in 1..=50 {
        tip.step(&columns(), &twist(1.0, 0.0));
        assert!((tip.state().qd[0] - (0.5 - 0.01 * k as f32)).abs() < 1e-5);
        assert!((tip.state().qd[1] - (5.0 - 0.01 * k as f32)).abs() < 1e-4);
    }
    let stopped = tip.state().q[0];
    tip.step(&columns(), &twist(1.0, 0.0));
    assert_eq!(tip.state().q[0], stopped);
    for _ in 0..600 {
        tip.step(&columns(), &twist(-0.5, 0.0));
    }
    assert!(tip.state().qd[0] < -0.49, "{:?}", tip.state());
    // Too fast towards the end: it passes it, and no acceleration is exceeded.
    let mut tip = at(CONFIG, [0.95, 0.0], [1.9, 0.0]);
    for _ in 0..400 {
        tip.step(&columns(), &twist(1.0, 0.0));
        assert!(tip.state().qdd[0].abs() <= 10.0);
    }
    assert_eq!(tip.state().qd[0], 0.0);
}

#[test]
fn a_range_of_no_width_holds_the_joint_and_infinite_limits_are_none() {
    let free = MotionLimits { velocity: f32::INFINITY, acceleration: 10.0 };
    let [lower, upper] = [f32::NEG_INFINITY, f32::INFINITY];
    let config =
        TipMotionConfig { lower: [0.25, lower], upper: [0.25, upper], limits: [free; 2], ..CONFIG };
    let mut tip = at(config, [0.25, 0.0], [0.0; 2]);
    for _ in 0..2000 {
        tip.step(&columns(), &twist(3.0, 1.0));
    }
    assert_eq!((tip.state().q[0], tip.state().qd[0]), (0.25, 0.0));
    assert!(tip.state().qd[1] > 2.5, "{:?}", tip.state());
}

#[test]
fn a_joint_at_its_greatest_speed_slows_the_arm_along_the_twist() {
    let mut tip = at(CONFIG, [-1.0, -1.0], [0.0; 2]);
    let mut status = TipStatus::Follows;
    for _ in 0..300 {
        status = tip.step(&columns(), &twist(4.0, 0.3));
        let [turn, along] = tip.state().qd;
        assert!((turn - 4.0 * along).abs() < 2e-3 * turn.max(0.1), "{turn} {along}");
    }
    assert_eq!(status, TipStatus::Slowed(0));
    assert!((tip.state().qd[0] - 2.0).abs() < 1e-5);
}

#[test]
fn a_posture_is_reached_by_joints_that_the_tip_does_not_need() {
    let config = TipMotionConfig { posture: [0.6, 0.5], posture_gain: 2.0, ..CONFIG };
    let mut tip = at(config, [0.0; 2], [0.0; 2]);
    // The second joint does not move this tip.
    let columns = [columns()[0], Motion::ZERO];
    for _ in 0..6000 {
        tip.step(&columns, &twist(0.0, 0.0));
        // A posture takes a quarter of the speed of a joint.
        assert!(tip.state().qd[1] < 0.501, "{:?}", tip.state());
    }
    let [tip_joint, free] = tip.state().q;
    assert!(tip_joint.abs() < 0.01 && (free - 0.5).abs() < 1e-4, "{tip_joint} {free}");
}

#[test]
fn wild_numbers_never_come_out() {
    let mut seed = 1_u32;
    let mut number = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f32::from_bits(seed.rotate_left(seed >> 27))
    };
    let free = MotionLimits { velocity: f32::INFINITY, acceleration: 10.0 };
    let mut tip =
        at(TipMotionConfig { limits: [CONFIG.limits[0], free], ..CONFIG }, [0.0; 2], [0.0; 2]);
    let mut refused = 0;
    for k in 0..200_000 {
        let mut vector = || Vec3::new(number(), number(), number());
        let mut jacobian = columns();
        let mut wanted = Motion::new(vector(), vector());
        if k % 3 == 0 {
            jacobian[k % 2] = Motion::new(vector(), vector());
            wanted = if k % 2 == 0 { twist(1.0, 0.3) } else { wanted };
        }
        let status = tip.step(&jacobian, &wanted);
        refused += u32::from(status == TipStatus::NotFinite);
        let State { q, qd, qdd } = *tip.state();
        assert!(tip.state().is_finite() && q.iter().all(|q| q.abs() <= 1.0), "{q:?}");
        assert!(qd[0].abs() <= 2.0 && qdd.iter().all(|qdd| qdd.abs() <= 10.0), "{qd:?} {qdd:?}");
    }
    assert!(10_000 < refused && refused < 190_000, "{refused}");
    // At rest within a tick of braking, after what is not finite.
    let mut tip = at(CONFIG, [0.0; 2], [0.02, 0.0]);
    for _ in 0..2 {
        let nan = twist(f32::NAN, 0.0);
        assert_eq!(tip.step(&columns(), &nan), TipStatus::NotFinite);
    }
    assert_eq!(tip.state().qd, [0.0; 2]);
}

#[test]
fn a_goal_beyond_its_speeds_is_approached_along_the_straight_way() {
    let pose = Pose { pos: DVec3::new(3.0, 4.0, 0.0), ..Pose::<f64>::IDENTITY };
    let goal = TipGoal { pose, gain: 2.0, linear: 0.5, angular: 1.0 };
    let twist = goal.twist(&Pose::IDENTITY);
    assert!((twist.lin - DVec3::new(0.3, 0.4, 0.0)).length() < 1e-15 && twist.ang == DVec3::ZERO);
    assert_eq!(goal.twist(&pose), Motion::ZERO);
    // Turns up to half a turn, as the error of the attitude says.
    let free = TipGoal { gain: 1.0, linear: 9.0, angular: 9.0, ..goal };
    let axis = DVec3::new(2.0, -3.0, 6.0) / 7.0;
    for (angle, most) in [(0.3, 1e-14), (2.0, 1e-14), (3.13, 1e-11), (3.138, 1e-2), (PI, 1e-6)] {
        let from = Pose { rot: DMat3::from_axis_angle(axis, -angle), ..pose };
        let off = free.twist(&from).ang - pose_error(&from, &pose).ang;
        assert!(off.length() < most, "{angle}: {off}");
    }
    assert!(TipMotion::try_new(CONFIG, &[0.0; 2]).unwrap().ticks() == 0);
}
