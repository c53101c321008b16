//! Errors of all algorithms against the oracle.

use super::setup::{Setup, TrueState};
use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::scalar::Real;
use fixtures::hard::Answers;
use host_tests::hard::Row;
use host_tests::measured::larger;

/// The quantities, in the order of [`ErrorBounds`].
const QUANTITIES: [&str; 5] =
    ["RNEA", "CRBA + LᵀDL", "ABA", "OSIM⁻¹ by bodies", "OSIM⁻¹ by J M⁻¹ Jᵀ"];

/// The bounds of RNEA, CRBA + LᵀDL, ABA, and the inverse of the operational-space inertia by bodies
/// and by M.
#[derive(Clone, Copy, Debug)]
pub struct ErrorBounds {
    /// In f32.
    pub single: [f64; 5],
    /// In f64.
    pub double: [f64; 5],
}

/// Holds everything of a setup against the oracle.
///
/// A torque or acceleration is relative to its own joint's largest over the states, a mobility to
/// its largest entry.
pub fn against_oracle<const N: usize>(setup: &Setup<N>, bounds: &ErrorBounds) -> Vec<Row> {
    let truth = setup.truth();
    let answers = setup.answers(&truth);
    let single = errors(answers.iter().map(|(single, _)| single), &truth.states);
    let double = errors(answers.iter().map(|(_, double)| double), &truth.states);
    let mut rows = Vec::new();
    for (k, quantity) in QUANTITIES.into_iter().enumerate() {
        let name = format!("{quantity}, {}", setup.name);
        let pairs = [("f32", single[k], bounds.single[k]), ("f64", double[k], bounds.double[k])];
        for (scalar, error, bound) in pairs {
            let row = Row::measured(name.clone(), scalar, error, bound);
            rows.push(match truth.condition {
                Some(condition) if k > 0 => row.of_condition(condition),
                _ => row,
            });
        }
    }
    rows
}

/// The largest error of each quantity; not a number or infinite where there is no answer.
fn errors<'a, R: Real, const N: usize>(
    answers: impl Iterator<Item = &'a Answers<R, N>> + Clone,
    truth: &[TrueState],
) -> [f64; 5] {
    [
        by_joints(answers.clone().map(|a| Ok(a.rnea)), truth, |t| Some(&t.rnea)),
        by_joints(answers.clone().map(|a| a.forward), truth, |t| t.qdd.as_deref()),
        by_joints(answers.clone().map(|a| a.aba), truth, |t| t.qdd.as_deref()),
        of_matrices(answers.clone().map(|a| a.mobility), truth),
        of_matrices(answers.map(|a| a.by_matrix), truth),
    ]
}

/// Each coordinate relative to its largest over the states.
pub fn by_joints<R: Real, const N: usize>(
    found: impl Iterator<Item = Result<[R; N], NotPositiveDefinite>>,
    truth: &[TrueState],
    of: impl Fn(&TrueState) -> Option<&[f64]>,
) -> f64 {
    let mut scale = [0.0_f64; N];
    for state in truth {
        let Some(values) = of(state) else {
            return f64::NAN;
        };
        for (scale, x) in scale.iter_mut().zip(values) {
            *scale = scale.max(x.abs());
        }
    }
    let most = scale.iter().fold(0.0, |a, &b| f64::max(a, b));
    let mut worst = 0.0;
    for (found, state) in found.zip(truth) {
        let (Ok(found), Some(values)) = (found, of(state)) else {
            return f64::INFINITY;
        };
        for ((found, truth), scale) in found.iter().zip(values).zip(scale) {
            let scale = if scale == 0.0 { most } else { scale };
            worst = larger(worst, (found.to_f64() - truth).abs() / scale);
        }
    }
    worst
}

fn of_matrices<R: Real>(
    found: impl Iterator<Item = Result<[[R; 3]; 3], NotPositiveDefinite>>,
    truth: &[TrueState],
) -> f64 {
    let mut worst = 0.0;
    for (found, state) in found.zip(truth) {
        let (Ok(found), Some(values)) = (found, &state.mobility) else {
            return f64::INFINITY;
        };
        let scale = values.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        for (found, truth) in found.as_flattened().iter().zip(values) {
            worst = larger(worst, (found.to_f64() - truth).abs() / scale);
        }
    }
    worst
}
