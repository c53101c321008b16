//! The growth of the core's algorithms with the length of a chain.

use crate::kit::bars::{self, Bars, Compared};
use crate::kit::chart::{self, HPos};
use crate::kit::error::Result;
use crate::kit::meter::MODEL;
use crate::kit::rows::{self, Row};
use crate::kit::table::{Table, thousands};
use crate::kit::toolchain::RELEASE;
use crate::studies::budgets;
use crate::studies::study::{Bench, Found};

const BIN: &str = "growth";

/// The crossing in the literature, bodies.
const LITERATURE: f64 = 9.0;

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

struct Report {
    /// A row for each algorithm and length.
    rows: Vec<Row>,
    bars: Bars,
    rustc: String,
}

/// Runs the firmware's bin under the meter.
pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let report = Report {
        rows: rows::measure(bench.workspace, bench.tools()?, RELEASE, &[BIN])?,
        bars: budgets::bars(bench.workspace)?,
        rustc: bench.rustc()?,
    };
    let compared = report.compared();
    let mut wrong: Vec<String> = compared.iter().filter_map(Compared::complaint).collect();
    if compared.is_empty() {
        wrong.push("none has a figure".into());
    }
    let figures = compared
        .iter()
        .map(|one| format!("{} {:.3}", one.what, one.measured));
    Ok(Found {
        picture: Some(report.picture()?),
        rustc: Some(report.rustc.clone()),
        wrong,
        summary: figures.collect::<Vec<_>>().join(", "),
        ..Found::new(report.markdown(), &report.json())?
    })
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

    /// The sentence about the crossing.
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

    fn picture(&self) -> Result<String> {
        let curves = ALGORITHMS.map(|(name, title)| (title, self.instructions(name)));
        let literature = " crossing in the literature: 9".to_owned();
        let mut marks = vec![(LITERATURE, literature, HPos::Left)];
        if let Some((_, at)) = self.crossing() {
            marks.push((at, format!("crossing here: {at:.1} "), HPos::Right));
        }
        let title = "Instructions of a call against bodies of a chain (core, model at run time, Cortex-M4F)";
        chart::curves(title, "instructions", &curves, &marks)
    }

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
    use crate::kit::bars::{Bar, Bars};
    use crate::kit::rows::Row;

    fn row(algorithm: &str, joints: usize, instructions: u64) -> Row {
        let row = Row::sample(["chain", algorithm, "core", "full"], instructions);
        Row { joints, ..row }
    }

    #[test]
    fn the_crossing_is_between_the_lengths_around_it() {
        let bar = Bar::of([("instructions", 1.1)]);
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
