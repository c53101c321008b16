//! Hard cases with kinematic loops, as those of `host_tests::hard`, in whose numbers these go on.
//!
//! Planar linkages are in `fixtures::hard::loops`, where a microcontroller computes them, too.

mod bounds;
mod cases;
mod four_bars;
mod geared;
mod outcome;
mod robots;
mod setup;
mod status;
mod torque;

pub use bounds::{BOUNDS, Demand};
pub use cases::CASES;
pub use four_bars::problem;
pub use outcome::{Outcome, rows};
pub use setup::{Exported, Planar, Setup, Start, TrueState, Truth};

use fixtures::hard::loops::{PROBLEMS, RIG};

/// Runs the case of this number.
///
/// # Errors
/// There is none, or not every row is as demanded: says which.
pub fn demand(number: u32) -> Result<(), String> {
    host_tests::hard::demand_of(CASES, number)
}

/// The problems that the oracle reads: all but those without an answer.
pub fn exported() -> Vec<Exported> {
    let closing = PROBLEMS.iter().filter(|problem| problem.case != 52);
    let mut all: Vec<Exported> = closing.map(|problem| Planar::of(problem).exported()).collect();
    all.push(Planar::of(&RIG).exported());
    all.extend(robots::deltas().iter().map(Setup::exported));
    all.extend(robots::stewarts().iter().map(Setup::exported));
    all.extend([geared::differential(), geared::belt()]);
    all
}
