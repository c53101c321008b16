//! Prints the hard cases and all that they measure as JSON: `cargo xtask hard-cases` makes a page of it.

use firmware_demo::hard::{SINGLE, loops};
use host_tests::hard::{CASES, Case, Row};
use serde::Serialize;

#[derive(Serialize)]
struct Suite {
    cases: Vec<Case>,
    /// The numbers of those that the firmware's bin `bits` has too.
    in_qemu: Vec<u32>,
    rows: Vec<Row>,
}

fn main() {
    let all = CASES.iter().chain(loop_tests::hard::CASES);
    let mut cases: Vec<Case> = all.copied().flatten().copied().collect();
    cases.sort_by_key(|case| case.number);
    let rows = cases.iter().flat_map(Case::rows).collect();
    let mut in_qemu: Vec<u32> = SINGLE.iter().map(|problem| problem.case).collect();
    in_qemu.extend(loops::PROBLEMS.iter().map(|problem| problem.case));
    in_qemu.push(loops::RIG.case);
    in_qemu.dedup();
    let suite = Suite {
        cases,
        in_qemu,
        rows,
    };
    println!(
        "{}",
        serde_json::to_string(&suite).expect("rows are plain data")
    );
}
