//! Operational space: two ways to Λ⁻¹, what Λ and its inverse are for, no jump at singular poses, and control of
//! motion and force with them.

mod common;

use common::*;
use dynamics_core::algorithms::{
    Conditioning, Damping, OperationalSpace, damped_inverse, frame, mobility, operational_space,
};
use dynamics_core::control::TaskFrame;
use dynamics_core::effects::{Inertia, Payload, RIGID_BODY, RotorInertia};
use dynamics_core::model::{Arm, BASE, Body, Joint, Model, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Force;
use glam::DMat3;

const DAMPING: f64 = 1e-3;

fn unit<R: Real>() -> [Force<R>; 6] {
    use dynamics_core::scalar::Vector;
    core::array::from_fn(|k| {
        let at = |i| if i == k { R::ONE } else { R::ZERO };
        Force::new(
            R::Vec3::new(at(0), at(1), at(2)),
            R::Vec3::new(at(3), at(4), at(5)),
        )
    })
}

fn both_ways<F: frame::Frame>(frame: F, worst: &mut Worst) {
    let mut rng = Rng::new(7);
    let load = Payload::new(1.5, [0.1, -0.2, 0.05], [0.01, 0.0, 0.0, 0.02, 0.0, 0.015]);
    let scene = (Inertia, RotorInertia([0.3; V]), load);
    for _ in 0..50 {
        let tree = random_tree(&mut rng, false);
        let q = random_state(&tree, &mut rng).q;
        for body in 0..B {
            let damping = Damping::relative(DAMPING);
            let task =
                operational_space(&tree, &q, (body, frame), &unit(), &scene, damping).unwrap();
            let recursion = mobility(&tree, &q, body, frame, &scene)
                .unwrap()
                .along(&unit());
            for (got, want) in recursion.into_iter().zip(task.mobility) {
                worst.see(got, want);
            }
        }
    }
}

#[test]
fn mobility_by_recursion_is_that_by_factors_in_every_frame() {
    let mut worst = Worst::default();
    both_ways(frame::Body, &mut worst);
    both_ways(frame::World, &mut worst);
    both_ways(frame::Mixed, &mut worst);
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "mobility both ways", "f64", &worst);
    verdict.speak();
    let tree = random_tree(&mut Rng::new(1), false);
    let nobody = mobility(&tree, &[0.1; Q], B, frame::Body, &RIGID_BODY).unwrap();
    assert_eq!(nobody.along(&unit()), [[0.0; 6]; 6]);
}

#[test]
fn a_joint_that_moves_no_inertia_is_named() {
    let empty: Arm<f64, 2> = Model::new(
        "empty hand",
        [
            Body::new("arm", BASE, Joint::revolute([0.0, 1.0, 0.0]))
                .mass(1.0)
                .com([0.3, 0.0, 0.0]),
            Body::new("hand", 0, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.6, 0.0, 0.0]),
        ],
    );
    let error = mobility(&empty, &[0.1, 0.2], 1, frame::Body, &RIGID_BODY).unwrap_err();
    assert_eq!(error.joint, 1);
    let damping = Damping::relative(DAMPING);
    let task = operational_space(
        &empty,
        &[0.1, 0.2],
        (1, frame::Body),
        &unit(),
        &RIGID_BODY,
        damping,
    );
    assert_eq!(task.unwrap_err().joint, 1);
}

/// Tasks at random poses that are not near a singular one.
fn regular_tasks<T: Robot<N, N, N>, const N: usize, const M: usize>(
    directions: &[Force<f64>; M],
) -> Vec<OperationalSpace<f64, M, N>> {
    let mut rng = Rng::new(11);
    let poses = (0..200).map(|_| rng.vector(3.0)).collect::<Vec<[f64; N]>>();
    let damping = Damping::relative(DAMPING);
    let task = |q| {
        operational_space(
            &T::MODEL,
            q,
            (N - 1, frame::Mixed),
            directions,
            &RIGID_BODY,
            damping,
        )
    };
    let tasks = poses.iter().map(|q| task(q).unwrap());
    tasks
        .filter(|task| task.conditioning == Conditioning::Regular)
        .collect()
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn inverses<T: Robot<N, N, N>, const N: usize, const M: usize>(
    directions: &[Force<f64>; M],
    worst: &mut [Worst; 3],
) {
    let tasks = regular_tasks::<T, N, M>(directions);
    assert!(tasks.len() > 50, "{}", tasks.len());
    let mut rng = Rng::new(13);
    for task in tasks {
        let inverse = task.consistent_inverse();
        for i in 0..M {
            let one: [f64; M] = core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
            worst[0].see(task.inertia.map(|row| dot(&row, &task.mobility[i])), one);
            worst[1].see(inverse.map(|column| dot(&column, &task.jacobian[i])), one);
        }
        // Torques that the task does not feel: no acceleration, nor any effect of the free part twice.
        let tau: [f64; N] = rng.vector(30.0);
        let felt = |tau: &[f64; N]| task.response.map(|response| dot(&response, tau));
        let all = felt(&tau)
            .into_iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let unseen = felt(&task.unseen(&tau)).map(|x| x / all);
        worst[2].full_scale = 1.0;
        worst[2].see(unseen, [0.0; M]);
    }
}

#[test]
fn inertia_and_consistent_inverse_are_inverses_and_free_torques_are_not_felt() {
    let mut worst = [(); 3].map(|()| Worst::default());
    inverses::<Ur5e, 6, 3>(&TaskFrame::BASE.place(), &mut worst);
    inverses::<Panda, 7, 3>(&TaskFrame::BASE.place(), &mut worst);
    inverses::<Panda, 7, 6>(&TaskFrame::BASE.turn_and_place(0.3), &mut worst);
    let mut verdict = Verdict::default();
    for (law, worst) in ["Λ of Λ⁻¹", "J of its inverse", "free torque"]
        .iter()
        .zip(&worst)
    {
        verdict.see("arms", law, "f64", worst);
    }
    verdict.speak();
}

/// A random rotation of M coordinates, by rows: products of plane rotations.
fn rotation<const M: usize>(rng: &mut Rng) -> [[f64; M]; M] {
    let mut rows: [[f64; M]; M] =
        core::array::from_fn(|i| core::array::from_fn(|j| f64::from(i == j)));
    for _ in 0..2 {
        for p in 0..M {
            for q in p + 1..M {
                let (s, c) = rng.within(3.0).sin_cos();
                for k in 0..M {
                    let (x, y) = (rows[p][k], rows[q][k]);
                    (rows[p][k], rows[q][k]) = (c * x - s * y, s * x + c * y);
                }
            }
        }
    }
    rows
}

fn spectral<const M: usize>(rows: &[[f64; M]; M], values: [f64; M]) -> [[f64; M]; M] {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| (0..M).map(|k| values[k] * rows[k][i] * rows[k][j]).sum())
    })
}

