//! Errors of many answers, joint by joint.

use host_tests::measured::largest;
use serde::Serialize;

/// |error| of N joints, answer by answer.
#[derive(Clone, Debug)]
pub struct Errors<const N: usize>(pub [Vec<f64>; N]);

/// What is told of errors; the fields are those of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    pub error_max: f64,
    pub error_rms: f64,
    pub error_p99: f64,
    pub relative_max: f64,
    pub answers: usize,
    pub joint_max: Vec<f64>,
    pub joint_rms: Vec<f64>,
    pub joint_p99: Vec<f64>,
}

impl<const N: usize> Errors<N> {
    pub fn new() -> Self {
        Self([(); N].map(|()| Vec::new()))
    }

    /// Of answers and what they should have been.
    pub fn of(pairs: impl Iterator<Item = ([f64; N], [f64; N])>) -> Self {
        let mut errors = Self::new();
        pairs.for_each(|(told, truth)| errors.add(&told, &truth));
        errors
    }

    pub fn add(&mut self, told: &[f64; N], truth: &[f64; N]) {
        for ((errors, told), truth) in self.0.iter_mut().zip(told).zip(truth) {
            let error = (told - truth).abs();
            errors.push(if error.is_nan() { f64::INFINITY } else { error });
        }
    }

    pub fn summary(&self, full_scale: f64) -> Summary {
        let each = |of: fn(&[f64]) -> f64| self.0.iter().map(|errors| of(errors)).collect();
        let all = self.0.concat();
        Summary {
            error_max: max(&all),
            error_rms: rms(&all),
            error_p99: p99(&all),
            relative_max: max(&all) / full_scale,
            answers: self.0[0].len(),
            joint_max: each(max),
            joint_rms: each(rms),
            joint_p99: each(p99),
        }
    }
}

fn max(errors: &[f64]) -> f64 {
    largest(errors.iter().copied())
}

fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// The smallest error that 99 % do not exceed.
fn p99(errors: &[f64]) -> f64 {
    let mut sorted = errors.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[(sorted.len() * 99).div_ceil(100) - 1]
}
