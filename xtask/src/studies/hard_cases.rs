//! Situations in which dynamics libraries fail, measured on the host.

mod picture;

use serde::{Deserialize, Serialize};

use crate::kit::error::Result;
use crate::kit::host_bin;
use crate::studies::study::{Bench, Found};

const BIN: &str = "hard_cases";

const OVERVIEW: &str = "case | f32: error / bound | f64: error / bound | a naive way beyond the \
                        bound: its error / bound\n--- | ---: | ---: | ---\n";

#[derive(Deserialize)]
struct Suite {
    cases: Vec<Case>,
    rows: Vec<Row>,
    /// The rows that are not as demanded.
    wrong: Vec<String>,
}

#[derive(Deserialize)]
struct Case {
    number: u32,
    name: String,
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
        picture: Some(picture::svg(&suite)?),
        wrong: suite.wrong.clone(),
        summary: summary(&suite),
        ..Found::new(page(&suite), &suite.rows)?
    })
}

impl Row {
    /// The error as a share of its bound; a bound of zero is of a claim, which holds without an
    /// error.
    fn share(&self) -> f64 {
        match (self.error, self.bound) {
            (Some(0.0), _) => 0.0,
            (Some(error), Some(bound)) => error / bound,
            _ => f64::INFINITY,
        }
    }
}

impl Suite {
    /// The row of a case with the largest share of its bound, of those of a scalar, or of the naive
    /// ones.
    fn worst(&self, case: &Case, which: &str) -> Option<&Row> {
        let naive = |row: &&Row| match row.verdict == "shown" {
            true => which == "naive",
            false => which == row.scalar,
        };
        let rows = self.rows.iter().filter(|row| row.number == case.number);
        rows.filter(naive).max_by(|a, b| a.share().total_cmp(&b.share()))
    }

    /// A row for each case.
    fn overview(&self) -> String {
        let share = |row: Option<&Row>| match row.map(Row::share) {
            None => String::new(),
            Some(share) if share > 1e-3 && share < 1e4 => format!("{share:.2}"),
            Some(0.0) => "0".into(),
            Some(share) if share.is_finite() => format!("{share:.1e}"),
            Some(_) => "∞".into(),
        };
        let rows = self.cases.iter().map(|case| {
            let Case { number, name, .. } = case;
            let [single, double] = ["f32", "f64"].map(|which| share(self.worst(case, which)));
            let naive = self.worst(case, "naive").map_or(String::new(), |row| {
                let way = row.quantity.trim_start_matches("naive: ");
                format!("{way}: {}", share(Some(row)))
            });
            format!("{number}. {name} | {single} | {double} | {naive}\n")
        });
        format!("{OVERVIEW}{}", rows.collect::<String>())
    }
}

fn summary(suite: &Suite) -> String {
    let count = |verdict: &str| suite.rows.iter().filter(|r| r.verdict == verdict).count();
    format!(
        "{} cases: {} figures within their bounds, {} beyond; {} failures of naive alternatives \
         shown",
        suite.cases.len(),
        count("pass"),
        count("fail"),
        count("shown")
    )
}

/// The text between the markers.
fn page(suite: &Suite) -> String {
    format!("{}.\n\n{}", summary(suite), suite.overview())
}
