//! The algorithms that today's replaced, counted on the host and measured on the target.

use crate::kit::error::{Result, check};
use crate::kit::meter::MODEL;
use crate::kit::rows::{self, Row};
use crate::kit::table::{Table, thousands};
use crate::kit::toolchain::RELEASE;
use crate::kit::{firmware, host_bin::SHARED};
use crate::studies::costs::{self, record::Record};
use crate::studies::study::{Bench, Found};

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

/// The least arithmetic published for a general arm of six joints, flops, sines and cosines aside.
pub const LEAST_PUBLISHED: [(&str, u64); 3] = [("rnea", 836), ("crba", 855), ("aba", 2067)];

/// Operations of the equations that OpenSYMORO writes on base parameters, without those that no
/// result needs: of RNEA, of M, and of M in a second run by others.
const CUSTOMISED: [(&str, [u64; 3]); 4] = [
    ("ur5e", [444, 311, 277]),
    ("panda", [649, 533, 461]),
    ("iiwa14", [446, 351, 294]),
    ("puma560", [353, 279, 233]),
];

/// What [`LEAST_PUBLISHED`] says, in words.
pub fn least_published() -> String {
    LEAST_PUBLISHED
        .map(|(name, flops)| format!("{} {}", name.to_uppercase(), thousands(flops)))
        .join(", ")
}

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
            let row = row.ok_or_else(|| check!("{}: no {robot} {name}", costs::record::FILE))?;
            Ok(thousands(row.flops))
        };
        let [rnea, m, again] = [rnea, m, again].map(thousands);
        table.row([robot.into(), rnea, engine("rnea")?, m, again, engine("crba")?]);
    }
    Ok(table)
}

struct Report {
    /// The customised symbolic method, as a table.
    customised: String,
    rows: Vec<Row>,
    /// A line for each algorithm: its key, then its cells.
    ancestors: String,
    /// Why published and counted operations differ.
    differences: String,
    rustc: String,
}

/// Counts on the host and runs the firmware's bin under the meter.
pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let counts = SHARED.text(workspace, "history_counts")?;
    let (ancestors, differences) = counts
        .split_once("\n\n")
        .ok_or_else(|| check!("`history_counts` printed no differences"))?;
    let elves = firmware::build_with(workspace, tools.toolchain, RELEASE, BIN, &[BIN], None)?;
    let meter = firmware::build_meter(workspace)?;
    let costs = Record::read(workspace)?;
    let report = Report {
        customised: customised(&costs)?.markdown(),
        rows: rows::run_for_time(tools, &meter, BIN, &elves[0], "")?,
        ancestors: ancestors.into(),
        differences: differences.trim_end().into(),
        rustc: bench.rustc()?,
    };
    Found::new(report.markdown()?, &report.rows)
}

impl Report {
    /// The rows of an algorithm, by length.
    fn of<'a>(&'a self, algorithm: &'a str) -> impl Iterator<Item = &'a Row> {
        self.rows.iter().filter(move |row| row.algorithm == algorithm)
    }

    /// An algorithm's row at a length.
    fn at(&self, algorithm: &str, joints: usize) -> Option<&Row> {
        let key = (algorithm, joints);
        self.rows.iter().find(|row| (&*row.algorithm, row.joints) == key)
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
    fn comparison(&self) -> Result<Table> {
        let head = "year|authors|form|published: products + sums|counted|flops executed|cycles|to \
            the core";
        let mut table = Table::new(&head.split('|').collect::<Vec<_>>());
        for line in self.ancestors.lines() {
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

    /// The ancestors that take fewer cycles than the core over this number of links, each with its
    /// share of them.
    fn fewer_at(&self, joints: usize) -> Vec<String> {
        let cycles = |key: &str| self.at(key, joints).map(|row| row.cycles.max as f64);
        let of = |all: &[(&str, &str)], core: &str| -> Vec<String> {
            let each = all.iter().filter(|(key, _)| !key.starts_with("engine"));
            let shares = each.filter_map(|(key, name)| Some((cycles(key)? / cycles(core)?, name)));
            let fewer = shares.filter(|(share, _)| *share < 1.0);
            fewer.map(|(share, name)| format!("{name} {share:.3}")).collect()
        };
        [of(&TORQUES, "rnea"), of(&INERTIA, "crba")].concat()
    }

    /// Which ancestors take fewer cycles than the core, at [`COMPARED`] and over the other chains.
    fn fewer(&self) -> String {
        let core = "this library's core over a model that is read at run time";
        let names = self.fewer_at(COMPARED);
        let compared = match names.is_empty() {
            true => format!(
                "No ancestor takes fewer cycles for it\nthan {core}, although each prepares \
                 constants of the links beforehand."
            ),
            false => format!(
                "Of the ancestors, which prepare constants of the links\nbeforehand, fewer cycles \
                 than {core} are taken by: {}.",
                names.join("; ")
            ),
        };
        let others = self.of("rnea").filter(|row| row.joints != COMPARED);
        let others = others.map(|row| (row.joints, self.fewer_at(row.joints)));
        let others = others.filter(|(_, names)| !names.is_empty());
        let others = others.map(|(n, names)| format!("{n} links, {}", names.join(", ")));
        match others.collect::<Vec<_>>().join("; ") {
            none if none.is_empty() => {
                format!("{compared} Nor does one for shorter or longer chains.")
            }
            others => format!(
                "{compared} Over chains of\nother lengths an ancestor takes fewer, as a share of \
                 the core's: {others}."
            ),
        }
    }

    fn markdown(&self) -> Result<String> {
        let [rnea, _, _] = self.measured("engine_rnea")?;
        let [crba, _, _] = self.measured("engine_crba")?;
        Ok(format!(
            include_str!("history/page.md"),
            least = least_published(),
            rnea = rnea,
            crba = crba,
            customised = self.customised,
            model = MODEL,
            compared = COMPARED,
            fewer = self.fewer(),
            comparison = self.comparison()?.markdown(),
            torques = self.cycles(&TORQUES).markdown(),
            inertia = self.cycles(&INERTIA).markdown(),
            differences = self.differences,
            rustc = self.rustc
        ))
    }
}
