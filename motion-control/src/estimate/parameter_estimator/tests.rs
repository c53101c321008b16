//! The estimator against least squares with a whole matrix of information, as the module has them.

use super::*;
use crate::estimate::tests::{Numbers, inverse, ticks};
use crate::limits::ConfigParameter;

mod config;
mod freeze;

/// Parameters of all joints, then of the first, then of the second: more than four in a line, and a
/// rest of those of the first.
const COMMON: usize = 5;
const OWN: [u16; 2] = [5, 1];
const P: usize = 11;
const NOISE: [f64; 2] = [0.5, 2.0];

type Config = ParameterEstimatorConfig<f64, P, 2>;
type Estimator = ParameterEstimator<f64, P, 2>;
type Matrix = [[f64; P]; P];

fn config(forgetting: f64) -> Config {
    Config {
        noise: NOISE,
        prior: core::array::from_fn(|k| 0.5 + 0.25 * k as f64),
        own: OWN,
        forgetting,
        limit: 1e3,
    }
}

impl Numbers {
    /// A row of a joint: without the parameters of the other one.
    fn row(&mut self, joint: usize) -> [f64; P] {
        let other = [10..P, COMMON..10][joint].clone();
        core::array::from_fn(|k| if other.contains(&k) { 0.0 } else { self.next() })
    }
}

/// The equations of the module with P⁻¹ as a matrix.
struct Whole {
    information: Matrix,
    estimate: [f64; P],
    forgetting: f64,
    levels: [f64; 2],
}

impl Whole {
    fn new(config: &Config, estimate: [f64; P]) -> Self {
        let diagonal = config.prior.map(|prior| 1.0 / (prior * prior));
        Self {
            information: core::array::from_fn(|i| {
                core::array::from_fn(|j| if i == j { diagonal[i] } else { 0.0 })
            }),
            estimate,
            forgetting: config.forgetting,
            levels: [1.0; 2],
        }
    }

    fn update(&mut self, joint: usize, y: &[f64; P], residual: f64) {
        let y = y.map(|y| y / NOISE[joint]);
        let covariance = inverse(self.information);
        let gain = covariance.map(|row| dot(&row, &y));
        let (r, error) = (dot(&gain, &y), residual / NOISE[joint] - dot(&self.estimate, &y));
        let known = (1.0 - self.forgetting * (1.0 + r) / r).max(0.0);
        for i in 0..P {
            self.estimate[i] += gain[i] * error / (1.0 + r);
            for j in 0..P {
                self.information[i][j] += known * y[i] * y[j];
            }
        }
        let innovation = error * error / (1.0 + r);
        self.levels[joint] += (innovation - self.levels[joint]) / 64.0;
    }

    fn deviations(&self) -> [f64; P] {
        let covariance = inverse(self.information);
        core::array::from_fn(|k| covariance[k][k].sqrt())
    }
}

#[track_caller]
fn near<const N: usize>(got: &[f64; N], expected: &[f64; N]) {
    for (a, b) in got.iter().zip(expected) {
        let off = (a - b) / (1.0 + b.abs());
        assert!(off.abs() < 1e-9, "{got:?} {expected:?}");
    }
}

/// Both after this many rows in turn, and compared in each.
fn compared(estimator: &mut Estimator, whole: &mut Whole, rows: u32) {
    let mut numbers = Numbers(7);
    for k in 0..rows {
        let joint = (k % 3 == 1) as usize;
        let (y, residual) = (numbers.row(joint), 3.0 * numbers.next());
        assert_eq!(estimator.update(joint, &y, residual), Ok(()));
        whole.update(joint, &y, residual);
        near(&estimator.estimate(), &whole.estimate);
        near(&estimator.deviations(), &whole.deviations());
        near(estimator.consistency(), &whole.levels);
        let y = numbers.row(joint);
        let explained = dot(&y, &whole.estimate);
        assert!((estimator.explained(joint, &y) - explained).abs() < 1e-9);
    }
}

#[test]
fn each_row_gives_the_estimate_of_least_squares() {
    for forgetting in [0.0, 0.02, 0.3, 0.9] {
        let config = config(forgetting);
        let mut estimator = Estimator::try_new(config).expect("a good configuration");
        let mut whole = Whole::new(&config, [0.0; P]);
        compared(&mut estimator, &mut whole, 60);
        assert_eq!(estimator.rejected(), &[0; 2]);
    }
}

#[test]
fn a_reopened_estimator_has_its_prior_about_the_estimate() {
    let config = config(0.01);
    let mut estimator = Estimator::try_new(config).expect("a good configuration");
    compared(&mut estimator, &mut Whole::new(&config, [0.0; P]), 30);
    let estimate = estimator.estimate();
    estimator.reopen();
    near(&estimator.estimate(), &estimate);
    near(&estimator.deviations(), &config.prior);
    assert_eq!(estimator.consistency(), &[1.0; 2]);
    compared(&mut estimator, &mut Whole::new(&config, estimate), 30);
}

#[test]
fn a_row_without_a_direction_adds_nothing() {
    let mut estimator = Estimator::try_new(config(0.1)).expect("a good configuration");
    let before = estimator;
    assert_eq!(estimator.update(1, &[0.0; P], 0.0), Ok(()));
    assert_eq!(estimator.factors, before.factors);
    assert_eq!(estimator.consistency(), &[1.0, 63.0 / 64.0]);
}

#[test]
fn a_joint_that_there_is_not_changes_nothing() {
    let mut estimator = Estimator::try_new(config(0.0)).expect("a good configuration");
    let before = estimator;
    assert_eq!(estimator.update(2, &[1.0; P], 1.0), Ok(()));
    assert_eq!(estimator, before);
    assert_eq!(estimator.explained(2, &[1.0; P]), 0.0);
}