/// Matrices of known eigenvalues, from equal ones to 10⁻¹², some zero, against what the damping promises.
fn eigen<R: Real, const M: usize>(worst: &mut Worst) {
    let mut rng = Rng::new(17);
    for round in 0..300 {
        let rows = rotation::<M>(&mut rng);
        let spread = f64::from(round % 13);
        let scale = 10_f64.powf(rng.within(3.0));
        let values: [f64; M] = core::array::from_fn(|k| match round % 3 {
            0 if k == 0 => 0.0,
            _ => scale * 10_f64.powf(-spread * (0.5 + rng.within(0.5))),
        });
        let sum: f64 = values.iter().sum();
        let threshold = 1e-2 * sum;
        let weights = values.map(|value| {
            let short = (threshold - value).max(0.0);
            value / (value * value + short * short)
        });
        let a = spectral(&rows, values).map(|row| row.map(R::from_f64));
        let (got, how) = damped_inverse(&a, Damping::relative(R::from_f64(1e-2)));
        let want = spectral(&rows, weights);
        worst.full_scale = 1.0;
        for (got, want) in got.into_iter().zip(want) {
            let scaled = |x: f64| x * threshold;
            worst.see(got.map(|x| scaled(x.to_f64())), want.map(scaled));
        }
        let least = values.iter().fold(f64::INFINITY, |least, &x| least.min(x));
        assert_eq!(
            how == Conditioning::Regular,
            least >= threshold,
            "{how:?} {least} {threshold}"
        );
    }
}

#[test]
fn eigenvalues_are_damped_as_the_law_says_whatever_their_spread() {
    let mut verdict = Verdict::default();
    let mut worst = Worst::default();
    eigen::<f64, 6>(&mut worst);
    eigen::<f64, 3>(&mut worst);
    eigen::<f64, 2>(&mut worst);
    verdict.see("matrices", "damped inverse", "f64", &worst);
    let mut worst = Worst::default();
    eigen::<f32, 6>(&mut worst);
    eigen::<f32, 3>(&mut worst);
    verdict.see("matrices", "damped inverse", "f32", &worst);
    verdict.speak();
}

/// The largest first and second differences of Λ on a path from −1 to 1 in n steps, and whether it was damped
/// at the ends and in the middle.
fn sweep<const M: usize, const N: usize>(
    n: usize,
    task: &impl Fn(f64) -> OperationalSpace<f64, M, N>,
) -> ([f64; 2], [bool; 3]) {
    let tasks: Vec<_> = (0..=n)
        .map(|k| task(2.0 * k as f64 / n as f64 - 1.0))
        .collect();
    let mut most = [0.0_f64; 2];
    for three in tasks.windows(3) {
        for i in 0..M {
            for j in 0..M {
                let [a, b, c] = [0, 1, 2].map(|k| three[k].inertia[i][j]);
                assert!(c.is_finite());
                most = [
                    most[0].max((b - a).abs()),
                    most[1].max((a - 2.0 * b + c).abs()),
                ];
            }
        }
    }
    let damped = [0, n / 2, n].map(|k| tasks[k].conditioning != Conditioning::Regular);
    (most, damped)
}

