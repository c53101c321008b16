//! An arm that presses on a wall while it moves along it, under motion and force control.

use crate::common::{Verdict, Worst};
use dynamics_core::algorithms::{
    Damping, bias_acceleration, frame, kinematics, operational_space, rnea,
};
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY, hook};
use dynamics_core::model::Robot;
use dynamics_core::robots::Panda;
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::{JointTrig, State};
use glam::{DMat3, DVec3};
use host_tests::measured::largest;
use motion_control::law::{
    TaskCommand, TaskForce, TaskFrame, TaskMotion, hybrid_motion_force, orientation_error,
};

const HAND: usize = 6;
const TICK: f64 = 1e-3;
const PARTS: usize = 10; // the plant's steps in a tick
const STIFFNESS: f64 = 2e4; // N/m
const WALL_DAMPING: f64 = 20.0; // N s/m
const PRESS: f64 = 30.0; // N
const RADIUS: f64 = 0.02; // m, of the loop

/// The wall: the plane through `origin`; `normal` points into it.
#[derive(Clone, Copy)]
struct Wall {
    origin: DVec3,
    normal: DVec3,
}

impl Wall {
    /// The force of the hand on it along its normal, N.
    fn pressed(&self, place: DVec3, velocity: DVec3) -> f64 {
        let depth = (place - self.origin).dot(self.normal);
        let force = STIFFNESS * depth + WALL_DAMPING * velocity.dot(self.normal);
        if depth > 0.0 { force.max(0.0) } else { 0.0 }
    }
}

impl<const B: usize, const V: usize> Effect<f64, B, V> for Wall {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f64> =
        hook::Wrench::of_state(|wall, body, at, fx| {
            if body == HAND {
                let velocity = at.pose.rot.transpose() * at.velocity.lin;
                let back = -wall.pressed(at.pose.pos, velocity);
                fx.lin += at.pose.rot * (wall.normal * back);
            }
        });
}

/// The largest errors in the last second.
#[derive(Debug, Default)]
struct Errors {
    force: f64,
    path: f64,
    turn: f64,
    swing: f64,
}

/// Three seconds along a loop on the wall; `posture` is a torque on all joints, applied in the null
/// space.
fn run(posture: f64) -> Errors {
    let robot = &Panda::MODEL;
    let mut arm = State::at([0.3, -0.4, 0.2, -2.0, 0.3, 1.9, 0.5]);
    let start = kinematics(robot, &arm, &()).poses[HAND];
    let axes = DMat3::from_rotation_z(0.5) * DMat3::from_rotation_y(0.3); // normal: x
    let wall = Wall { origin: start.pos + axes.x_axis * 0.005, normal: axes.x_axis };
    let frame = TaskFrame { axes };
    let directions = frame.turn_and_place(1.0);
    let mut errors = Errors::default();
    for tick in 0..3000 {
        // A loop along y and z of the wall, from rest.
        let (w, t) = (core::f64::consts::PI, f64::from(tick) * TICK);
        let swing = |w: f64| {
            let (s, c) = (w * t).sin_cos();
            [1.0 - c, w * s, w * w * c].map(|x| RADIUS * x)
        };
        let [y, z] = [swing(w), swing(2.0 * w)];
        let [place, rate, feed] = [0, 1, 2].map(|k| DVec3::new(0.0, y[k], z[k]));

        let at = JointTrig::new(robot, &arm.q);
        let k = kinematics(robot, at.with(&arm), &());
        let (pose, v) = (k.poses[HAND], k.velocity(HAND, frame::LocalWorldAligned));
        let reached = axes.transpose() * (pose.pos - start.pos);
        let [speed, spin] = [axes.transpose() * v.lin, axes.transpose() * v.ang];
        let off = axes.transpose() * orientation_error::<f64>(&pose.rot, &start.rot);
        let pressed = wall.pressed(pose.pos, v.lin);

        let task = operational_space(
            robot,
            &at,
            (HAND, frame::LocalWorldAligned),
            &directions,
            &RIGID_BODY,
            Damping::relative(1e-4),
        )
        .unwrap();
        let motion = |error, error_rate, acceleration| {
            TaskCommand::motion(TaskMotion {
                error,
                error_rate,
                acceleration,
                omega_n: 40.0,
                zeta: 1.0,
            })
        };
        let still = |k: usize| motion(off[k], -spin[k], 0.0);
        let along = |k: usize| motion(place[k] - reached[k], rate[k] - speed[k], feed[k]);
        let push = TaskCommand::force(TaskForce {
            desired: PRESS,
            measured: pressed,
            gain: 1.0,
            velocity: speed.x,
            damping: 150.0,
        });
        let aims = [still(0), still(1), still(2), push, along(1), along(2)];
        let drift = bias_acceleration(robot, at.with(&arm), HAND, frame::LocalWorldAligned);
        let bias = rnea(robot, at.with(&arm), &(Gravity::EARTH, Coriolis));
        let mut tau = hybrid_motion_force(&task, &aims, &directions.map(|d| drift.dot(d)), &bias);
        let free = arm.qd.map(|qd| posture - 2.0 * qd);
        for (tau, free) in tau.iter_mut().zip(task.null_space_torque(&free)) {
            *tau += free;
        }

        if t > 2.0 {
            errors.force = largest([errors.force, (pressed - PRESS).abs()]);
            errors.path = largest([errors.path, (reached - place).y.hypot((reached - place).z)]);
            errors.turn = largest([errors.turn, off.length()]);
            let free = task.null_space_torque(&arm.qd);
            errors.swing = largest(free.map(f64::abs).into_iter().chain([errors.swing]));
        }
        let scene = (Gravity::EARTH, Inertia, Coriolis, wall);
        for _ in 0..PARTS {
            semi_implicit(robot, &mut arm, &tau, &scene, TICK / PARTS as f64).unwrap();
        }
    }
    errors
}

fn within_the_table(errors: &Errors, verdict: &mut Verdict) {
    let of = |error, full_scale| Worst { error, full_scale };
    verdict.see("arm on a wall", "force", "f64", &of(errors.force, PRESS));
    verdict.see("arm on a wall", "path", "f64", &of(errors.path, RADIUS));
    verdict.see("arm on a wall", "turn", "f64", &of(errors.turn, 1.0));
}

#[test]
fn the_elbow_does_not_disturb_pressing_along_a_wall() {
    let (calm, driven) = (run(0.0), run(5.0));
    assert!(driven.swing > 5.0 * calm.swing, "the elbow is driven: {calm:?} {driven:?}");
    let mut verdict = Verdict::default();
    within_the_table(&calm, &mut verdict);
    within_the_table(&driven, &mut verdict);
    verdict.speak();
}
