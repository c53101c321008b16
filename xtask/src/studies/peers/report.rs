//! The measurements, as tables, as JSON and as the page in the docs.

use serde::{Deserialize, Serialize};

use crate::kit::bars::{self, Compared};
use crate::kit::meter::MODEL;
use crate::kit::table::{Table, thousands};
use crate::studies::peers::ALGORITHMS;

/// The processor that runs xtask.
pub const HOST: &str = "host";
pub const M4F: &str = "cortex-m4f";

/// A measurement. Its fields, but for those that are skipped, are those of the JSON.
#[derive(Debug, Default, Deserialize, Serialize)]
pub struct Row {
    /// [`HOST`] or [`M4F`].
    #[serde(skip_deserializing)]
    pub target: &'static str,
    pub robot: String,
    /// One of [`ALGORITHMS`].
    pub algorithm: String,
    /// The author of the code, and its compiler.
    pub peer: String,
    /// `f32` or `f64`.
    pub precision: String,
    /// Median nanoseconds a state, on the host, sines and cosines included.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ns: Option<f64>,
    /// Modelled cycles on the target, with sines and cosines computed before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cycles: Option<u64>,
    /// Instructions and literals of the function and what it calls; not known on the host.
    pub code_bytes: Option<u64>,
    /// Instructions executed, on the target.
    #[serde(skip)]
    pub instructions: Option<u64>,
}

pub struct Report {
    pub rows: Vec<Row>,
    pub compared: Vec<Compared>,
    pub versions: Vec<String>,
    /// The day of the run, and the commit.
    pub date: String,
}

const ON_TARGET: &str = "f32, sines and cosines computed outside; instructions are exact, \
    cycles modelled. `casadi clang` has our CPU flags and is outside the bars.";
const ON_HOST: &str = "Nanoseconds a state, sines and cosines included.";

impl Report {
    pub fn markdown(&self) -> String {
        let section = |target: &str, what: &str, table: &dyn Fn(&str) -> Table| {
            let tables = ALGORITHMS.map(|algorithm| {
                let table = table(algorithm).markdown();
                format!("\n## {target}: {algorithm}\n\n{what}\n\n{table}")
            });
            tables.concat()
        };
        let versions = self.versions.iter().map(|version| format!("- {version}\n"));
        format!(
            include_str!("page.md"),
            date = self.date,
            model = MODEL,
            target = section("Cortex-M4F", ON_TARGET, &|algorithm| self
                .on_target(algorithm)),
            host = section("Host", ON_HOST, &|algorithm| self.on_host(algorithm)),
            bars = bars::table(&self.compared).markdown(),
            versions = versions.collect::<String>()
        )
    }

    pub fn loops(&self) -> String {
        let versions = self.versions.iter().map(|version| format!("- {version}\n"));
        format!(
            include_str!("loops.md"),
            date = self.date,
            inverse = self.in_a_row("loops inverse").markdown(),
            forward = self.in_a_row("loops forward").markdown(),
            versions = versions.collect::<String>(),
        )
    }

    /// Times, and their ratios to Pinocchio's by its better compiler.
    fn in_a_row(&self, algorithm: &str) -> Table {
        let best = |robot: &str| {
            let rows = self.of(HOST, algorithm).filter(|row| row.robot == robot);
            let theirs = rows.filter(|row| row.peer.starts_with("pinocchio"));
            theirs.filter_map(|row| row.ns).min_by(f64::total_cmp)
        };
        let text =
            |value: Option<f64>, digits| value.map_or("–".into(), |x| format!("{x:.digits$}"));
        Table::of(
            self.of(HOST, algorithm),
            &[
                ("robot, code", &|row| format!("{}, {}", row.robot, row.peer)),
                ("ns", &|row| text(row.ns, 1)),
                ("this / pinocchio", &|row| {
                    text(row.ns.zip(best(&row.robot)).map(|(a, b)| a / b), 2)
                }),
            ],
        )
    }

    fn on_target(&self, algorithm: &str) -> Table {
        let number = |value: Option<u64>| value.map_or("–".into(), thousands);
        let ratio = |row: &Row| {
            let mut rows = self.of(M4F, algorithm);
            let engine = rows.find(|other| other.robot == row.robot && other.peer == "engine")?;
            Some(format!("{:.2}", engine.cycles? as f64 / row.cycles? as f64))
        };
        Table::of(
            self.of(M4F, algorithm),
            &[
                ("robot, code", &|row| format!("{}, {}", row.robot, row.peer)),
                ("instructions", &|row| number(row.instructions)),
                ("cycles", &|row| number(row.cycles)),
                ("bytes", &|row| number(row.code_bytes)),
                ("engine / this", &|row| ratio(row).unwrap_or("–".into())),
            ],
        )
    }

    fn on_host(&self, algorithm: &str) -> Table {
        let mut lines: Vec<&Row> = Vec::new();
        for row in self.of(HOST, algorithm) {
            if !lines
                .iter()
                .any(|line| (&line.robot, &line.peer) == (&row.robot, &row.peer))
            {
                lines.push(row);
            }
        }
        // By robot, which the two precisions of a peer interrupt.
        let robots: Vec<&String> = lines.iter().map(|line| &line.robot).collect();
        lines.sort_by_key(|line| robots.iter().position(|robot| **robot == line.robot));
        let time = |line: &Row, precision| {
            let mut rows = self.of(HOST, algorithm);
            let of = (&line.robot, &line.peer, precision);
            let row = rows.find(|row| (&row.robot, &row.peer, &*row.precision) == of);
            let ns = row.and_then(|row| row.ns);
            ns.map_or("–".into(), |ns| format!("{ns:.1}"))
        };
        Table::of(
            lines,
            &[
                ("robot, code", &|line| {
                    format!("{}, {}", line.robot, line.peer)
                }),
                ("f64", &|line| time(line, "f64")),
                ("f32", &|line| time(line, "f32")),
            ],
        )
    }

    fn of<'a>(&'a self, target: &'a str, algorithm: &'a str) -> impl Iterator<Item = &'a Row> {
        self.rows
            .iter()
            .filter(move |row| (row.target, &*row.algorithm) == (target, algorithm))
    }
}
