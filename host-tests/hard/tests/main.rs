//! The hard cases hold: a file per family, a test per case.

mod attitude;
mod chains;
mod clock;
mod descriptions;
mod elbow;
mod energy;
mod engine;
mod friction;
mod gradients;
mod impedance;
mod invariances;
mod masses;
mod nan_injection;
mod parallel;
mod placements;
mod speeds;
mod stiff;

use hard_cases::NUMBERS;
use host_tests::hard::{Row, demand_rows};

/// Runs a case and demands every row's verdict.
fn demand(number: u32) {
    hard_cases::demand(number).unwrap_or_else(|wrong| panic!("{wrong}"));
}

/// Demands a part of a case that takes long; `cargo xtask test hard-cases` demands the whole case.
fn demand_part(number: u32, part: fn() -> Vec<Row>) {
    demand_rows(number, &part()).unwrap_or_else(|wrong| panic!("{wrong}"));
}

#[test]
fn no_number_is_given_twice() {
    let mut numbers = NUMBERS;
    numbers.sort_unstable();
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]));
}
