//! The bound of one output of a function, beside the worst error that the search found.

use serde::{Deserialize, Serialize};

use crate::bound::Bound;
use crate::interval::Interval;

/// The proven bound of one output, and the errors that were found.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Output {
    /// The number of the joint, from 1.
    pub name: String,
    /// The proven bound of its error.
    pub bound: f64,
    /// The parts of which the bound is the sum.
    pub of: Bound,
    /// The worst error that the search found.
    pub observed: f64,
    /// The state of it: q, q̇, q̈.
    pub state: Vec<f64>,
    /// The proven range of the computed value.
    pub range: Interval,
    /// The parts of the box.
    pub parts: usize,
    /// Which of the two proofs says the less.
    pub proof: Proof,
}

/// The method by which a bound was proven; both are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Proof {
    /// By intervals over parts of the box: [`crate::branch`]
    Parts,
    /// By a grid of angles: [`crate::grid`]
    Grid,
}

impl Proof {
    /// Its name on a page.
    pub fn name(self) -> &'static str {
        match self {
            Self::Parts => "parts",
            Self::Grid => "grid",
        }
    }
}

impl Output {
    /// The bound as a multiple of the observed error.
    pub fn ratio(&self) -> f64 {
        self.bound / self.observed
    }
}