/// Halving the step halves the differences of a function without jumps and quarters the second differences of one
/// whose slope has none; a jump would leave them at 1 and at ½.
fn is_smooth<const M: usize, const N: usize>(
    what: &str,
    task: impl Fn(f64) -> OperationalSpace<f64, M, N>,
) {
    let (coarse, damped) = sweep(4000, &task);
    let (fine, _) = sweep(8000, &task);
    let ratios = [fine[0] / coarse[0], fine[1] / coarse[1]];
    println!("{what}: {ratios:?}");
    assert_eq!(
        damped,
        [false, true, false],
        "{what}: regular, through the singularity, regular"
    );
    assert!(ratios[0] < 0.51 && ratios[1] < 0.27, "{what}: {ratios:?}");
}

/// Two links of 1 m and 0.7 m that turn about y.
const TWO: Arm<f64, 3> = Model::new(
    "two links",
    [
        Body::new("upper", BASE, Joint::revolute([0.0, 1.0, 0.0]))
            .mass(2.0)
            .com([0.5, 0.0, 0.0]),
        Body::new("lower", 0, Joint::revolute([0.0, 1.0, 0.0]))
            .xyz([1.0, 0.0, 0.0])
            .mass(1.0)
            .com([0.3, 0.0, 0.1]),
        Body::new("hand", 1, Joint::revolute([0.0, 1.0, 0.0]))
            .xyz([0.7, 0.0, 0.0])
            .mass(0.2)
            .com([0.1, 0.0, 0.0]),
    ],
);

#[test]
fn nothing_jumps_in_value_or_slope_on_the_way_through_a_singularity() {
    let damping = Damping::relative(DAMPING);
    // Of the UR5e: the elbow stretched; two axes of the wrist in one line.
    let elbow = |s: f64| [0.0, -1.2, 0.4 * s, 0.3, 0.7, 0.0];
    let wrist = |s: f64| [0.3, -1.2, 1.5, 0.3, 0.6 * s, 0.2];
    let all = TaskFrame::BASE.turn_and_place(0.3);
    let geared = (Inertia, RotorInertia([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]));
    let arm =
        |q| operational_space(&Ur5e::MODEL, &q, (5, frame::Mixed), &all, &geared, damping).unwrap();
    is_smooth("elbow", |s| arm(elbow(s)));
    is_smooth("wrist", |s| arm(wrist(s)));
    // Two stretched links; and a task of one direction, which has no other to compare with.
    let [x, _, z] = TaskFrame::BASE.place();
    let two = |s: f64| [0.3 * s, 0.4 * s, 0.0];
    let plane = |s| {
        operational_space(
            &TWO,
            &two(s),
            (2, frame::Mixed),
            &[x, z],
            &RIGID_BODY,
            damping,
        )
        .unwrap()
    };
    is_smooth("two links", plane);
    let heavy = Damping::relative(0.0).heaviest(500.0);
    let line =
        |s| operational_space(&TWO, &two(s), (2, frame::Mixed), &[x], &RIGID_BODY, heavy).unwrap();
    is_smooth("along two links", line);
}

#[test]
fn at_singular_poses_all_is_finite_and_said_so() {
    fn at<R: Real, T: Robot<N, N, N>, const N: usize>() {
        let damping = Damping::relative(R::from_f64(DAMPING));
        let q = [R::ZERO; N];
        let model = dynamics_core::model::model::<R, T, N, N, N>();
        let task = operational_space(
            model,
            &q,
            (N - 1, frame::Mixed),
            &unit(),
            &RIGID_BODY,
            damping,
        )
        .unwrap();
        assert!(
            matches!(task.conditioning, Conditioning::Damped { smallest } if smallest < R::from_f64(1e-2))
        );
        assert!(task.inertia.iter().flatten().all(|x| x.is_finite()));
        assert!(
            task.consistent_inverse()
                .iter()
                .flatten()
                .all(|x| x.is_finite())
        );
    }
    at::<f64, Ur5e, 6>();
    at::<f32, Ur5e, 6>();
    at::<f64, Panda, 7>();
    at::<f32, Panda, 7>();
    // A body that cannot move at all.
    let (inertia, how) = damped_inverse(&[[0.0_f32; 6]; 6], Damping::relative(1e-3));
    assert_eq!(
        (inertia, how),
        ([[0.0; 6]; 6], Conditioning::Damped { smallest: 0.0 })
    );
}

#[test]
fn a_task_frame_turns_the_inertia_with_it() {
    let q = [0.1, -1.2, 1.5, 0.3, 0.7, 0.0];
    let axes = DMat3::from_rotation_z(0.7) * DMat3::from_rotation_x(-0.4);
    let damping = Damping::relative(DAMPING);
    let of = |frame: TaskFrame<f64>| {
        let place = frame.place();
        let task = operational_space(
            &Ur5e::MODEL,
            &q,
            (5, frame::Mixed),
            &place,
            &RIGID_BODY,
            damping,
        );
        let [x, y, z] = task.unwrap().inertia;
        DMat3::from_cols(x.into(), y.into(), z.into())
    };
    let (base, turned) = (of(TaskFrame::BASE), of(TaskFrame { axes }));
    let apart = turned - axes.transpose() * base * axes;
    assert!(
        apart.to_cols_array().iter().all(|x| x.abs() < 1e-12),
        "{apart}"
    );
}
