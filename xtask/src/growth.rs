//! `cargo xtask growth`: how the core's algorithms grow with the length of a chain.

pub mod picture;

use std::process::ExitCode;

use crate::bars::{self, Bars, Compared};
use crate::budgets;
use crate::costs::{self, Row};
use crate::docs;
use crate::error::{Result, bail};
use crate::report::MODEL;
use crate::setup::{self, Options, Tools};
use crate::table::{self, Table, thousands};
use crate::toolchain::RELEASE;
use crate::workspace::{self, Workspace};

const BIN: &str = "growth";
const PAGE: &str = "docs/growth.md";
const PICTURE: &str = "docs/growth.svg";
const COMMAND: &str = "cargo xtask growth";

/// In the order of the table's columns; `forward` is bias, M, its factors and their solution.
const ALGORITHMS: [(&str, &str); 5] = [
    ("rnea", "RNEA"),
    ("crba", "CRBA"),
    ("factor_solve", "factor + solve"),
    ("forward_dynamics", "bias + CRBA + factor + solve"),
    ("aba", "ABA"),
];

/// The lengths whose instructions per body are compared.
const ENDS: [usize; 2] = [8, 64];

/// What was measured.
pub struct Report {
    /// A row for each algorithm and length.
    rows: Vec<Row>,
    bars: Bars,
    rustc: String,
}

/// Measures, writes the page and the picture, and prints.
pub fn run(options: Options, json: bool) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let tools = setup::for_demo(options)?;
    let report = measure(&workspace, &tools)?;
    let page = report.markdown();
    workspace::write(&workspace.report(PAGE), &page)?;
    workspace::write(&workspace.report(PICTURE), picture::svg(&report)?)?;
    table::show(json, &report.json(), &page)
}

/// Runs the firmware's bin under the meter.
pub fn measure(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    Ok(Report {
        rows: costs::measure_bins(workspace, tools, RELEASE, &[BIN])?,
        bars: budgets::bars(workspace)?,
        rustc: tools.toolchain.rustc_version()?,
    })
}

/// Fails unless the bars hold and the page is that of the report; else returns the measured figures in words.
pub fn check(workspace: &Workspace, report: &Report) -> Result<String> {
    let compared = report.compared();
    let unmet: Vec<String> = compared.iter().filter_map(Compared::complaint).collect();
    if compared.is_empty() || !unmet.is_empty() {
        let why = unmet.join("\nbar: ");
        bail!("bar: {why}");
    }
    let written = workspace::read(&workspace.root.join(PAGE))?;
    docs::compare(PAGE, COMMAND, &written, &report.markdown(), &report.rustc)?;
    let same_figures = docs::rustc_of(&written) == Some(&report.rustc);
    let picture = picture::svg(report)?;
    docs::compare_picture(workspace, PICTURE, COMMAND, &picture, same_figures)?;
    let figures = compared
        .iter()
        .map(|compared| format!("{} {:.3}", compared.what, compared.measured));
    Ok(figures.collect::<Vec<_>>().join(", "))
}

impl Report {
    /// The lengths, each once.
    fn lengths(&self) -> Vec<usize> {
        let mut lengths: Vec<usize> = self.rows.iter().map(|row| row.joints).collect();
        lengths.dedup();
        lengths
    }

    fn row(&self, algorithm: &str, joints: usize) -> Option<&Row> {
        self.rows
            .iter()
            .find(|row| (&*row.algorithm, row.joints) == (algorithm, joints))
    }

    /// Instructions of an algorithm's call by length.
    fn instructions(&self, algorithm: &str) -> Vec<(usize, u64)> {
        let of = self.rows.iter().filter(|row| row.algorithm == algorithm);
        of.map(|row| (row.joints, row.instructions.max)).collect()
    }

    /// The first length at which articulated bodies take fewer instructions than M and its factors, and
    /// the length where both take as many, between the lengths measured.
    fn crossing(&self) -> Option<(usize, f64)> {
        let pairs: Vec<(f64, f64)> = std::iter::zip(
            self.instructions("aba"),
            self.instructions("forward_dynamics"),
        )
        .map(|((n, aba), (_, forward))| (n as f64, aba as f64 - forward as f64))
        .collect();
        let pair = pairs.windows(2).find(|p| p[0].1 > 0.0 && p[1].1 <= 0.0)?;
        let [(a, above), (b, below)] = [pair[0], pair[1]];
        Some((b as usize, a + (b - a) * above / (above - below)))
    }

