//! The algorithms that today's replaced, counted on the host and measured on the target.

use xtask::kit::error::{Result, check};
use xtask::kit::firmware::build_meter;
use xtask::kit::rows::{self, Row};
use xtask::kit::shell;
use xtask::kit::table::{Table, thousands};
use xtask::studies::costs::record::{FILE, Record};
use xtask::studies::study::Bench;

use crate::page::Part;
use crate::{MANIFEST, firmware};

const PAGE: &str = "companions/laboratory/docs/history.md";
/// The bin, and the feature that it is built for.
const BIN: &str = "history";

/// The length at which all are compared.
const COMPARED: usize = 6;

/// Inverse dynamics, in the order of the columns, and what they are compared with.
const TORQUES: [(&str, &str); 8] = [
    ("uicker_kahn", "Uicker, Kahn 1965"),
    ("waters", "Waters 1979"),
    ("hollerbach_4", "Hollerbach 1980, 4 × 4"),
    ("hollerbach_3", "Hollerbach 1980, 3 × 3"),
    ("luh_walker_paul", "Luh, Walker, Paul 1980"),
    ("balafoutis_patel", "Balafoutis, Patel, Misra 1988"),
    ("rnea", "RNEA, core"),
    ("engine_rnea", "RNEA, engine, n = 6"),
];

const INERTIA: [(&str, &str); 6] = [
    ("method_1", "method 1"),
    ("method_2", "method 2"),
    ("method_3", "method 3"),
    ("method_4", "method 4"),
    ("crba", "CRBA, core"),
    ("engine_crba", "CRBA, engine, n = 6"),
];

/// Operations of the equations that OpenSYMORO writes on base parameters, without those that no
/// result needs: of RNEA, of M, and of M in a second run by others.
const CUSTOMISED: [(&str, [u64; 3]); 4] = [
    ("ur5e", [444, 311, 277]),
    ("panda", [649, 533, 461]),
    ("iiwa14", [446, 351, 294]),
    ("puma560", [353, 279, 233]),
];

/// The customised symbolic method beside the engine.
fn customised(costs: &Record) -> Result<Table> {
    let mut table = Table::new(&[
        "robot",
        "RNEA, OpenSYMORO",
        "RNEA, engine",
        "M, OpenSYMORO",
        "in another run",
        "M, engine",
    ]);
    for (robot, [rnea, m, again]) in CUSTOMISED {
        let engine = |name| {
            let row = costs.find(&format!("{robot} {name} engine full"));
            let row = row.ok_or_else(|| check!("{FILE}: no {robot} {name}"))?;
            Ok(thousands(row.flops))
        };
        let [rnea, m, again] = [rnea, m, again].map(thousands);
        table.row([robot.into(), rnea, engine("rnea")?, m, again, engine("crba")?]);
    }
    Ok(table)
}

/// Of the firmware's bin, under the meter.
struct Report(Vec<Row>);

/// Counts on the host and runs the firmware's bin under the meter.
pub fn measure(bench: &Bench<'_>) -> Result<Vec<Part>> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let mut count = workspace.cargo("run");
    count.args(["--quiet", "--manifest-path", MANIFEST, "--package", "history"]);
    let counts = shell::capture(count.arg("--target-dir").arg(&workspace.target))?;
    // A line for each algorithm, its key and then its cells; why published and counted differ.
    let (ancestors, differences) = counts
        .split_once("\n\n")
        .ok_or_else(|| check!("`history_counts` printed no differences"))?;
    let (mut build, elf) = firmware(bench, "build", BIN)?;
    shell::capture(&mut build)?;
    let meter = build_meter(workspace)?;
    let costs = Record::read(workspace)?;
    let report = Report(rows::run_for_time(tools, &meter, BIN, &elf)?);
    let part = |name, text| Part { file: PAGE, name, text };
    Ok(vec![
        part("comparison", report.comparison(ancestors)?.markdown()),
        part("customised", customised(&costs)?.markdown()),
        part("torques", report.cycles(&TORQUES).markdown()),
        part("inertia", report.cycles(&INERTIA).markdown()),
        part("differences", differences.to_owned()),
    ])
}

impl Report {
    /// The rows of an algorithm, by length.
    fn of<'a>(&'a self, algorithm: &'a str) -> impl Iterator<Item = &'a Row> {
        self.0.iter().filter(move |row| row.algorithm == algorithm)
    }

    /// An algorithm's row at a length.
    fn at(&self, algorithm: &str, joints: usize) -> Option<&Row> {
        let key = (algorithm, joints);
        self.0.iter().find(|row| (&*row.algorithm, row.joints) == key)
    }

    /// Flops, cycles, and the cycles in relation to those of the core, at [`COMPARED`].
    fn measured(&self, algorithm: &str) -> Result<[String; 3]> {
        let is_torque = TORQUES.iter().any(|(name, _)| *name == algorithm);
        let core = self.at(if is_torque { "rnea" } else { "crba" }, COMPARED);
        let both = self.at(algorithm, COMPARED).zip(core);
        let (row, core) = both.ok_or_else(|| check!("the bin did not measure {algorithm}"))?;
        let ratio = row.cycles.max as f64 / core.cycles.max as f64;
        let [flops, cycles] = [row.flops, row.cycles.max].map(thousands);
        Ok([flops, cycles, format!("{ratio:.2}×")])
    }

    /// All ancestors, then the core and the engine.
    fn comparison(&self, ancestors: &str) -> Result<Table> {
        let head = "year|authors|form|published: products + sums|counted|flops executed|cycles|to \
            the core";
        let mut table = Table::new(&head.split('|').collect::<Vec<_>>());
        for line in ancestors.lines() {
            let mut cells = line.split('|').map(str::to_owned);
            let measured = self.measured(&cells.next().unwrap_or_default())?;
            table.row(cells.chain(measured));
        }
        Ok(table)
    }

    fn cycles(&self, algorithms: &[(&str, &str)]) -> Table {
        let heads = algorithms.iter().map(|(_, head)| *head);
        let mut table = Table::new(&std::iter::once("n").chain(heads).collect::<Vec<_>>());
        for row in self.of(algorithms[0].0) {
            let cost = |(name, _): &(&str, &str)| {
                let row = self.at(name, row.joints);
                row.map_or("–".into(), |row| thousands(row.cycles.max))
            };
            table.row(std::iter::once(row.joints.to_string()).chain(algorithms.iter().map(cost)));
        }
        table
    }
}
