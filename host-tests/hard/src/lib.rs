//! Hard cases: what breaks dynamics codes, each with an independent oracle, a bound and its reason.
//!
//! One file a family; a case runs itself and returns its rows, which the tests demand
//! and `cargo xtask hard-cases` writes down.

mod naive;
mod rerooted_chain;

pub mod chains;
pub mod clock;
pub mod continuous_turns;
pub mod descriptions;
pub mod elbow;
pub mod energy;
pub mod engine;
pub mod far_slide;
pub mod friction;
pub mod gradients;
pub mod impedance;
pub mod invariances;
pub mod masses;
pub mod measure;
pub mod nan_injection;
pub mod parallel;
pub mod placements;
pub mod setup;
pub mod speeds;
pub mod stick_slip;
pub mod stiff;
pub mod top;

use host_tests::hard::{Case, demand_of};
use simulation_tests::long::name;
pub use simulation_tests::long::{attitude, day, integrators, pendulum};

/// All cases, a slice a family.
pub const CASES: &[&[Case]] = &[
    masses::CASES,
    chains::CASES,
    placements::CASES,
    far_slide::CASES,
    speeds::CASES,
    elbow::CASES,
    parallel::CASES,
    descriptions::CASES,
    invariances::CASES,
    attitude::CASES,
    top::CASES,
    energy::CASES,
    stiff::CASES,
    friction::CASES,
    stick_slip::CASES,
    nan_injection::CASES,
    clock::CASES,
    continuous_turns::CASES,
    engine::CASES,
    impedance::CASES,
    gradients::CASES,
];

/// The numbers of all cases, as a constant: a program that names [`CASES`] has the code of all of
/// them.
pub const NUMBERS: [u32; count()] = {
    let (mut numbers, mut next, mut family) = ([0; count()], 0, 0);
    while family < CASES.len() {
        let mut case = 0;
        while case < CASES[family].len() {
            numbers[next] = CASES[family][case].number;
            (case, next) = (case + 1, next + 1);
        }
        family += 1;
    }
    numbers
};

const fn count() -> usize {
    let (mut count, mut family) = (0, 0);
    while family < CASES.len() {
        count += CASES[family].len();
        family += 1;
    }
    count
}

/// Runs the case of this number.
///
/// # Errors
/// There is none, or not every row is as demanded: says which.
pub fn demand(number: u32) -> Result<(), String> {
    demand_of(CASES, number)
}