    /// Instructions a body of the longest chain against those of the shorter one, where there are bars.
    fn compared(&self) -> Vec<Compared> {
        let ratio = |algorithm: &str| {
            let [short, long] = ENDS.map(|n| {
                let row = self.row(algorithm, n)?;
                Some(row.instructions.max as f64 / n as f64)
            });
            let key = format!("growth, {algorithm} a body, {} / {}", ENDS[1], ENDS[0]);
            Compared::of(&self.bars, &key, "instructions", long? / short?)
        };
        ALGORITHMS
            .iter()
            .filter_map(|(name, _)| ratio(name))
            .collect()
    }

    fn table(&self) -> Table {
        let heads = ALGORITHMS.map(|(_, name)| format!("{name}: insn"));
        let cost = |of: fn(&Row) -> u64| move |row: Option<&Row>| thousands(row.map_or(0, of));
        let insn = cost(|row| row.instructions.max);
        let cycles = cost(|row| row.cycles.max);
        let mut table = Table::new(
            &std::iter::once("bodies")
                .chain(heads.iter().flat_map(|head| [&**head, "cycles"]))
                .collect::<Vec<_>>(),
        );
        for n in self.lengths() {
            let rows = ALGORITHMS.map(|(algorithm, _)| self.row(algorithm, n));
            let costs = rows.into_iter().flat_map(|row| [insn(row), cycles(row)]);
            table.row(std::iter::once(n.to_string()).chain(costs));
        }
        table
    }

    /// Which way is the shorter.
    fn verdict(&self) -> String {
        match self.crossing() {
            Some((first, at)) => format!(
                "Of the lengths measured, ABA needs fewer instructions from n = {first}: the two lines cross at \
                 n = {at:.1}. The literature's figure, by counting flops, is 9."
            ),
            None => "ABA does not overtake within the lengths measured.".to_owned(),
        }
    }

    fn markdown(&self) -> String {
        format!(
            include_str!("growth/page.md"),
            model = MODEL,
            table = self.table().markdown(),
            verdict = self.verdict(),
            short = ENDS[0],
            bars = bars::table(&self.compared()).markdown(),
            rustc = self.rustc
        )
    }

    /// What `--json` prints.
    fn json(&self) -> Vec<serde_json::Value> {
        let rows = self.rows.iter();
        rows.map(|row| {
            serde_json::json!({
                "algorithm": row.algorithm,
                "bodies": row.joints,
                "instructions": row.instructions,
                "cycles": row.cycles,
                "flops": row.flops,
                "stack_bytes": row.stack_bytes,
            })
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Report;
    use crate::bars::{Bar, Bars};
    use crate::costs::Row;
    use crate::meter::Spread;

    fn row(algorithm: &str, joints: usize, instructions: u64) -> Row {
        let spread = Spread {
            min: instructions,
            median: instructions,
            max: instructions,
        };
        Row {
            robot: "chain".into(),
            algorithm: algorithm.into(),
            form: "core".into(),
            inputs: "full".into(),
            trig: false,
            joints,
            instructions: spread,
            cycles: spread,
            cycles_mean: 0.0,
            flops: 0,
            code_bytes: 0,
            stack_bytes: 0,
            address: 0,
        }
    }

    #[test]
    fn the_crossing_is_between_the_lengths_around_it() {
        let bar = Bar {
            most: [("instructions".into(), 1.1)].into(),
            missed: Vec::new(),
        };
        let report = Report {
            rows: vec![
                row("forward_dynamics", 8, 700),
                row("aba", 8, 800),
                row("forward_dynamics", 64, 6_900),
                row("aba", 64, 6_800),
            ],
            bars: Bars::from([("growth, aba a body, 64 / 8".into(), bar)]),
            rustc: String::new(),
        };
        assert_eq!(report.crossing(), Some((64, 36.0)));
        let compared = report.compared();
        assert_eq!(compared.len(), 1);
        assert_eq!(compared[0].measured, 1.0625);
    }
}
