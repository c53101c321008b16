//! Robots from files, by the crate `robot-import`, and the firmware that measures them.

pub mod passed;

use std::ffi::OsStr;
use std::path::PathBuf;

use serde_json::Value;

use crate::kit::error::{Error, Result, bail, check};
use crate::kit::firmware::{self, OWN_ROBOTS};
use crate::kit::host_bin::SHARED;
use crate::kit::progress::Spinner;
use crate::kit::rows::{self, Row};
use crate::kit::setup::Tools;
use crate::kit::shell;
use crate::kit::workspace::{self, Workspace};

const PACKAGE: &str = "robot-import";
const BIN: &str = "own_robots";
/// More joints than this do not fit into the RAM of the measured firmware.
const MOST_JOINTS: u64 = 40;

/// An imported robot: its file, and the report of `robot-import`.
pub struct Robot {
    pub file: PathBuf,
    pub report: Value,
}

/// Runs a subcommand of `robot-import` and returns its output; its errors are shown as ours.
pub fn command<W: AsRef<OsStr>>(
    workspace: &Workspace,
    subcommand: &str,
    words: &[W],
) -> Result<String> {
    let mut command = SHARED.program(workspace, PACKAGE)?;
    shell::capture(command.arg(subcommand).args(words)).map_err(Error::reason)
}

/// Imports a file for a report of its own; the Rust file is written to `file`.
pub fn import(workspace: &Workspace, words: &[&str], file: PathBuf) -> Result<Robot> {
    let path = file.to_string_lossy().into_owned();
    let text = command(workspace, "import", &[words, &["--json", "--out", &path]].concat())?;
    Ok(Robot { file, report: report(&text)? })
}

/// The report of `robot-import` from its JSON.
pub fn report(json: &str) -> Result<Value> {
    serde_json::from_str(json).map_err(|error| check!("{PACKAGE} printed no JSON: {error}"))
}

/// Whether the firmware takes a robot.
pub fn is_measurable(robot: &Robot) -> bool {
    let [bodies, q, v] = [0, 1, 2].map(|i| robot.report["sizes"][i].as_u64().unwrap_or_default());
    bodies == v && q == v && v <= MOST_JOINTS
}

/// Builds the firmware's bin for some robots and runs it under the meter; a robot's rows have its
/// number as name.
pub fn measure(workspace: &Workspace, tools: &Tools, robots: &[&Robot]) -> Result<Vec<Row>> {
    if !robots.iter().all(|robot| is_measurable(robot)) {
        bail!("the firmware takes up to {MOST_JOINTS} joints of one coordinate");
    }
    let spinner = Spinner::start("building the firmware for the robot");
    let (mut modules, mut calls) = (String::new(), String::new());
    for (i, robot) in robots.iter().enumerate() {
        let name = robot.report["type_name"].as_str().unwrap_or_default();
        let file = std::path::absolute(&robot.file).map_err(Error::file("find", &robot.file))?;
        modules += &format!("#[path = {file:?}]\nmod robot_{i};\n");
        calls += &format!("    robot::<robot_{i}::{name}, {{ robot_{i}::V }}>(\"{i}\");\n");
    }
    let folder = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let included = folder.path().join("own_robots.rs");
    workspace::write(&included, format!("{modules}\nfn robots() {{\n{calls}}}\n"))?;
    let elves = firmware::build_own(workspace, tools.toolchain, &included, OWN_ROBOTS, &[BIN])?;
    drop(spinner);
    Ok(rows::run_all(workspace, tools, &[BIN], &elves)?.0)
}
