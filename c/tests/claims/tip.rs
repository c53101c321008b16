//! Inverse kinematics as C calls it.

use super::controller::ends;
use super::goal::limited;
use super::{close_for, numbers};
use crate::library::{self as c, *};
use crate::scene::{self, N};
use dynamics_c::field;
use dynamics_c::status::*;

pub fn solver(config: &Config) -> PoseSolver {
    PoseSolver {
        lower: config.lower,
        upper: config.upper,
        length: 0.3,
        tolerance: 1e-4,
        iterations: 500,
    }
}

fn pose(q: &[f32; N]) -> Pose {
    let mut pose = Pose::default();
    assert_eq!(c::body_pose(Some(q), scene::TOOL_BODY as i32, Some(&mut pose)), OK);
    pose
}

#[test]
fn a_tip_moves_to_a_pose_within_limits_and_brakes_without_one() {
    let (config, mut tip, mut at, mut why): (_, Tip, _, _) =
        (limited(), numbers(), Where::NOWHERE, Where::NOWHERE);
    let ([home, away], mut now): (_, State) = (ends(&config), numbers());
    let mut init = |tip: &mut Tip, config: &Config, start: &State| {
        let found =
            c::tip_init(Some(tip), Some(config), Some(start), 0.01, 0.3, 0.0, Some(&mut at));
        (found, at.field, at.joint)
    };
    let (start, last) = (State::at(home), N as i32 - 1);
    let mut wrong = (config, start);
    (wrong.0.speed[N - 1], wrong.1.qd[N - 1]) = (0.0, f32::NAN);
    assert_eq!(init(&mut tip, &wrong.0, &start), (CONFIG, field::RANGE, last));
    assert_eq!(init(&mut tip, &config, &wrong.1), (NOT_FINITE, field::VELOCITY, last));
    assert_eq!(init(&mut tip, &Config { tick: 0.0, ..config }, &start), (CONFIG, field::TIP, -1));
    let mut goal = pose(&away);
    let go = |tip: &mut Tip, goal: &Pose, now: &mut State| {
        c::tip_goal(Some(tip), Some(goal), 4.0, 1.0, 0.25, Some(now), None)
    };
    assert_eq!(go(&mut tip, &goal, &mut now), MEMORY);
    assert_eq!(init(&mut tip, &config, &start), (OK, field::NONE, -1));
    for _ in 0..6000 {
        let before = now;
        assert_eq!(go(&mut tip, &goal, &mut now), OK);
        for joint in 0..N {
            let (q, qd) = (now.q[joint], now.qd[joint]);
            assert!(
                q >= config.lower[joint] && q <= config.upper[joint] && qd.abs() <= 2.0,
                "{now:?}"
            );
            assert!((qd - before.qd[joint]).abs() <= 0.0201, "{now:?}");
        }
    }
    let found = pose(&now.q);
    close_for(500.0, found.rotation.as_flattened(), goal.rotation.as_flattened());
    close_for(500.0, &found.position, &goal.position);
    // A rotation and a twist that are none: the joints brake.
    let mut step = |tip: &mut Tip, twist, now: &mut State| {
        (c::tip_step(Some(tip), Some(&[twist; 6]), Some(now), Some(&mut why)), why.field)
    };
    assert_eq!(step(&mut tip, 1e3, &mut now).0, OK);
    assert!([field::SPEED, field::RANGE].contains(&step(&mut tip, 1e3, &mut now).1));
    goal.rotation[0] = [0.0; 3];
    for _ in 0..200 {
        assert_eq!(step(&mut tip, f32::NAN, &mut now), (NOT_FINITE, field::NONE));
        assert_eq!(go(&mut tip, &goal, &mut now), ROTATION);
    }
    assert_eq!(now.qd, [0.0; N]);
}

#[test]
fn positions_of_a_pose_are_those_of_its_kinematics() {
    let config = limited();
    let [home, away] = ends(&config);
    let (solver, mut goal, mut q) = (solver(&config), pose(&away), home);
    assert_eq!(c::solve_pose(Some(&solver), Some(&goal), Some(&mut q)), OK);
    let reached = pose(&q);
    close_for(50.0, reached.rotation.as_flattened(), goal.rotation.as_flattened());
    close_for(50.0, &reached.position, &goal.position);
    goal.position[0] += 100.0;
    assert_eq!(c::solve_pose(Some(&solver), Some(&goal), Some(&mut q)), NOT_REACHED);
    assert!(q != away && pose(&q).position[0] >= reached.position[0] - 1e-3, "{q:?}");
    let before = q;
    goal.position[0] = f32::NAN;
    assert_eq!(c::solve_pose(Some(&solver), Some(&goal), Some(&mut q)), NOT_FINITE);
    goal = Pose::default();
    assert_eq!(c::solve_pose(Some(&solver), Some(&goal), Some(&mut q)), ROTATION);
    assert_eq!(q, before);
}
