//! The measurements as tables.

use serde::Deserialize;

use xtask::kit::table::{Table, thousands};

use crate::page::Part;
use crate::peers::ways::{self, INSIDE, WAYS};
use crate::peers::{ALGORITHMS, GRADIENT};

/// The processor that runs xtask.
pub const HOST: &str = "host";
pub const M4F: &str = "cortex-m4f";
/// A RISC-V core with an FPU of 0, 1 and 2 stages.
pub const GATES: [&str; 3] = ["cv32e40p, 0 stages", "cv32e40p, 1 stage", "cv32e40p, 2 stages"];

/// A measurement; those on the host are read from the lines that the bench prints.
#[derive(Debug, Default, Deserialize)]
pub struct Row {
    /// [`HOST`], [`M4F`] or one of [`GATES`].
    #[serde(skip)]
    pub target: &'static str,
    pub robot: String,
    /// One of [`ALGORITHMS`].
    pub algorithm: String,
    /// The author of the code, and its compiler.
    pub peer: String,
    /// `f32` or `f64`.
    pub precision: String,
    /// Median nanoseconds a state, on the host, sines and cosines included.
    pub ns: Option<f64>,
    /// The same in each run.
    #[serde(skip)]
    pub runs: Vec<f64>,
    /// The median over the runs of the time of each of [`OURS`] divided by this one's.
    #[serde(skip)]
    pub ratios: [Option<f64>; 3],
    /// Modelled cycles on the target, counted ones on the gates, with sines and cosines computed
    /// before.
    pub cycles: Option<u64>,
    /// How C was compiled for the gates: one of [`WAYS`].
    #[serde(skip)]
    pub way: String,
    /// Instructions and literals of the function and what it calls; not known on the host.
    pub code_bytes: Option<u64>,
    /// Instructions executed, on the target.
    #[serde(skip)]
    pub instructions: Option<u64>,
}

/// Ours that others are compared with on the host.
pub const OURS: [&str; 3] = ["engine", "core run-time model", FUSED];
/// The engine in a program whose arithmetic is fused, as that of the others is.
pub const FUSED: &str = "engine fused";

fn median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied()
}

/// The median of the ratios of two rows, run by run.
fn ratio(a: &Row, b: &Row) -> Option<f64> {
    let pairs = std::iter::zip(&a.runs, &b.runs);
    median(pairs.map(|(a, b)| a / b).collect())
}

/// One row for the rows of a function in all runs, with the ratios of ours to it.
pub fn of_runs(all: Vec<Row>) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for row in all {
        let times = row.ns.into_iter();
        match rows.iter_mut().find(|other| other.is_of(&row, &row.peer)) {
            Some(other) => other.runs.extend(times),
            None => rows.push(Row { runs: times.collect(), ..row }),
        }
    }
    let ratios = rows.iter().map(|row| {
        let ours = OURS.map(|ours| rows.iter().find(|other| other.is_of(row, ours)));
        ours.map(|ours| ratio(ours?, row))
    });
    let ratios: Vec<_> = ratios.collect();
    for (row, ratios) in std::iter::zip(&mut rows, ratios) {
        (row.ns, row.ratios) = (median(row.runs.clone()), ratios);
    }
    rows
}

/// The rows of a program with the engine of another one, whose arithmetic is fused: that one ran the
/// others' functions, too, and its engine is compared with those times.
pub fn with_fused(mut rows: Vec<Row>, fused: Vec<Row>) -> Vec<Row> {
    for mut row in fused {
        let Some(at) = rows.iter().position(|other| other.is_of(&row, &row.peer)) else {
            continue;
        };
        let ratio = row.ratios[0];
        if row.peer == OURS[0] {
            (row.peer, row.ratios) = (FUSED.to_owned(), [None, None, ratio]);
            rows.insert(at + 1, row);
        } else if !row.peer.contains("core") {
            rows[at].ratios[2] = ratio;
        }
    }
    rows
}

