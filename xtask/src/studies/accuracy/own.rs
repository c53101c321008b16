//! The robot of a file: ways to compute its torques, measured anew each time, with their picture.

use std::path::Path;
use std::process::ExitCode;

use super::choice::{Budget, shipped};
use super::join::{Bin, Host, join};
use super::measure::ACCURACY;
use super::point::{Kind, Point};
use super::proven::{self, Proven};
use super::{page, plot};
use crate::kit::error::{Result, bail, check};
use crate::kit::firmware::{OWN_ROBOTS, build_own, variable};
use crate::kit::meter::MODEL;
use crate::kit::own_robot::OwnRobot;
use crate::kit::progress::Spinner;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, firmware, output, rows, shell};

/// The bin on the target and the bin on the host.
const BIN: &str = "own_accuracy";
/// More joints than this do not fit into the RAM of the measured firmware, with 80 states and the
/// ways' inputs.
pub const MOST_JOINTS: u64 = 20;

/// Measures and prints; with a budget, what it chooses.
pub fn run(
    options: Options,
    robot: &OwnRobot,
    budget: Option<Budget>,
    proven: Option<Vec<Proven>>,
    json: bool,
) -> Result<ExitCode> {
    if let Some(Budget::Error(allowed)) = budget
        && allowed.kind != Kind::Inverse
    {
        bail!("of a robot from a file only torques are measured: --error 0.05Nm");
    }
    let workspace = Workspace::find()?;
    let (points, host) = measure(&workspace, &setup::for_demo(options)?, robot)?;
    let all: Vec<&Point> = points.iter().collect();
    let picture = robot.file.with_extension("accuracy.svg");
    workspace::write(&picture, plot::front([&*robot.name; 2], &all, &host)?)?;
    output::note(&format!("drawn: {}", picture.display()));
    if let Some(budget) = budget {
        let mut points = shipped(&points, (&*robot.name, Kind::Inverse, ""));
        let mut errors = REFERENCE.to_owned();
        if let Some(proven) = &proven {
            (points, errors) = proven::chosen(proven, points)?;
        }
        super::show(budget, &points, json)?;
        output::note(&format!("\n`crate::robot` is the file of `cargo xtask import`. {errors}"));
    } else if json {
        docs::print_json(&points)?;
    } else {
        let name = &robot.name;
        output::print(&format!("{name}; {MODEL}.\n{REFERENCE}.\n\n{}", page::every(&points)))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The definition of errors and full scale.
const REFERENCE: &str = "No oracle has recorded this robot: errors are those from the core in f64, along a way within \
                         60 % of the file's limits of position, with its speeds (2 rad/s without) and 12 rad/s². The box \
                         has all positions, speeds and accelerations within these limits: 2000 random states of it, half \
                         of them at corners of speeds and accelerations. Full scale is the largest torque there";

/// Costs from the target and errors from the host, which are built and run side by side.
fn measure(workspace: &Workspace, tools: &Tools, robot: &OwnRobot) -> Result<(Vec<Point>, Host)> {
    output::note("25 configurations are built and measured: this takes two to three minutes.");
    let included = robot.included()?;
    let (rows, lines) = std::thread::scope(|scope| {
        let host = scope.spawn(|| errors(workspace, &included));
        let rows = costs(workspace, tools, &included);
        let lost = |_| Err(check!("the host's errors were not computed"));
        (rows, host.join().unwrap_or_else(lost))
    });
    let mut host = Host::read(&lines?)?;
    let mut points = join(&host, &rows?)?;
    for point in &mut points {
        point.own = Some([robot.type_name.clone(), robot.joints.to_string()]);
    }
    for point in points.iter_mut().chain(host.points()) {
        point.robot.clone_from(&robot.name);
    }
    Ok((points, host))
}

fn costs(workspace: &Workspace, tools: &Tools, included: &Path) -> Result<Vec<Bin>> {
    let spinner = Spinner::start(&format!("building {BIN} for the target"));
    let features = format!("{OWN_ROBOTS},{ACCURACY}");
    let elves = build_own(workspace, tools.toolchain, included, &features, &[BIN])?;
    let meter = firmware::build_meter(workspace)?;
    spinner.say(format!("running {BIN} in QEMU"));
    let rows = elves.iter().map(|elf| rows::run_for_time(tools, &meter, BIN, elf));
    let rows = rows.collect::<Result<Vec<_>>>()?.into_iter().flatten();
    Ok(rows.map(|row| (BIN, row)).collect())
}

fn errors(workspace: &Workspace, included: &Path) -> Result<String> {
    let _spinner = Spinner::start(&format!("building and running {BIN} on the host"));
    let mut command = workspace.cargo("run");
    command.envs([variable(included)]);
    command.args(["--quiet", "--package", "host-reports", "--bin", BIN]);
    shell::capture(command.args(["--features", OWN_ROBOTS]))
}
