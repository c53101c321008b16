//! Situations in which dynamics libraries fail, measured on the host.

use serde::{Deserialize, Serialize};

use crate::kit::error::Result;
use crate::kit::host_bin;
use crate::studies::study::{Bench, Found};

const BIN: &str = "hard_cases";

const HEAD: &str = "
| quantity | κ | error, f32 | bound | error, f64 | bound | verdict |
| --- | ---: | ---: | ---: | ---: | ---: | --- |
";

#[derive(Deserialize)]
struct Suite {
    cases: Vec<Case>,
    /// The numbers of the cases that the step `bits` runs in QEMU.
    in_qemu: Vec<u32>,
    rows: Vec<Row>,
    /// What is not as demanded.
    wrong: Vec<String>,
}

#[derive(Deserialize)]
struct Case {
    number: u32,
    name: String,
    parameters: String,
    source: String,
    oracle: String,
    reason: String,
}

/// A measurement; a value that is not finite is `None`.
#[derive(Deserialize, Serialize)]
struct Row {
    case: String,
    number: u32,
    quantity: String,
    scalar: String,
    error: Option<f64>,
    bound: Option<f64>,
    condition: Option<f64>,
    verdict: String,
}

pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let suite: Suite = host_bin::json(bench.workspace, BIN)?;
    Ok(Found {
        wrong: suite.wrong.clone(),
        summary: summary(&suite),
        brief: Some(brief(&suite)),
        ..Found::new(page(&suite), &suite.rows)?
    })
}

fn summary(suite: &Suite) -> String {
    let count = |verdict: &str| suite.rows.iter().filter(|r| r.verdict == verdict).count();
    format!(
        "{} cases: {} figures within their bounds, {} beyond; {} failures of naive alternatives shown",
        suite.cases.len(),
        count("pass"),
        count("fail"),
        count("shown")
    )
}

/// The README's lines.
fn brief(suite: &Suite) -> String {
    let count = |verdict: &str| suite.rows.iter().filter(|r| r.verdict == verdict).count();
    format!(
        "{} cases in f32 and f64, against computations in 50 digits and closed forms: {} figures are within their bounds, {} beyond,\n\
         and {} naive methods are shown to fail ([each case](docs/hard-cases.md)).",
        suite.cases.len(),
        count("pass"),
        count("fail"),
        count("shown")
    )
}

/// The text between the markers.
fn page(suite: &Suite) -> String {
    let mut text = format!("{}.\n", summary(suite));
    for case in &suite.cases {
        let rows: Vec<&Row> = (suite.rows.iter())
            .filter(|row| row.number == case.number)
            .collect();
        let Case { number, name, .. } = case;
        text += &format!("\n### {number}. {name}\n\n");
        for (label, text_of_case) in [
            ("Parameters", &case.parameters),
            ("Source", &case.source),
            ("Oracle", &case.oracle),
            ("Bound", &case.reason),
        ] {
            text += &format!("- {label}: {text_of_case}.\n");
        }
        if suite.in_qemu.contains(number) {
            text += "- In QEMU: every algorithm gives the same bits in f32.\n";
        }
        text += HEAD;
        let mut written: Vec<&str> = Vec::new();
        for row in &rows {
            if !written.contains(&&*row.quantity) {
                written.push(&row.quantity);
                text += &line(&rows, &row.quantity);
            }
        }
    }
    text.trim_end().to_owned()
}

/// The measurements of one quantity, in f32 and in f64.
fn line(rows: &[&Row], quantity: &str) -> String {
    let of_quantity = || rows.iter().filter(|row| row.quantity == quantity);
    let figures = |scalar: &str| match of_quantity().find(|row| row.scalar == scalar) {
        Some(row) => format!(
            "{} | {}",
            figure(row.error, "no number"),
            figure(row.bound, "none")
        ),
        None => " | ".into(),
    };
    let condition = of_quantity().find_map(|row| row.condition);
    let condition = condition.map_or(String::new(), |k| format!("{k:.1e}"));
    let has = |verdict: &str| of_quantity().any(|row| row.verdict == verdict);
    let verdict = match (has("fail"), has("shown")) {
        (true, _) => "fails",
        (false, true) => "breaks, as shown",
        (false, false) => "pass",
    };
    let (single, double) = (figures("f32"), figures("f64"));
    format!("| {quantity} | {condition} | {single} | {double} | {verdict} |\n")
}

fn figure(x: Option<f64>, none: &str) -> String {
    match x {
        None => none.into(),
        Some(0.0) => "0".into(),
        Some(x) => format!("{x:.1e}"),
    }
}
