//! The robot of a file: a dozen ways to compute its torques, measured anew each time.

use std::process::ExitCode;

use tempfile::TempDir;

use super::choice::{Budget, shipped};
use super::join::{Host, join};
use super::measure::ACCURACY;
use super::page;
use super::point::{Kind, Point};
use crate::costs;
use crate::docs;
use crate::error::{Result, check};
use crate::firmware;
use crate::import::{self, Own, Robot};
use crate::output;
use crate::progress::Spinner;
use crate::report::MODEL;
use crate::setup::{self, Options, Tools};
use crate::shell;
use crate::workspace::Workspace;

/// The bin on the target and the bin on the host.
const BIN: &str = "own_accuracy";
/// More joints than this do not fit into the RAM of the measured firmware, with 80 states and the ways' inputs.
const MOST_JOINTS: u64 = 20;

/// Imports, measures and prints; with a budget, what it chooses.
pub fn run(options: Options, own: &Own, budget: Option<Budget>, json: bool) -> Result<ExitCode> {
    if let Some(Budget::Error(allowed)) = budget
        && allowed.kind != Kind::Inverse
    {
        return Err(check!(
            "of a robot from a file only torques are measured: --error 0.05Nm"
        ));
    }
    let workspace = Workspace::find()?;
    let folder = import::folder(&workspace)?;
    let Some(robot) = own.robot(&workspace, &folder, MOST_JOINTS)? else {
        return Err(check!("there is no file"));
    };
    let points = measure(&workspace, &setup::for_demo(options)?, &folder, &robot)?;
    if let Some(budget) = budget {
        let points = shipped(&points, (robot.text("name"), Kind::Inverse, "rigid"));
        super::show(budget, &points, json)?;
        output::note(&format!(
            "\n`crate::robot` is the file of `cargo xtask import`. {REFERENCE}."
        ));
    } else if json {
        docs::print_json(&points)?;
    } else {
        let name = robot.text("name");
        output::print(&format!(
            "{name}; {MODEL}.\n{REFERENCE}.\n\n{}",
            page::every(&points)
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What errors and full scale are.
const REFERENCE: &str = "No oracle has recorded this robot: errors are those from the core in f64, along a way within \
                         60 % of the limits of the file; full scale is the largest torque at 2000 random states";

/// Costs from the target and errors from the host.
fn measure(
    workspace: &Workspace,
    tools: &Tools,
    folder: &TempDir,
    robot: &Robot,
) -> Result<Vec<Point>> {
    let spinner = Spinner::start(&format!("building {BIN}"));
    let features = format!("{},{ACCURACY}", import::FEATURE);
    let elves = import::build(workspace, tools, &features, &[robot], &[BIN])?;
    let meter = firmware::build_meter(workspace)?;
    spinner.say(format!("running {BIN} in QEMU"));
    let elf = elves.first().ok_or_else(|| check!("{BIN} was not built"))?;
    let rows = costs::run_for_time(tools, &meter, BIN, elf)?;
    spinner.say(format!("building and running {BIN} on the host"));
    let mut command = workspace.cargo("run");
    command.env(import::MODULES, import::modules(folder, &[robot])?);
    command.args(["--quiet", "--package", "host-reports", "--bin", BIN]);
    let lines = shell::capture(command.args(["--features", import::FEATURE]))?;
    drop(spinner);
    let rows: Vec<_> = rows.into_iter().map(|row| (BIN, "3", row)).collect();
    let mut points = join(&Host::read(&lines)?, &rows)?;
    for point in &mut points {
        point.robot = robot.text("name").to_owned();
        point.own = Some([
            robot.text("type_name").to_owned(),
            robot.joints().to_string(),
        ]);
    }
    Ok(points)
}
