//! Near and at singular poses: the damping is as documented, and nothing jumps along a path through
//! them.

use crate::common::*;
use dynamics_core::algorithms::{
    Conditioning, Damping, OperationalSpace, damped_inverse, frame, operational_space,
};
use dynamics_core::effects::{Armature, Inertia, RIGID_BODY};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::scalar::Real;
use motion_control::law::TaskFrame;

const DAMPING: f64 = 1e-3;

/// A random rotation of M coordinates, by rows: products of plane rotations.
fn rotation<const M: usize>(rng: &mut Rng) -> [[f64; M]; M] {
    let mut rows: [[f64; M]; M] =
        core::array::from_fn(|i| core::array::from_fn(|j| f64::from(i == j)));
    for _ in 0..2 {
        for p in 0..M {
            for q in p + 1..M {
                let (s, c) = rng.within(3.0).sin_cos();
                let pairs = rows[p].into_iter().zip(rows[q]).enumerate();
                for (k, (x, y)) in pairs {
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

/// Matrices of known eigenvalues, from equal ones to 10⁻¹², some zero, against what the damping
/// promises.
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
        assert_eq!(how == Conditioning::Regular, least >= threshold, "{how:?} {least} {threshold}");
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

/// The largest first and second differences of Λ on a path from −1 to 1 in n steps, and whether it
/// was damped at the ends and in the middle.
fn sweep<const M: usize, const N: usize>(
    n: usize,
    task: &impl Fn(f64) -> OperationalSpace<f64, M, N>,
) -> ([f64; 2], [bool; 3]) {
    let tasks: Vec<_> = (0..=n).map(|k| task(2.0 * k as f64 / n as f64 - 1.0)).collect();
    let mut most = [0.0_f64; 2];
    for three in tasks.windows(3) {
        for i in 0..M {
            for j in 0..M {
                let [a, b, c] = [0, 1, 2].map(|k| three[k].inertia[i][j]);
                assert!(c.is_finite());
                most = [most[0].max((b - a).abs()), most[1].max((a - 2.0 * b + c).abs())];
            }
        }
    }
    let damped = [0, n / 2, n].map(|k| tasks[k].conditioning != Conditioning::Regular);
    (most, damped)
}

/// Halving the step halves the differences of a function without jumps and quarters the second
/// differences of one whose slope has none; a jump would leave them at 1 and at ½.
fn is_smooth<const M: usize, const N: usize>(
    what: &str,
    task: impl Fn(f64) -> OperationalSpace<f64, M, N>,
) {
    let (coarse, damped) = sweep(4000, &task);
    let (fine, _) = sweep(8000, &task);
    let ratios = [fine[0] / coarse[0], fine[1] / coarse[1]];
    println!("{what}: {ratios:?}");
    assert_eq!(damped, [false, true, false], "{what}: regular, through the singularity, regular");
    assert!(ratios[0] < 0.51 && ratios[1] < 0.27, "{what}: {ratios:?}");
}

/// Two links of 1 m and 0.7 m that turn about y.
const TWO: ArmModel<f64, 3> = Model::new(
    "two links",
    [
        Body::new("upper", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.5, 0.0, 0.0]),
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
fn damped_results_are_smooth_through_a_singularity() {
    let damping = Damping::relative(DAMPING);
    // Postures of the UR5e: the elbow stretched; two axes of the wrist in one line.
    let elbow = |s: f64| [0.0, -1.2, 0.4 * s, 0.3, 0.7, 0.0];
    let wrist = |s: f64| [0.3, -1.2, 1.5, 0.3, 0.6 * s, 0.2];
    let all = TaskFrame::BASE.turn_and_place(0.3);
    let geared = (Inertia, Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]));
    let arm = |q| {
        operational_space(&Ur5e::MODEL, &q, (5, frame::LocalWorldAligned), &all, &geared, damping)
            .unwrap()
    };
    is_smooth("elbow", |s| arm(elbow(s)));
    is_smooth("wrist", |s| arm(wrist(s)));
    // Two stretched links; and a task of one direction, which has no other to compare with.
    let [x, _, z] = TaskFrame::BASE.place();
    let two = |s: f64| [0.3 * s, 0.4 * s, 0.0];
    let plane = |s| {
        operational_space(
            &TWO,
            &two(s),
            (2, frame::LocalWorldAligned),
            &[x, z],
            &RIGID_BODY,
            damping,
        )
        .unwrap()
    };
    is_smooth("two links", plane);
    let heavy = Damping::relative(0.0).with_max_inertia(500.0);
    let line = |s| {
        operational_space(&TWO, &two(s), (2, frame::LocalWorldAligned), &[x], &RIGID_BODY, heavy)
            .unwrap()
    };
    is_smooth("along two links", line);
}

#[test]
fn singular_poses_give_finite_results_and_a_status() {
    fn at<R: Real, T: Robot<N, N, N>, const N: usize>() {
        let damping = Damping::relative(R::from_f64(DAMPING));
        let q = [R::ZERO; N];
        let model = dynamics_core::model::model::<R, T, N, N, N>();
        let task = operational_space(
            model,
            &q,
            (N - 1, frame::LocalWorldAligned),
            &unit(),
            &RIGID_BODY,
            damping,
        )
        .unwrap();
        assert!(
            matches!(task.conditioning, Conditioning::Damped { smallest } if smallest < R::from_f64(1e-2))
        );
        assert!(task.inertia.iter().flatten().all(|x| x.is_finite()));
        assert!(task.consistent_inverse().iter().flatten().all(|x| x.is_finite()));
    }
    at::<f64, Ur5e, 6>();
    at::<f32, Ur5e, 6>();
    at::<f64, Panda, 7>();
    at::<f32, Panda, 7>();
    // A body that cannot move at all.
    let (inertia, how) = damped_inverse(&[[0.0_f32; 6]; 6], Damping::relative(1e-3));
    assert_eq!((inertia, how), ([[0.0; 6]; 6], Conditioning::Damped { smallest: 0.0 }));
}

#[test]
fn numbers_that_are_not_finite_are_never_called_regular() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut a = [[0.0; 3]; 3];
        for (i, row) in a.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        for (i, j) in [(0, 0), (2, 2), (0, 1), (1, 2)] {
            let mut a = a;
            (a[i][j], a[j][i]) = (bad, bad);
            let (_, how) = damped_inverse(&a, Damping::relative(1e-3));
            assert_ne!(how, Conditioning::Regular, "{bad} at {i}, {j}");
        }
    }
}
