//! What was measured, as tables, as JSON and as the page in the docs.

use serde::{Deserialize, Serialize};

use crate::bars::{self, Compared};
use crate::peers::ALGORITHMS;
use crate::report::MODEL;
use crate::table::{Table, thousands};

/// The processor that runs xtask.
pub const HOST: &str = "host";
/// The emulated one.
pub const M4F: &str = "cortex-m4f";

const COMMAND: &str = "cargo xtask peers";

/// A measurement. Its fields, but for those that are skipped, are those of the JSON.
#[derive(Debug, Default, Deserialize, Serialize)]
pub struct Row {
    /// [`HOST`] or [`M4F`].
    #[serde(skip_deserializing)]
    pub target: &'static str,
    /// The robot's name.
    pub robot: String,
    /// One of [`ALGORITHMS`].
    pub algorithm: String,
    /// Whose code, and how it was compiled.
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

/// Everything that is printed.
pub struct Report {
    /// The measurements.
    pub rows: Vec<Row>,
    /// The bars among them.
    pub compared: Vec<Compared>,
    /// What was measured with what.
    pub versions: Vec<String>,
    /// The day of the run, and the commit.
    pub date: String,
}

const ON_TARGET: &str = "f32, sines and cosines computed outside; instructions are exact, cycles modelled. \
    `casadi clang` has our CPU flags and is outside the bars.";
const ON_HOST: &str = "Nanoseconds a state, sines and cosines included.";

impl Report {
    /// For the docs.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "# Peers\n\n<!-- written by `{COMMAND}`: do not edit -->\n\n\
             The same robots, from the same numbers, by other libraries and by this one, measured \
             in one run on {}. Every function was compared with what Pinocchio recorded before it \
             was timed: on the host within 1e-12 of full scale in f64, 1e-5 in f32 (forward dynamics \
             1e-11 and 1e-3). On the target, every function was compared once more, with our core, within \
             1e-5 and 1e-3.\n\nTarget: {MODEL}. The code of a function is its instructions \
             and literals and those of what it calls.\n\n{}\n",
            self.date, ABOUT
        );
        for algorithm in ALGORITHMS {
            let table = self.on_target(algorithm).markdown();
            text += &format!("\n## Cortex-M4F: {algorithm}\n\n{ON_TARGET}\n\n{table}");
        }
        for algorithm in ALGORITHMS {
            let table = self.on_host(algorithm).markdown();
            text += &format!("\n## Host: {algorithm}\n\n{ON_HOST}\n\n{table}");
        }
        text += &format!(
            "\n## Against the bars\n\nWhat was promised, from `budgets.toml`: against the better build of \
             CasADi's C and the better compiler of Pinocchio.\n\n{}",
            bars::table(&self.compared).markdown()
        );
        text += "\n## Versions\n\n";
        for version in &self.versions {
            text += &format!("- {version}\n");
        }
        text
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

const ABOUT: &str = "\
- **casadi**: C that CasADi generates from Pinocchio's algorithms for one robot, all constants folded;
  f32 with its sines and literals made f32, called through a function whose pointers may not be null,
  which lets the compiler drop CasADi's tests for that. On the host with `-O3
  -march=native`, on the target with `-O3` and the named flags, there the better of two: whether or
  not `restrict` says that inputs and output do not overlap.
- **pinocchio**: its C++ templates, `-O3 -march=native -DNDEBUG`, model loaded at run time.
- **mujoco**: f64, as its maker compiles it. `mj_inverse` is what a user calls, MuJoCo's whole
  pipeline of inverse dynamics. `mj_rne` is the least that gives the torques: `mj_kinematics`, `mj_comPos`,
  `mj_comVel`, `mj_rne`. Contacts and constraints are off.
- **dynibo**: a Rust crate; f64, model read from a URDF at run time, gravity fixed at 9.80665 m/s².
- **core**, **engine**: this library's two forms, with `-C target-cpu=native` on the host; **core run-time
  model**: the core over a model of which the compiler knows nothing, as Pinocchio's and dynibo's are.

Every algorithm gives what a user asks for: `aba` stands for forward dynamics by whatever way is the
library's best: the articulated-body algorithm, but for `engine` and MuJoCo (`mj_solveM`: the stages that
accelerations need) bias, M, its factors and their solution. On the host M is written as a square, by CasADi as
one triangle; Pinocchio fills one triangle of it.";
