//! Prints the hard cases and all that they measure as JSON: `cargo xtask hard-cases` makes a page of it.

use host_tests::hard::{CASES, Case, Row};
use serde::Serialize;

#[derive(Serialize)]
struct Suite {
    cases: Vec<Case>,
    rows: Vec<Row>,
}

fn main() {
    let mut cases: Vec<Case> = CASES.iter().copied().flatten().copied().collect();
    cases.sort_by_key(|case| case.number);
    let rows = cases.iter().flat_map(Case::rows).collect();
    let suite = Suite { cases, rows };
    println!(
        "{}",
        serde_json::to_string(&suite).expect("rows are plain data")
    );
}