impl Row {
    /// Whether it is of this code, and else of what `row` is.
    fn is_of(&self, row: &Row, peer: &str) -> bool {
        self.peer == peer
            && (self.target, &self.robot) == (row.target, &row.robot)
            && (&self.algorithm, &self.precision) == (&row.algorithm, &row.precision)
    }
}

/// A function, and the seconds of a release build of the firmware with it.
pub type Build = (String, f64);

pub struct Report {
    pub rows: Vec<Row>,
    /// The seconds of builds of firmware with one function.
    pub builds: Vec<Build>,
    pub versions: Vec<String>,
}

const ON_GATES: &str = "Counted cycles, f32, sines and cosines computed outside unless said; ways to \
    compile the C are named for each number of stages.";

fn text(value: Option<f64>, digits: usize) -> String {
    value.map_or("–".into(), |x| format!("{x:.digits$}"))
}

fn number(value: Option<u64>) -> String {
    value.map_or("–".into(), thousands)
}

const ON_TARGET: &str = "f32, sines and cosines computed outside; instructions are exact, \
    cycles modelled. `casadi clang` has our CPU flags.";
const ON_HOST: &str =
    "Nanoseconds a state, sines and cosines included, and the times of ours divided by this one's.";

impl Report {
    pub fn parts(&self) -> Vec<Part> {
        let section = |target: &str, what: &str, table: &dyn Fn(&str) -> Table, all: &[&str]| {
            let tables = all.iter().map(|algorithm| {
                let table = table(algorithm).markdown();
                format!("\n## {target}: {algorithm}\n\n{what}\n\n{table}")
            });
            tables.collect::<String>()
        };
        let list = |lines: &[String]| lines.iter().map(|line| format!("- {line}\n")).collect();
        let ways = WAYS.map(|(way, flags)| format!("{way}: `{flags}`"));
        let on_host = [&ALGORITHMS[..], &[GRADIENT]].concat();
        let parts = [
            ("target", section("Cortex-M4F", ON_TARGET, &|a| self.on_target(a), &ALGORITHMS)),
            ("ways", list(&ways)),
            ("gates", section("CV32E40P", ON_GATES, &|a| self.on_gates(a), &ways::ALGORITHMS)),
            ("host", section("Host", ON_HOST, &|a| self.on_host(a), &on_host)),
            ("builds", self.build_times().markdown()),
            ("versions", list(&self.versions)),
        ];
        let page = "companions/laboratory/docs/peers.md";
        parts.map(|(name, text)| Part { file: page, name, text }).into()
    }

    fn build_times(&self) -> Table {
        Table::of(
            &self.builds,
            &[
                ("robot, function", &|(function, _)| function.clone()),
                ("s", &|(_, seconds)| format!("{seconds:.1}")),
            ],
        )
    }

