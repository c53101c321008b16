//! Poses solved on a Panda within its iterations, and on a UR5e against the closed form.

use core::f64::consts::{PI, TAU};

use crate::common::Rng;
use dynamics_core::Engine;
use dynamics_core::algorithms::frame::{LocalWorldAligned, Pose};
use dynamics_core::model::{OnBody, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Motion;
use glam::{DMat3, DVec3};
use host_tests::recordings;
use motion_control::motion::{PoseSolver, PoseSolverError};

/// The iterations that 2 ms at 170 MHz, 340,000 modelled cycles, suffice for: docs/costs.md.
const ITERATIONS: u32 = 130;

fn tip<T: Robot<N, N, N>, R: Real, const N: usize, const TIP: usize>(
    q: &[R; N],
) -> (Pose<R>, [Motion<R>; N]) {
    let trig = Engine::<T>::joint_trig(q);
    let [pose] = Engine::<T>::poses_of(&trig, OnBody::<TIP>);
    (pose, Engine::<T>::jacobian(&trig, OnBody::<TIP>, LocalWorldAligned))
}

fn solver<T: Robot<N, N, N>, R: Real, const N: usize>(
    tolerance: f64,
    iterations: u32,
) -> PoseSolver<R, N> {
    let limits: [_; N] = core::array::from_fn(|j| T::MODEL.links[j].limits);
    let of = R::from_f64;
    let (lower, upper) = (limits.map(|l| of(l.lower)), limits.map(|l| of(l.upper)));
    PoseSolver { lower, upper, length: of(0.3), tolerance: of(tolerance), iterations }
}

#[test]
fn random_poses_of_a_panda_are_solved_in_two_milliseconds() {
    let (solver, mut rng) = (solver::<Panda, f32, 7>(1e-5, ITERATIONS), Rng::new(1));
    let (start, mut solved) = (solver.seed(0), 0);
    for _ in 0..10_000 {
        let q = core::array::from_fn(|j| {
            solver.lower[j] + (solver.upper[j] - solver.lower[j]) * (0.5 + rng.within(0.5)) as f32
        });
        let (goal, _) = tip::<Panda, f32, 7, 6>(&q);
        let Ok(found) = solver.solve(&goal, &start, tip::<Panda, _, 7, 6>) else {
            continue;
        };
        solved += 1;
        let (pose, _) = tip::<Panda, f32, 7, 6>(&found.q);
        let apart = (pose.rot - goal.rot).to_cols_array();
        assert!((pose.pos - goal.pos).length() < 4e-6, "{found:?}");
        assert!(apart.iter().all(|x| x.abs() < 2e-5), "{found:?}");
        for (j, q) in found.q.into_iter().enumerate() {
            assert!(solver.lower[j] <= q && q <= solver.upper[j], "{found:?}");
        }
    }
    assert!(solved >= 9_950, "{solved}");
}

/// The solutions of a UR5e, angles within ±π: Hawkins, "Analytic inverse kinematics for the
/// Universal Robots UR-5/UR-10 arms" (2013), by its Denavit-Hartenberg parameters alone.
fn closed_form(pose: &Pose<f64>) -> Vec<[f64; 6]> {
    let (d1, a2, a3, d4, d5, d6) = (0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996);
    let (p, z) = (pose.pos, pose.rot.z_axis);
    let wrist = p - d6 * z;
    let mut all = Vec::new();
    for [side, flip, elbow] in core::array::from_fn::<_, 8, _>(|k| [k & 1, k & 2, k & 4]) {
        let sign = |bit| if bit == 0 { 1.0 } else { -1.0 };
        let reach = wrist.x.hypot(wrist.y);
        let q1 = wrist.y.atan2(wrist.x) + sign(side) * (d4 / reach).acos() + PI / 2.0;
        let q5 = sign(flip) * ((p.x * q1.sin() - p.y * q1.cos() - d4) / d6).acos();
        let shoulder = DMat3::from_rotation_z(q1) * DMat3::from_rotation_x(PI / 2.0);
        let in_arm = shoulder.transpose() * pose.rot;
        let (x, y) = (in_arm.x_axis.z, in_arm.y_axis.z);
        let q6 = (-y / q5.sin()).atan2(x / q5.sin());
        let [quarter, back] = [PI / 2.0, -PI / 2.0].map(DMat3::from_rotation_x);
        let hand = quarter * DMat3::from_rotation_z(q5) * back * DMat3::from_rotation_z(q6);
        let plane = in_arm * hand.transpose();
        let sum = plane.x_axis.y.atan2(plane.x_axis.x);
        let w = shoulder.transpose() * (p - d1 * DVec3::Z) + plane * (d5 * DVec3::Y)
            - d6 * in_arm.z_axis;
        let cos = (w.x * w.x + w.y * w.y - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
        let q3 = sign(elbow) * cos.acos();
        let q2 = w.y.atan2(w.x) - (a3 * q3.sin()).atan2(a2 + a3 * q3.cos());
        let q = [q1, q2, q3, sum - q2 - q3, q5, q6].map(|q| (q + PI).rem_euclid(TAU) - PI);
        if q.iter().all(|q| q.is_finite()) {
            all.push(q);
        }
    }
    all
}

/// The greatest difference of two positions of joints, whole turns aside.
fn apart(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let turned = a.iter().zip(b).map(|(a, b)| ((a - b + PI).rem_euclid(TAU) - PI).abs());
    turned.fold(0.0, f64::max)
}

/// Which of the solutions the solver finds from this many starts; every one that it finds is one
/// of them.
fn found(goal: &Pose<f64>, all: &[[f64; 6]], starts: u32) -> Vec<bool> {
    let solver = solver::<Ur5e, f64, 6>(1e-10, 20);
    let mut seen = vec![false; all.len()];
    for n in 0..starts {
        if let Ok(found) = solver.solve(goal, &solver.seed(n), tip::<Ur5e, _, 6, 5>) {
            let which = all.iter().position(|q| apart(q, &found.q) < 1e-6);
            seen[which.expect("a solution that the closed form does not have")] = true;
        }
    }
    seen
}

#[test]
fn all_eight_solutions_of_a_ur5e_are_found() {
    let (mut rng, mut poses) = (Rng::new(2), 0);
    while poses < 40 {
        let q = core::array::from_fn(|_| rng.within(PI));
        let (goal, _) = tip::<Ur5e, f64, 6, 5>(&q);
        let all = closed_form(&goal);
        // Two that meet are one to the solver: a singular pose.
        let near = (1..all.len()).any(|i| all[..i].iter().any(|a| apart(a, &all[i]) < 0.1));
        if all.len() < 8 || near {
            continue;
        }
        poses += 1;
        let seen = found(&goal, &all, 400);
        assert!(seen.iter().all(|seen| *seen), "{q:?}: {seen:?}");
        // So few starts do not reach all: the test can fail.
        assert!(found(&goal, &all, 4).contains(&false));
    }
}

#[test]
fn poses_of_pinocchio_have_the_recorded_positions_among_their_solutions() {
    let recorded = recordings::load("ur5e");
    // The first state is singular.
    for i in 1..recorded.tip_pose.len() {
        let q: [f64; 6] = recordings::row(&recorded.q, i);
        let pose: [f64; 12] = recordings::row(&recorded.tip_pose, i);
        let rot = DMat3::from_cols_slice(&pose[..9]).transpose(); // recorded by rows
        let goal = Pose { rot, pos: DVec3::from_slice(&pose[9..]) };
        let all = closed_form(&goal);
        let which = all.iter().position(|closed| apart(closed, &q) < 1e-9).expect("closed form");
        assert!(found(&goal, &all, 400)[which], "{i}");
    }
}

#[test]
fn a_pose_out_of_reach_has_the_nearest_positions() {
    let solver = solver::<Panda, f32, 7>(1e-5, 100);
    let goal = Pose { pos: glam::Vec3::X * 3.0, ..Pose::IDENTITY };
    let start = solver.seed(0);
    let Err(PoseSolverError::NotReached(nearest)) =
        solver.solve(&goal, &start, tip::<Panda, _, 7, 6>)
    else {
        panic!("reached");
    };
    assert_eq!(nearest.iterations, 100);
    // The tip reaches 0.855 m from the shoulder.
    let left = nearest.error.lin.length();
    assert!(2.1 < left && left < 2.4, "{left}");
}
