//! Prints the hard cases and all that they measure as JSON: `cargo xtask hard-cases` makes a page
//! of it.

use hard_cases::CASES;
use host_tests::hard::{Case, Row, demand_rows};
use serde::Serialize;

#[derive(Serialize)]
struct Suite {
    cases: Vec<Case>,
    /// The numbers of those that the firmware's bin `bits` has too.
    in_qemu: Vec<u32>,
    rows: Vec<Row>,
    /// The rows that are not as demanded, for each case that has something of the kind.
    wrong: Vec<String>,
}

fn main() {
    let all = CASES.iter().chain(loop_tests::hard::CASES).chain(flexible_tests::hard::CASES);
    let mut cases: Vec<Case> = all.copied().flatten().copied().collect();
    cases.sort_by_key(|case| case.number);
    // 71 to 94 are those that only the suite has.
    let after = |number| if number == 70 { 95 } else { number + 1 };
    let without_gap = cases.windows(2).all(|pair| after(pair[0].number) == pair[1].number);
    assert!(without_gap, "a number of a case is missing, or given twice");
    let (mut rows, mut wrong) = (Vec::new(), Vec::new());
    for case in &cases {
        let of_case = case.rows();
        wrong.extend(demand_rows(case.number, &of_case).err());
        rows.extend(of_case);
    }
    let suite = Suite { cases, in_qemu: fixtures::hard::cases().collect(), rows, wrong };
    println!("{}", serde_json::to_string(&suite).expect("rows are plain data"));
}