    fn on_target(&self, algorithm: &str) -> Table {
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

    fn on_gates(&self, algorithm: &str) -> Table {
        let row = |robot: &str, peer: &str, stages: usize| {
            self.of(GATES[stages], algorithm).find(|row| (&*row.robot, &*row.peer) == (robot, peer))
        };
        let ratio = |line: &Row, stages| {
            // The engine with the same arithmetic and sines.
            let arithmetic = if line.peer.contains("separate") { "separate" } else { "fused" };
            let inside = if line.peer.ends_with(INSIDE) { INSIDE } else { "" };
            let engine =
                row(&line.robot, &format!("engine {arithmetic}{inside}"), stages)?.cycles?;
            let this = row(&line.robot, &line.peer, stages)?.cycles?;
            Some(engine as f64 / this as f64)
        };
        let cycles = |line: &Row, stages| {
            number(row(&line.robot, &line.peer, stages).and_then(|row| row.cycles))
        };
        let ways = |line: &Row| {
            let ways =
                [0, 1, 2].map(|k| row(&line.robot, &line.peer, k).map_or("", |row| &row.way));
            ways.join(" ")
        };
        let mut lines: Vec<&Row> = self.of(GATES[0], algorithm).collect();
        lines.sort_by_key(|line| {
            let robot = ways::ROBOTS.iter().position(|robot| *robot == line.robot);
            (robot, line.peer.ends_with(INSIDE), line.peer.contains("separate"))
        });
        Table::of(
            lines,
            &[
                ("robot, code", &|line| format!("{}, {}", line.robot, line.peer)),
                ("0 stages", &|line| cycles(line, 0)),
                ("1 stage", &|line| cycles(line, 1)),
                ("2 stages", &|line| cycles(line, 2)),
                ("engine / this, 0", &|line| text(ratio(line, 0), 2)),
                ("1", &|line| text(ratio(line, 1), 2)),
                ("2", &|line| text(ratio(line, 2), 2)),
                ("ways", &ways),
            ],
        )
    }

    fn on_host(&self, algorithm: &str) -> Table {
        let mut lines: Vec<&Row> = Vec::new();
        for row in self.of(HOST, algorithm) {
            if !lines.iter().any(|line| (&line.robot, &line.peer) == (&row.robot, &row.peer)) {
                lines.push(row);
            }
        }
        // By robot, which the two precisions of a peer interrupt.
        let robots: Vec<&String> = lines.iter().map(|line| &line.robot).collect();
        lines.sort_by_key(|line| robots.iter().position(|robot| **robot == line.robot));
        let in_precision = |line: &Row, precision| {
            let mut rows = self.of(HOST, algorithm);
            let of = (&line.robot, &line.peer, precision);
            rows.find(|row| (&row.robot, &row.peer, &*row.precision) == of)
        };
        let time =
            |line: &Row, precision| text(in_precision(line, precision).and_then(|row| row.ns), 1);
        let ratio = |line: &Row, ours: usize, precision| {
            text(in_precision(line, precision).and_then(|row| row.ratios[ours]), 3)
        };
        Table::of(
            lines,
            &[
                ("robot, code", &|line| format!("{}, {}", line.robot, line.peer)),
                ("f64", &|line| time(line, "f64")),
                ("f32", &|line| time(line, "f32")),
                ("engine / this, f64", &|line| ratio(line, 0, "f64")),
                ("f32", &|line| ratio(line, 0, "f32")),
                ("engine fused / this, f64", &|line| ratio(line, 2, "f64")),
                ("f32", &|line| ratio(line, 2, "f32")),
                ("core run-time / this, f64", &|line| ratio(line, 1, "f64")),
                ("f32", &|line| ratio(line, 1, "f32")),
            ],
        )
    }

    fn of<'a>(&'a self, target: &'a str, algorithm: &'a str) -> impl Iterator<Item = &'a Row> {
        self.rows.iter().filter(move |row| (row.target, &*row.algorithm) == (target, algorithm))
    }
}

#[cfg(test)]
mod tests {
    use super::{FUSED, Row, of_runs, with_fused};

    #[test]
    fn a_ratio_is_the_median_of_those_of_the_runs() {
        let row = |peer: &str, ns| Row { peer: peer.into(), ns: Some(ns), ..Row::default() };
        // A slow machine in the second run, a disturbed engine in the third.
        let runs = [[10.0, 100.0], [20.0, 200.0], [90.0, 100.0]];
        let all = runs.map(|[ours, theirs]| [row("engine", ours), row("casadi gcc", theirs)]);
        let rows = of_runs(all.into_iter().flatten().collect());
        let [engine, casadi] = &rows[..] else { panic!("two functions") };
        assert_eq!((engine.ns, casadi.ns), (Some(20.0), Some(100.0)));
        assert_eq!(engine.ratios, [Some(1.0), None, None]);
        assert_eq!(casadi.ratios, [Some(0.1), None, None]);
        // In the other program the engine takes half of that, and the disturbances are others.
        let fused = of_runs(vec![row("engine", 7.0), row("casadi gcc", 140.0)]);
        let rows = with_fused(rows, fused);
        let found: Vec<_> = rows.iter().map(|row| (&*row.peer, row.ratios)).collect();
        let fused = [None, None, Some(1.0)];
        assert_eq!(found[1..], [(FUSED, fused), ("casadi gcc", [Some(0.1), None, Some(0.05)])]);
    }
}
