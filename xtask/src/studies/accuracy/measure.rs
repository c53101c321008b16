//! Builds and runs: bins in QEMU for costs, a bin on the host for errors.

use std::path::Path;

use super::join::{self, Bin, Host};
use super::point::{Kind, Point};
use super::printed::{self, PRINTED, QUICK_BIN};
use super::proven;
use super::robot::Robot;
use crate::kit::error::{Result, check};
use crate::kit::host_bin::{SHARED, SIMULATED, Together};
use crate::kit::progress::Spinner;
use crate::kit::rows;
use crate::kit::setup::Tools;
use crate::kit::toolchain::RELEASE;
use crate::kit::workspace::Workspace;
use crate::kit::{firmware, shell};

/// The feature, and the bin on the host.
pub const ACCURACY: &str = "accuracy";
/// The bins of the robots whose torques are computed.
const BINS: [&str; 3] = ["accuracy_ur5e", "accuracy_panda", "accuracy_leg"];
const SIMULATION_BIN: &str = "accuracy_simulation";

pub struct Plan {
    pub robots: Vec<Robot>,
    /// Nothing on the target: the points are those of the record.
    pub recorded: bool,
    /// Only this is computed.
    pub kind: Option<Kind>,
}

pub struct Measured {
    pub points: Vec<Point>,
    pub host: Host,
    pub rustc: String,
}

impl Plan {
    /// The robots whose torques are computed, each with its bin.
    fn computed(&self) -> impl Iterator<Item = (Robot, &'static str)> {
        let wanted = self.kind != Some(Kind::Simulation);
        let all = std::iter::zip(Robot::COMPUTED, BINS);
        all.filter(move |(robot, _)| wanted && self.robots.contains(robot))
    }

    fn simulates(&self) -> bool {
        self.kind != Some(Kind::Inverse) && self.robots.contains(&Robot::Ur5e)
    }

    /// The bins on the target.
    fn bins(&self) -> Vec<&'static str> {
        let mut bins: Vec<_> = self.computed().map(|(_, bin)| bin).collect();
        bins.extend(self.simulates().then_some(SIMULATION_BIN));
        bins
    }

    /// Builds and runs it all, for host and target side by side.
    pub fn run(&self, workspace: &Workspace, tools: &Tools) -> Result<Measured> {
        let (rows, lines) = std::thread::scope(|scope| {
            let host = scope.spawn(|| self.errors(workspace));
            let rows = match self.recorded {
                true => Ok(Vec::new()),
                false => costs(workspace, tools, &self.bins(), None),
            };
            let lost = |_| Err(check!("the host's errors were not computed"));
            (rows, host.join().unwrap_or_else(lost))
        });
        let (mut rows, mut host) = (rows?, Host::read(&lines?)?);
        rows.retain(|(_, row)| self.robots.iter().any(|robot| robot.name() == row.robot));
        host.proven = proven::read(workspace, None)?;
        let mut points = join::join(&host, &rows)?;
        proven::attach(&host.proven, &mut points);
        Ok(Measured { points, host, rustc: tools.toolchain.rustc_version()? })
    }

    /// Measures the errors of these robots on the host; for the record, those of the reference.
    fn errors(&self, workspace: &Workspace) -> Result<String> {
        let mut words: Vec<&str> = self.computed().map(|(robot, _)| robot.name()).collect();
        words.extend((self.simulates() && !self.recorded).then_some("simulation"));
        // A dozen ways are computed sooner than the compiler optimises them across crates; all of
        // them take most of an hour without.
        match self.recorded {
            true => errors(workspace, &SHARED, (QUICK_BIN, &printed::write(workspace)?), &words),
            false => errors(workspace, &SIMULATED, (ACCURACY, Path::new("")), &words),
        }
    }
}

/// Measures bins on the target, which may include a file of printed code.
pub fn costs(
    workspace: &Workspace,
    tools: &Tools,
    bins: &[&'static str],
    printed: Option<&Path>,
) -> Result<Vec<Bin>> {
    let spinner = Spinner::start("building the cycle meter");
    let meter = firmware::build_meter(workspace)?;
    spinner.line(&format!("building {}", bins.join(", ")));
    let included = printed.map(|printed| (PRINTED, printed));
    let chain = tools.toolchain;
    let elves = firmware::build_with(workspace, chain, RELEASE, ACCURACY, bins, included)?;
    let mut all = Vec::new();
    for (bin, elf) in std::iter::zip(bins, elves) {
        spinner.say(format!("running {bin} in QEMU"));
        let rows = rows::run_for_time(tools, &meter, bin, &elf)?;
        all.extend(rows.into_iter().map(|row| (*bin, row)));
    }
    Ok(all)
}

/// What a bin prints on the host about these robots.
pub fn errors(
    workspace: &Workspace,
    these: &Together,
    (bin, printed): (&str, &Path),
    words: &[&str],
) -> Result<String> {
    let mut build = these.build(workspace);
    let features = format!("host-reports/{ACCURACY}");
    build.args(["--package", "host-reports", "--bin", bin, "--features", &features]);
    shell::capture(build.env(PRINTED, printed))?;
    shell::capture(these.built(workspace, bin).args(words))
}

/// The generated code, measured for host and target.
pub fn printed(workspace: &Workspace, tools: &Tools) -> Result<Vec<Point>> {
    let file = printed::write(workspace)?;
    let rows = costs(workspace, tools, &[QUICK_BIN], Some(&file))?;
    let lines = errors(workspace, &SHARED, (QUICK_BIN, &file), &[])?;
    join::join(&Host::read(&lines)?, &rows)
}
