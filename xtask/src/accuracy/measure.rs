//! Builds and runs: bins in QEMU for costs, a bin on the host for errors.

use super::join::{self, Host};
use super::point::Point;
use super::progress::Progress;
use crate::costs::{self, Row};
use crate::error::{Error, Result};
use crate::firmware;
use crate::setup::Tools;
use crate::shell;
use crate::toolchain::{RELEASE, SMALL, TINY};
use crate::workspace::Workspace;

pub const FEATURE: &str = "accuracy";
const HOST_BIN: &str = "accuracy";
const QUICK_HOST_BIN: &str = "accuracy_quick";

/// The bin with a dozen ways of each robot.
const QUICK_BIN: &str = "accuracy_quick";
const SIMULATION_BIN: &str = "accuracy_simulation";
/// What the firmware calls ways as they are printed.
const PASTED: &str = "pasted";
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

    /// Its name in rows, lines and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ur5e => "ur5e",
            Self::Panda => "panda",
            Self::A1Leg => "a1_leg",
            Self::DoublePendulum => "double_pendulum",
        }
    }

    /// Its name in print.
    pub fn title(self) -> &'static str {
        match self {
            Self::Ur5e => "UR5e",
            Self::Panda => "Panda",
            Self::A1Leg => "leg of the A1",
            Self::DoublePendulum => "double pendulum",
        }
    }

    fn bin(self) -> Option<&'static str> {
        match self {
            Self::Ur5e => Some("accuracy_ur5e"),
            Self::Panda => Some("accuracy_panda"),
            Self::A1Leg => Some("accuracy_leg"),
            Self::DoublePendulum => None,
        }
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

/// Bins that are built with a profile, side by side.
struct Batch {
    opt: &'static str,
    profile: &'static str,
    bins: Vec<&'static str>,
}

/// What takes how long on two idle cores, s: the bar learns from these how much is left.
const BUILD: f64 = 90.0;
const HOST: f64 = 150.0;
const RUN: f64 = 3.0;

impl Plan {
    fn wants(&self, robots: &[Robot]) -> bool {
        robots.iter().any(|robot| self.robots.contains(robot))
    }

    fn simulates(&self) -> bool {
        self.simulation && !self.quick && self.wants(&Robot::SIMULATED)
    }

    fn batches(&self) -> Vec<Batch> {
        let chosen = self.robots.iter().filter_map(|robot| robot.bin());
        let mut bins: Vec<_> = chosen.filter(|_| self.inverse).collect();
        if self.quick && !bins.is_empty() {
            bins = vec![QUICK_BIN];
        }
        let others = [("s", SMALL), ("z", TINY)].map(|(opt, profile)| Batch {
            opt,
            profile,
            bins: bins.clone(),
        });
        // In every run, so that what is written here is what the tests measure.
        if !self.quick && self.inverse {
            bins.push(QUICK_BIN);
        }
        // Simulations are no code for a controller: their size is nobody's concern.
        bins.extend(self.simulates().then_some(SIMULATION_BIN));
        let first = Batch {
            opt: "3",
            profile: RELEASE,
            bins,
        };
        let others = others.into_iter().filter(|_| !self.quick);
        let batches = [first].into_iter().chain(others);
        batches.filter(|batch| !batch.bins.is_empty()).collect()
    }

    /// Builds and runs it all, for host and target side by side.
    pub fn run(&self, workspace: &Workspace, tools: &Tools) -> Result<Measured> {
        std::thread::scope(|scope| {
            let host = scope.spawn(|| self.errors(workspace));
            self.costs(workspace, tools, || {
                host.join()
                    .unwrap_or_else(|_| Err(Error::check("the host's errors were not computed")))
            })
        })
    }

    /// Builds and runs bins on the target, and joins them with what the host says.
    fn costs(
        &self,
        workspace: &Workspace,
        tools: &Tools,
        host_lines: impl FnOnce() -> Result<String>,
    ) -> Result<Measured> {
        let batches = self.batches();
        let bins = batches.iter().map(|batch| batch.bins.len()).sum::<usize>();
        let host = if self.quick { HOST / 5.0 } else { HOST };
        let bar = Progress::new(host + bins as f64 * (BUILD / 2.0 + RUN));
        bar.step("building the cycle meter", 0.0);
        let meter = firmware::build_meter(workspace)?;
        let (mut measured, mut single, mut pasted) = (Vec::new(), Vec::new(), Vec::new());
        for Batch { opt, profile, bins } in batches {
            bar.step(
                &format!("building {} (opt-level {opt})", bins.join(", ")),
                bins.len() as f64 * BUILD / 2.0,
            );
            let elves =
                firmware::build_featured(workspace, tools.toolchain, profile, FEATURE, &bins)?;
            for (bin, elf) in bins.into_iter().zip(elves) {
                bar.step(&format!("running {bin} (opt-level {opt}) in QEMU"), RUN);
                let mut rows = costs::run_for_time(tools, &meter, bin, &elf)?;
                rows.retain(|row| self.covers(row));
                if bin == QUICK_BIN {
                    pasted.extend(rows.extract_if(.., |row| row.algorithm == PASTED));
                    single.push((opt, rows));
                } else {
                    measured.push((opt, rows));
                }
            }
        }
        bar.step("computing errors on the host", host);
        let host = Host::read(&host_lines()?)?;
        Ok(Measured {
            points: join::join(&host, &measured)?,
            single: join::join(&host, &single)?,
            host,
            pasted,
            rustc: tools.toolchain.rustc_version()?,
        })
    }

    fn covers(&self, row: &Row) -> bool {
        self.robots.iter().any(|robot| robot.name() == row.robot)
    }

    /// What the host prints of these robots.
    fn errors(&self, workspace: &Workspace) -> Result<String> {
        let mut command = workspace.cargo("run");
        // Not for speed: to build it with optimisation across crates takes longer than it runs.
        command.args(["--quiet", "--package", "host-reports"]);
        let bin = if self.quick { QUICK_HOST_BIN } else { HOST_BIN };
        command.args(["--features", FEATURE, "--bin", bin, "--"]);
        let computed = self.robots.iter().filter(|robot| robot.bin().is_some());
        if self.inverse {
            command.args(computed.map(|robot| robot.name()));
        }
        if self.simulates() {
            command.arg(SIMULATION);
        }
        shell::capture(&mut command)
    }
}
