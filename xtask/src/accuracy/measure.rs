//! Builds and runs: bins in QEMU for costs, a bin on the host for errors.

use std::path::PathBuf;

use super::join::{self, Host};
use super::point::Point;
use super::printed::{self, PRINTED};
use crate::costs::{self, Row};
use crate::error::{Error, Result};
use crate::firmware;
use crate::progress::Spinner;
use crate::setup::Tools;
use crate::shell;
use crate::toolchain::{RELEASE, SMALL, TINY};
use crate::workspace::Workspace;

const FEATURE: &str = "accuracy";
/// The bin on the host.
const HOST_BIN: &str = "accuracy";
/// The bins, here and there, with a dozen ways of each robot.
const QUICK_BIN: &str = "accuracy_quick";
const SIMULATION_BIN: &str = "accuracy_simulation";
/// What the host calls the simulations.
const SIMULATION: &str = "simulation";

/// A robot that there is something to measure of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Robot {
    Ur5e,
    Panda,
    #[value(name = "a1_leg")]
    A1Leg,
    #[value(name = "double_pendulum")]
    DoublePendulum,
}

impl Robot {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Ur5e, Self::Panda, Self::A1Leg, Self::DoublePendulum];
    /// Those whose torques are computed.
    pub const COMPUTED: [Self; 3] = [Self::Ur5e, Self::Panda, Self::A1Leg];
    /// Those that are simulated.
    pub const SIMULATED: [Self; 2] = [Self::DoublePendulum, Self::Ur5e];

    /// Its name in rows, lines and files, and in print; its bin, if torques are computed.
    fn names(self) -> (&'static str, &'static str, Option<&'static str>) {
        match self {
            Self::Ur5e => ("ur5e", "UR5e", Some("accuracy_ur5e")),
            Self::Panda => ("panda", "Panda", Some("accuracy_panda")),
            Self::A1Leg => ("a1_leg", "leg of the A1", Some("accuracy_leg")),
            Self::DoublePendulum => ("double_pendulum", "double pendulum", None),
        }
    }

    /// Its name in rows, lines and files.
    pub fn name(self) -> &'static str {
        self.names().0
    }

    /// Its name in print.
    pub fn title(self) -> &'static str {
        self.names().1
    }
}

/// What to run.
pub struct Plan {
    /// Of these robots.
    pub robots: Vec<Robot>,
    /// A dozen ways of each, at opt-level 3.
    pub quick: bool,
    /// Torques.
    pub inverse: bool,
    /// Simulations.
    pub simulation: bool,
}

/// A row with its bin and opt-level.
type Bin = (&'static str, &'static str, Row);

/// What came out.
pub struct Measured {
    /// All configurations of a run that is not quick.
    pub points: Vec<Point>,
    /// Those that differ from the default in one thing, measured in a program of their own.
    pub single: Vec<Point>,
    /// What the host printed.
    pub host: Host,
    /// What that costs which is printed to be pasted.
    pub pasted: Vec<Row>,
    /// The compiler.
    pub rustc: String,
}

impl Plan {
    fn simulates(&self) -> bool {
        let mut simulated = Robot::SIMULATED.iter();
        self.simulation && !self.quick && simulated.any(|robot| self.robots.contains(robot))
    }

    /// Opt-levels, their profiles and the bins that are built with them.
    fn batches(&self) -> Vec<(&'static str, &'static str, Vec<&'static str>)> {
        let chosen = self.robots.iter().filter_map(|robot| robot.names().2);
        let all: Vec<_> = chosen.filter(|_| self.inverse && !self.quick).collect();
        let mut first = all.clone();
        // In every run, so that what is written here is what the tests measure.
        first.extend(self.inverse.then_some(QUICK_BIN));
        // Simulations are no code for a controller: their size is nobody's concern.
        first.extend(self.simulates().then_some(SIMULATION_BIN));
        let batches = [
            ("3", RELEASE, first),
            ("s", SMALL, all.clone()),
            ("z", TINY, all),
        ];
        batches
            .into_iter()
            .filter(|(_, _, bins)| !bins.is_empty())
            .collect()
    }

    /// Builds and runs it all, for host and target side by side.
    pub fn run(&self, workspace: &Workspace, tools: &Tools) -> Result<Measured> {
        let printed = printed::write(workspace)?;
        let (rows, lines) = std::thread::scope(|scope| {
            let host = scope.spawn(|| self.errors(workspace, &printed));
            let rows = self.costs(workspace, tools, &printed);
            let lost = |_| Err(Error::check("the host's errors were not computed"));
            (rows, host.join().unwrap_or_else(lost))
        });
        let (mut measured, host) = (rows?, Host::read(&lines?)?);
        let pasted = |(_, _, row): &mut Bin| row.algorithm == printed::ALGORITHM;
        let pasted = measured
            .extract_if(.., pasted)
            .map(|(_, _, row)| row)
            .collect();
        let single = measured.extract_if(.., |(bin, ..)| *bin == QUICK_BIN);
        let single: Vec<_> = single.map(|(_, opt, row)| (opt, row)).collect();
        let points: Vec<_> = measured
            .into_iter()
            .map(|(_, opt, row)| (opt, row))
            .collect();
        Ok(Measured {
            points: join::join(&host, &points)?,
            single: join::join(&host, &single)?,
            host,
            pasted,
            rustc: tools.toolchain.rustc_version()?,
        })
    }

    /// What the target runs of these robots.
    fn costs(&self, workspace: &Workspace, tools: &Tools, printed: &PathBuf) -> Result<Vec<Bin>> {
        let spinner = Spinner::start("building the cycle meter");
        let meter = firmware::build_meter(workspace)?;
        let mut all = Vec::new();
        for (opt, profile, bins) in self.batches() {
            spinner.line(&format!("building {} (opt-level {opt})", bins.join(", ")));
            let mut command = tools.toolchain.firmware(workspace, "build");
            command
                .env(PRINTED, printed)
                .args(["--profile", profile, "--features", FEATURE]);
            shell::cargo(command.args(bins.iter().flat_map(|bin| ["--bin", bin])))?;
            for bin in bins {
                spinner.say(format!("running {bin} (opt-level {opt}) in QEMU"));
                let elf = tools.toolchain.elf(workspace, profile, bin);
                let mut rows = costs::run_for_time(tools, &meter, bin, &elf)?;
                rows.retain(|row| self.robots.iter().any(|robot| robot.name() == row.robot));
                all.extend(rows.into_iter().map(|row| (bin, opt, row)));
            }
        }
        Ok(all)
    }

    /// What the host prints of these robots.
    fn errors(&self, workspace: &Workspace, printed: &PathBuf) -> Result<String> {
        // Not for speed: to build it with optimisation across crates takes longer than it runs.
        let mut command = workspace.cargo("run");
        let bin = if self.quick { QUICK_BIN } else { HOST_BIN };
        command
            .env(PRINTED, printed)
            .args(["--quiet", "--package", "host-reports"]);
        command.args(["--features", FEATURE, "--bin", bin, "--"]);
        let computed = self
            .robots
            .iter()
            .filter(|robot| self.inverse && robot.names().2.is_some());
        command.args(computed.map(|robot| robot.name()));
        if self.simulates() {
            command.arg(SIMULATION);
        }
        shell::capture(&mut command)
    }
}
