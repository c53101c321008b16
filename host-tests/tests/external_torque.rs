//! From the external torques of the joints: the wrench of a contact at the tip, and thresholds.

use dynamics_core::Core;
use dynamics_core::algorithms::frame;
use dynamics_core::model::Robot;
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use glam::DVec3;
use motion_control::estimate::{ContactDetector, ObserverConfig, TipWrench, TipWrenchConfig};
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// A wrench, a couple in N·m and a force in N, and the torques that it has about joints whose
/// motions are `jacobian`.
fn pushed<R: Real, const N: usize>(jacobian: &[Motion<R>; N], push: [f64; 6]) -> [R; N] {
    let [a, b, c, x, y, z] = push.map(R::from_f64);
    let push = Force::new(R::Vec3::new(a, b, c), R::Vec3::new(x, y, z));
    jacobian.map(|column| column.dot(push))
}

fn estimator<R: Real, const N: usize>(noise: f64, [couple, force]: [f64; 2]) -> TipWrench<R, N> {
    let config = TipWrenchConfig {
        noise: [R::from_f64(noise); N],
        force: R::from_f64(force),
        couple: R::from_f64(couple),
    };
    TipWrench::try_new(config).expect("sizes that can be")
}

fn six<R: Real>(f: Force<R>) -> [f64; 6] {
    let [a, b] = [f.ang, f.lin].map(|v| v.array().map(R::to_f64));
    core::array::from_fn(|i| if i < 3 { a[i] } else { b[i - 3] })
}

/// The largest error of the force over random postures away from singular ones, N, of forces of up
/// to 50 N along each axis.
fn worst_force<R: Real, T: Robot<N, N, N>, const N: usize>() -> f64 {
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let (mut worst, mut postures) = (0.0_f64, 0);
    while postures < 200 {
        let mut random = |bound: f64| rng.random_range(-bound..bound);
        let q: [R; N] = [(); N].map(|()| R::from_f64(random(3.0)));
        let push = [0.0, 0.0, 0.0, random(50.0), random(50.0), random(50.0)];
        let jacobian = Core::<T>::jacobian(&q, N - 1, frame::LocalWorldAligned);
        // The volume of what three joints at a time do to the tip.
        let rows = jacobian.map(|column| column.lin.array().map(R::to_f64));
        let gram = |a: usize, b: usize| rows.iter().map(|row| row[a] * row[b]).sum::<f64>();
        let axes = [0, 1, 2].map(|a| DVec3::new(gram(a, 0), gram(a, 1), gram(a, 2)));
        if axes[0].dot(axes[1].cross(axes[2])) < 1e-3 {
            continue;
        }
        postures += 1;
        let at_a_point = estimator(1e-2, [0.0, 100.0]);
        let found = at_a_point.estimate(&jacobian, &pushed(&jacobian, push));
        let found = six(found.expect("finite torques"));
        for (found, push) in found.iter().zip(push) {
            worst = worst.max((found - push).abs());
        }
    }
    worst
}

#[test]
fn a_force_at_the_tip_is_found_within_the_noise() {
    let worst = [
        worst_force::<f64, Ur5e, 6>(),
        worst_force::<f64, Panda, 7>(),
        worst_force::<f32, Ur5e, 6>(),
    ];
    println!("{worst:?} N");
    assert!(worst.iter().all(|&worst| worst < 0.005), "{worst:?} N");
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// v less its parts along some unit vectors.
fn rest(mut v: [f64; 6], units: &[[f64; 6]]) -> [f64; 6] {
    for unit in units {
        let part = dot(&v, unit);
        v.iter_mut().zip(unit).for_each(|(v, unit)| *v -= part * unit);
    }
    v
}

// The posture is singular, and other wrenches are estimated as they are.
#[test]
fn a_wrench_without_torque_is_estimated_as_zero() {
    // Two axes of the wrist on one line.
    let q = [0.3, -1.2, 1.5, 0.3, 0.0, 0.2];
    let jacobian = Core::<Ur5e>::jacobian(&q, 5, frame::LocalWorldAligned);
    let mut units: Vec<[f64; 6]> = Vec::new();
    for column in jacobian {
        let column = rest(six::<f64>(Force::new(column.ang, column.lin)), &units);
        let length = dot(&column, &column).sqrt();
        if length > 1e-9 {
            units.push(column.map(|x| x / length));
        }
    }
    assert_eq!(units.len(), 5);
    let silent = rest([1.0, 2.0, -1.0, 0.5, 3.0, -2.0], &units).map(|x| 20.0 * x);
    let given = estimator(1e-3, [100.0, 100.0]);
    let estimate = |push| six(given.estimate(&jacobian, &pushed(&jacobian, push)).expect("finite"));
    let found = estimate(silent);
    assert!(found.iter().all(|f| f.abs() < 1e-6), "{found:?}, {silent:?}");
    // A push that lifts the arm, and all that does not press along the direction without torque.
    let push = units[1].map(|x| 20.0 * x);
    let found = estimate(core::array::from_fn(|k| push[k] + silent[k]));
    for (found, push) in found.iter().zip(push) {
        assert!((found - push).abs() < 1e-3, "{found} {push}");
    }
}

/// The largest force that f32 finds where a push of 1 N acts, at 2,000 postures each with two axes
/// of the wrist on one line.
fn largest_in_f32(noise: f64, couple: f64) -> f64 {
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut largest = 0.0_f64;
    for _ in 0..2000 {
        let mut q = [(); 6].map(|()| rng.random_range(-3.0_f32..3.0));
        q[4] = 0.0;
        let jacobian = Core::<Ur5e>::jacobian(&q, 5, frame::LocalWorldAligned);
        let external = pushed(&jacobian, [0.0, 0.0, 0.0, 0.6, 0.0, 0.8]);
        let given = estimator::<f32, 6>(noise, [couple, 100.0]);
        let found = six(given.estimate(&jacobian, &external).expect("finite"));
        largest = found[3..].iter().fold(largest, |most, f| most.max(f.abs()));
    }
    largest
}

#[test]
fn singular_postures_do_not_enlarge_wrenches_in_f32() {
    for (noise, couple) in [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6]
        .into_iter()
        .flat_map(|noise| [0.0, 1.0, 10.0, 100.0].map(|couple| (noise, couple)))
    {
        let largest = largest_in_f32(noise, couple);
        println!("noise {noise} N·m, couple {couple} N·m: {largest} N");
        assert!(largest < 0.85, "{largest} N");
    }
}

// With two poles it rises as the external torque of the same error does.
#[test]
fn the_threshold_rises_with_the_stated_model_error() {
    let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    let margin = 0.5;
    let mut detector: ContactDetector<f64, 1, 2> =
        ContactDetector::try_new(config, [margin]).expect("a good one");
    // From the second tick on, the model is off by exactly the 3 N·m that are stated.
    for tick in 0..200 {
        let p = 3.0 * 1e-3 * f64::from(tick);
        let contact = detector.update(&[p], &[0.0], &[3.0]).expect("finite");
        assert_eq!(contact, None);
        let ([threshold], [r]) = (detector.threshold(), *detector.external_torque());
        assert!((threshold - margin - r).abs() < 1e-12, "{tick}: {threshold} {r}");
        detector.drive(&[0.0]);
    }
    assert!((detector.external_torque()[0] - 3.0).abs() < 0.01);
}
