//! The estimate against least squares with a whole matrix of information, and the decisions about a
//! measurement.

use super::*;
use crate::estimate::tests::{Numbers, inverse, solved, ticks};

mod decisions;

const V: usize = 3;
const N: usize = PARAMETERS;
const NOISE: [f64; V] = [0.5, 2.0, 1.0];

type Matrix = [[f64; N]; N];
type Estimator = PayloadEstimator<f64, V>;

fn config(forgetting: f64) -> PayloadEstimatorConfig<f64, V> {
    PayloadEstimatorConfig {
        noise: NOISE,
        prior: core::array::from_fn(|k| 0.5 + 0.25 * k as f64),
        forgetting,
        limit: 1e3,
    }
}

fn estimator(forgetting: f64) -> Estimator {
    Estimator::try_new(config(forgetting)).expect("a good configuration")
}

fn rows(numbers: &mut Numbers) -> ([[f64; N]; V], [f64; V]) {
    let y = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
    (y, core::array::from_fn(|_| 3.0 * numbers.next()))
}

/// The unit upper triangle U and the diagonal D of Uᵀ D U.
fn factored(mut a: Matrix) -> (Matrix, [f64; N]) {
    let mut u = [[0.0; N]; N];
    for k in 0..N {
        for j in k..N {
            u[k][j] = a[k][j] / a[k][k];
        }
        let pivot = a[k];
        for (row, share) in a.iter_mut().zip(u[k]).skip(k + 1) {
            let later = row.iter_mut().zip(pivot).skip(k + 1);
            later.for_each(|(x, p)| *x -= share * p);
        }
    }
    (u, core::array::from_fn(|k| a[k][k]))
}

fn information(u: &Matrix, d: &[f64; N]) -> Matrix {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| (0..N).map(|k| u[k][i] * d[k] * u[k][j]).sum())
    })
}

fn dot_of(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The same with a matrix of information, of which each pivot forgets at most what the tick brings
/// it.
struct Whole {
    information: Matrix,
    estimate: [f64; N],
    forgetting: f64,
    level: f64,
}

impl Whole {
    fn new(config: &PayloadEstimatorConfig<f64, V>) -> Self {
        let mut information = [[0.0; N]; N];
        for (k, prior) in config.prior.iter().enumerate() {
            information[k][k] = 1.0 / (prior * prior);
        }
        Self { information, estimate: [0.0; N], forgetting: config.forgetting, level: 1.0 }
    }

    fn update(&mut self, joints: &[usize], y: &[[f64; N]; V], residual: &[f64; V]) {
        let (u, before) = factored(self.information);
        let ticks = joints.iter().map(|&joint| {
            let row = y[joint].map(|y| y / NOISE[joint]);
            (row, residual[joint] / NOISE[joint])
        });
        let rows: std::vec::Vec<_> = ticks.collect();
        let with = |kept: &[f64; N]| {
            let mut all = information(&u, kept);
            for (row, _) in &rows {
                for i in 0..N {
                    for j in 0..N {
                        all[i][j] += row[i] * row[j];
                    }
                }
            }
            all
        };
        let mut kept = before;
        for k in 0..N {
            let new = factored(with(&kept)).1[k] - kept[k];
            kept[k] -= new.min(self.forgetting * kept[k]);
        }
        let old = information(&u, &kept);
        let mut right: [f64; N] = old.map(|row| dot_of(&row, &self.estimate));
        for (row, z) in &rows {
            (0..N).for_each(|i| right[i] += row[i] * z);
        }
        self.information = with(&kept);
        let estimate = solved(self.information, right);
        // The remainder of the old information and of the tick after the new estimate.
        let change = core::array::from_fn(|i| estimate[i] - self.estimate[i]);
        let left = rows.iter().map(|(row, z)| (z - dot_of(row, &estimate)).powi(2));
        let moved = dot_of(&change, &old.map(|row| dot_of(&row, &change)));
        let innovation = (left.sum::<f64>() + moved) / rows.len() as f64;
        self.level += (innovation - self.level) / 64.0;
        self.estimate = estimate;
    }

    fn deviations(&self) -> [f64; N] {
        let covariance = inverse(self.information);
        core::array::from_fn(|k| covariance[k][k].sqrt())
    }
}

#[track_caller]
fn near(got: &[f64; N], expected: &[f64; N]) {
    for (a, b) in got.iter().zip(expected) {
        let gap = (a - b).abs();
        assert!(gap < 1e-8 * (1.0 + b.abs()), "{got:?} {expected:?}");
    }
}

#[track_caller]
fn agree(estimator: &Estimator, whole: &Whole) {
    near(&estimator.inertia().parameters(), &whole.estimate);
    near(&estimator.deviations(), &whole.deviations());
    let gap = estimator.consistency() - whole.level;
    assert!(gap.abs() < 1e-9 * (1.0 + whole.level), "{gap}");
}

#[test]
fn each_tick_gives_the_estimate_of_least_squares() {
    for forgetting in [0.0, 0.01, 0.2, 0.9] {
        let mut estimator = estimator(forgetting);
        let mut whole = Whole::new(&config(forgetting));
        let mut numbers = Numbers(3);
        for _ in 0..25 {
            let (y, residual) = rows(&mut numbers);
            assert_eq!(estimator.update(&y, &residual), Ok(()));
            whole.update(&[0, 1, 2], &y, &residual);
            agree(&estimator, &whole);
        }
        // Two joints alone, and in another order.
        for joints in [[0, 2], [2, 1], [1, 0]] {
            let (y, residual) = rows(&mut numbers);
            assert_eq!(estimator.update_joints(joints, &y, &residual), Ok(()));
            whole.update(&joints, &y, &residual);
            agree(&estimator, &whole);
        }
    }
}

#[test]
fn a_tick_without_information_changes_no_bit() {
    let mut estimator = estimator(0.1);
    let (y, residual) = rows(&mut Numbers(5));
    assert_eq!(estimator.update(&y, &residual), Ok(()));
    let before = estimator;
    assert_eq!(estimator.update(&[[0.0; N]; V], &[0.0; V]), Ok(()));
    assert_eq!(estimator.factors(), before.factors());
    assert_eq!(estimator.deviations(), before.deviations());
}

#[test]
fn a_restart_leaves_a_new_estimator() {
    let mut used = estimator(0.01);
    let mut numbers = Numbers(9);
    for _ in 0..7 {
        let (y, residual) = rows(&mut numbers);
        assert_eq!(used.update(&y, &residual), Ok(()));
    }
    let (y, _) = rows(&mut numbers);
    for _ in 0..30 {
        assert!(used.update(&y, &[1e8; V]).is_err());
    }
    assert!(used.frozen());
    used.restart();
    assert_eq!(used, estimator(0.01));
}
