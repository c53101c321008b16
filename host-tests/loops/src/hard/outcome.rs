//! The outcome of an algorithm for one state, held against the demand on it.

use dynamics_core::scalar::Real;
use host_tests::hard::Row;
use host_tests::measured::largest;

use super::bounds::{BOUNDS, Demand};

/// Numbers, and whether they come with a status or an error that names what is singular.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The numbers; none after an error.
    pub values: Vec<f64>,
    /// Whether the loop, row, joint or cluster is named.
    pub named: bool,
}

/// The bound of numbers near a singular configuration, as a multiple of their size elsewhere.
const BOUNDED: f64 = 1e9;

/// The share of the largest acceleration below which a coordinate does not move.
const STILL: f64 = 1e-9;

impl Outcome {
    /// The outcome of an error that names nothing.
    pub const NOTHING: Self = Self { values: Vec::new(), named: false };
    /// An error that names what is singular.
    pub const REFUSED: Self = Self { values: Vec::new(), named: true };

    pub fn of<R: Real, const N: usize>(values: &[R; N], named: bool) -> Self {
        let values = values.map(R::to_f64).to_vec();
        Self { values, named }
    }

    /// Each angle by as many turns more as bring it next to the other one.
    #[must_use]
    pub fn with_whole_turns_of(mut self, other: &[f64]) -> Self {
        for (x, other) in self.values.iter_mut().zip(other) {
            let turns = (other - *x) / core::f64::consts::TAU;
            *x += turns.round() * core::f64::consts::TAU;
        }
        self
    }

    /// Whether the singular configuration is named, and every number finite and bounded.
    pub fn is_named(&self) -> bool {
        // False of a NaN, too.
        self.named && self.values.iter().all(|x| x.abs() < BOUNDED)
    }
}

/// The demands on a quantity in f32 and f64, if there are any.
pub(super) fn demands(case: u32, quantity: &str) -> Option<[Demand; 2]> {
    let row = BOUNDS.iter().find(|row| (row.0, row.1) == (case, quantity));
    if let Some(&(_, _, single, double)) = row {
        return Some([single, double]);
    }
    if let Some(rest) = quantity.strip_prefix("engine: ") {
        return demands(case, &format!("clusters: {rest}"));
    }
    let rigid = demands(case, quantity.strip_prefix("damped ")?)?;
    (rigid[0] == Demand::Named).then_some([Demand::Named; 2])
}

/// The rows of a quantity in f32 and in f64 against the oracle's, as [`BOUNDS`] demands.
pub fn rows(
    case: u32,
    quantity: &str,
    outcomes: [&[Outcome]; 2],
    truth: &[Option<&[f64]>],
) -> Vec<Row> {
    let mut rows = Vec::new();
    let demands = demands(case, quantity)
        .unwrap_or_else(|| panic!("no bound of {quantity:?} of case {case}"));
    for ((scalar, outcomes), demand) in ["f32", "f64"].into_iter().zip(outcomes).zip(demands) {
        let named = || {
            let words = format!("{quantity}: named, finite");
            Row::claim(words, scalar, outcomes.iter().all(Outcome::is_named))
        };
        let error = error(outcomes, truth, quantity.contains("(rad, m)"));
        match demand {
            Demand::Within(bound) => {
                let status = outcomes.iter().any(|outcome| outcome.named);
                let error = if status { f64::INFINITY } else { error };
                rows.push(Row::measured(quantity, scalar, error, bound));
            }
            Demand::NamedWithin(bound) => {
                rows.extend([Row::measured(quantity, scalar, error, bound), named()]);
            }
            Demand::Named => rows.push(named()),
        }
    }
    rows
}

/// The largest error, each coordinate relative to its largest over the states, or in rad and m
/// where it is `absolute`; infinite where there is no answer.
fn error(outcomes: &[Outcome], truth: &[Option<&[f64]>], absolute: bool) -> f64 {
    let Some(truth) = truth.iter().copied().collect::<Option<Vec<_>>>() else {
        return f64::INFINITY;
    };
    let size = |i: usize| largest(truth.iter().map(|row| row[i].abs()));
    let most = largest(truth.iter().flat_map(|row| row.iter().map(|x| x.abs())));
    let mut errors = Vec::new();
    for (outcome, truth) in outcomes.iter().zip(&truth) {
        if outcome.values.len() != truth.len() {
            return f64::INFINITY;
        }
        for (i, (x, truth)) in outcome.values.iter().zip(*truth).enumerate() {
            // One that does not move but for rounding has no scale of its own.
            let scale = if size(i) < STILL * most { most } else { size(i) };
            let error = (x - truth).abs();
            errors.push(if absolute || scale == 0.0 { error } else { error / scale });
        }
    }
    largest(errors)
}
