//! One joint on a circle: its range, its starts, and numbers that are not finite.

use super::*;
use dynamics_core::glam::{DMat3, DVec3};

fn turned(q: f64) -> Pose<f64> {
    let rot = DMat3::from_rotation_z(q);
    Pose { rot, pos: rot * DVec3::X }
}

fn tip(q: &[f64; 1]) -> (Pose<f64>, [Motion<f64>; 1]) {
    let pose = turned(q[0]);
    (pose, [Motion::new(DVec3::Z, DVec3::Z.cross(pose.pos))])
}

const SOLVER: PoseSolver<f64, 1> =
    PoseSolver { lower: [-1.0], upper: [2.0], length: 0.3, tolerance: 1e-9, iterations: 50 };

#[test]
fn a_joint_turns_to_the_pose_within_its_range() {
    let found = SOLVER.solve(&turned(1.9), &[-0.9], tip).unwrap();
    assert!((found.q[0] - 1.9).abs() < 1e-9 && found.iterations < 12, "{found:?}");
    let end = SOLVER.solve(&turned(2.4), &[-0.9], tip).unwrap_err();
    let PoseSolverError::NotReached(nearest) = end else { panic!("{end}") };
    assert_eq!((nearest.q, nearest.iterations), ([2.0], 50));
    assert!((nearest.error.ang.z - 2.0 * 0.2_f64.sin()).abs() < 1e-12);
    assert_eq!(end.to_string(), "no start has led to the pose");
    // A start beyond the range is one at its end.
    assert_eq!(SOLVER.solve(&turned(-1.0), &[-7.0], tip).unwrap().iterations, 1);
}

#[test]
fn starts_fill_the_range() {
    let mut cells = [0; 10];
    for n in 0..100 {
        let [q] = SOLVER.seed(n);
        cells[((q + 1.0) / 0.3) as usize] += 1;
    }
    assert_eq!(SOLVER.seed(0), [0.5]);
    assert!(cells.iter().all(|cell| (8..=12).contains(cell)), "{cells:?}");
    let free = PoseSolver { lower: [f64::NEG_INFINITY], upper: [f64::INFINITY], ..SOLVER };
    assert!((0..100).all(|n| free.seed(n)[0].abs() <= core::f64::consts::PI));
    assert!(free.solve(&turned(3.0), &[-3.0], tip).is_ok());
}

#[test]
fn numbers_that_are_not_finite_are_an_error() {
    let nan = Pose { pos: DVec3::NAN, ..turned(0.0) };
    let not_finite = Err(PoseSolverError::NotFinite);
    assert_eq!(SOLVER.solve(&nan, &[0.0], tip), not_finite);
    assert_eq!(
        SOLVER.solve(&turned(0.5), &[f64::NAN], tip).map(|found| found.q[0] > 0.4),
        Ok(true)
    );
    assert_eq!(SOLVER.solve(&turned(0.5), &[0.0], |_| tip(&[f64::NAN])), not_finite);
}

#[test]
fn a_solver_with_impossible_numbers_finds_nothing() {
    let (nan, infinity) = (f64::NAN, f64::INFINITY);
    let lengths = [0.0, -0.3, nan, infinity].map(|length| PoseSolver { length, ..SOLVER });
    let errors = [-1.0, nan, infinity].map(|tolerance| PoseSolver { tolerance, ..SOLVER });
    let ranges = [2.1, nan].map(|lower| PoseSolver { lower: [lower], ..SOLVER });
    for solver in lengths.iter().chain(&errors).chain(&ranges) {
        let refused = solver.solve(&turned(0.5), &[0.0], tip);
        assert_eq!(refused, Err(PoseSolverError::Solver), "{solver:?}");
    }
}
