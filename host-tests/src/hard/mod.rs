//! Hard cases: what breaks dynamics codes, each with an independent oracle, a bound and its reason.
//!
//! One file a family; a case runs itself and returns its rows, which `host-tests/tests/hard_cases` demands
//! and `cargo xtask hard-cases` writes down.

mod naive;
mod rerooted_chain;
mod row;

pub mod attitude;
pub mod chains;
pub mod clock;
pub mod continuous_turns;
pub mod controller;
pub mod descriptions;
pub mod elbow;
pub mod energy;
pub mod engine;
pub mod far_slide;
pub mod friction;
pub mod impedance;
pub mod integrators;
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

pub use row::{Row, Verdict};

#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Case {
    pub number: u32,
    /// The difficulty, in a few words.
    pub name: &'static str,
    /// The numbers that make it hard.
    pub parameters: &'static str,
    /// The source of the case.
    pub source: &'static str,
    /// What knows the right answer.
    pub oracle: &'static str,
    /// Why the bounds are what they are.
    pub reason: &'static str,
    #[serde(skip)]
    pub run: fn() -> Vec<Row>,
}

impl Case {
    /// Measures everything; each row knows its case.
    pub fn rows(&self) -> Vec<Row> {
        let mut rows = (self.run)();
        for row in &mut rows {
            row.case = self.name.into();
            row.number = self.number;
        }
        rows
    }
}

/// The scalar's name.
fn name<R>() -> &'static str {
    std::any::type_name::<R>()
}

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
];

/// The numbers of all cases, as a constant: a program that names [`CASES`] has the code of all of them.
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

/// Runs the case of this number of these cases.
///
/// # Errors
/// As [`demand`].
pub fn demand_of(cases: &[&[Case]], number: u32) -> Result<(), String> {
    let mut cases = cases.iter().copied().flatten();
    let case = cases
        .find(|case| case.number == number)
        .ok_or_else(|| format!("there is no case {number}"))?;
    let rows = case.rows();
    let wrong: Vec<String> = rows.iter().filter_map(|row| row.demand().err()).collect();
    if rows.is_empty() {
        return Err(format!("case {number} measures nothing"));
    }
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(format!("case {number}:\n{}", wrong.join("\n"))),
    }
}
