//! Builds and runs: bins in QEMU for costs, a bin on the host for errors.

use std::path::Path;

use super::join::{self, Bin, Host};
use super::point::{Kind, Point};
use super::printed::{self, PRINTED};
use super::proven;
use super::robot::Robot;
use crate::kit::bracket::{self, READINGS};
use crate::kit::error::{Result, check};
use crate::kit::host_bin::{SHARED, SIMULATED};
use crate::kit::progress::Spinner;
use crate::kit::rows::{self, Row};
use crate::kit::setup::Tools;
use crate::kit::toolchain::RELEASE;
use crate::kit::workspace::Workspace;
use crate::kit::{firmware, shell};

/// The feature, and the bin on the host.
pub const ACCURACY: &str = "accuracy";
/// The bins of the robots whose torques are computed.
const BINS: [&str; 3] = ["accuracy_ur5e", "accuracy_panda", "accuracy_leg"];
/// The bins, here and there, with a dozen ways of each robot.
const QUICK_BIN: &str = "accuracy_quick";
const SIMULATION_BIN: &str = "accuracy_simulation";

/// The rows from the target, and [`Measured::shares`].
type Costs = (Vec<Bin>, Option<[f64; 2]>);

/// The shares of the longest calls of the UR5e's rows.
fn shares_of(least: &[Row], chosen: &[Row], most: &[Row]) -> Result<[f64; 2]> {
    let readings = std::iter::zip(least, chosen).zip(most);
    let ur5e = readings.filter(|((_, row), _)| row.robot == Robot::Ur5e.name());
    bracket::shares(
        ur5e.map(|((least, chosen), most)| [least, chosen, most].map(|row| row.cycles.max)),
    )
}

pub struct Plan {
    pub robots: Vec<Robot>,
    /// A dozen ways of each, and no simulations.
    pub quick: bool,
    /// Only this is computed.
    pub kind: Option<Kind>,
}

pub struct Measured {
    pub points: Vec<Point>,
    /// The configurations that differ from the default in one thing, measured in a separate
    /// program.
    pub single: Vec<Point>,
    /// The fewest and the most cycles of `single` of the UR5e by the readings of the manual, as
    /// shares of those shown.
    pub shares: Option<[f64; 2]>,
    /// In a quick run, what is printed as generated code.
    pub generated: Vec<Point>,
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
        let wanted = !self.quick && self.kind != Some(Kind::Inverse);
        wanted && self.robots.contains(&Robot::Ur5e)
    }

    /// The bins on the target.
    fn bins(&self) -> Vec<&'static str> {
        let all = self.computed().map(|(_, bin)| bin);
        let mut bins: Vec<_> = all.filter(|_| !self.quick).collect();
        // In every run, so that what is written here is what the tests measure.
        bins.extend(self.computed().next().map(|_| QUICK_BIN));
        bins.extend(self.simulates().then_some(SIMULATION_BIN));
        bins
    }

    /// Builds and runs it all, for host and target side by side.
    pub fn run(&self, workspace: &Workspace, tools: &Tools) -> Result<Measured> {
        let printed = printed::write(workspace)?;
        let (rows, lines) = std::thread::scope(|scope| {
            let host = scope.spawn(|| self.errors(workspace, &printed));
            let rows = self.costs(workspace, tools, &printed);
            let lost = |_| Err(check!("the host's errors were not computed"));
            (rows, host.join().unwrap_or_else(lost))
        });
        let ((mut rows, shares), mut host) = (rows?, Host::read(&lines?)?);
        host.proven = proven::read(workspace, None)?;
        let single: Vec<_> = rows.extract_if(.., |(bin, _)| *bin == QUICK_BIN).collect();
        let mut single = join::join(&host, &single)?;
        let is_generated = |point: &mut Point| point.kind == Kind::Generated;
        let generated = single.extract_if(.., is_generated).collect();
        proven::attach(&host.proven, &mut single);
        let mut points = match self.quick {
            true => single.clone(),
            false => join::join(&host, &rows)?,
        };
        proven::attach(&host.proven, &mut points);
        let rustc = tools.toolchain.rustc_version()?;
        Ok(Measured { points, single, shares, generated, host, rustc })
    }

    /// Measures these robots on the target.
    fn costs(&self, workspace: &Workspace, tools: &Tools, printed: &Path) -> Result<Costs> {
        let spinner = Spinner::start("building the cycle meter");
        let meter = firmware::build_meter(workspace)?;
        let (mut all, mut shares) = (Vec::new(), None);
        let bins = self.bins();
        spinner.line(&format!("building {}", bins.join(", ")));
        let included = Some((PRINTED, printed));
        let chain = tools.toolchain;
        let elves = firmware::build_with(workspace, chain, RELEASE, ACCURACY, &bins, included)?;
        for (bin, elf) in std::iter::zip(bins, elves) {
            spinner.say(format!("running {bin} in QEMU"));
            let mut rows = rows::run_for_time(tools, &meter, bin, &elf, "")?;
            if bin == QUICK_BIN {
                let [least, most] =
                    READINGS.map(|reading| rows::run_for_time(tools, &meter, bin, &elf, reading));
                shares = Some(shares_of(&least?, &rows, &most?)?);
            }
            // Only the host's quick bin knows the errors of what is generated.
            rows.retain(|row| {
                let known = self.quick || row.algorithm != "generated";
                known && self.robots.iter().any(|robot| robot.name() == row.robot)
            });
            all.extend(rows.into_iter().map(|row| (bin, row)));
        }
        Ok((all, shares))
    }

    /// Measures the errors of these robots on the host.
    fn errors(&self, workspace: &Workspace, printed: &Path) -> Result<String> {
        // A dozen ways are computed sooner than the compiler optimises them across crates; all of
        // them take most of an hour without.
        let (these, bin) = match self.quick {
            true => (SHARED, QUICK_BIN),
            false => (SIMULATED, ACCURACY),
        };
        let mut build = these.build(workspace);
        let features = format!("host-reports/{ACCURACY}");
        build.args(["--package", "host-reports", "--bin", bin, "--features", &features]);
        shell::capture(build.env(PRINTED, printed))?;
        let mut command = these.built(workspace, bin);
        command.args(self.computed().map(|(robot, _)| robot.name()));
        command.args(self.simulates().then_some("simulation"));
        shell::capture(&mut command)
    }
}
