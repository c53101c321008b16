//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse dynamics costs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::Value;

use crate::costs::{self, Row};
use crate::docs;
use crate::error::{Error, Result, check};
use crate::firmware;
use crate::output;
use crate::progress::Spinner;
use crate::report::MODEL;
use crate::setup::{self, Options, Tools};
use crate::shell;
use crate::table::{Table, thousands};
use crate::toolchain::RELEASE;
use crate::workspace::Workspace;

const PACKAGE: &str = "robot-import";
const BIN: &str = "own_robots";
const FEATURE: &str = "own-robots";
/// More joints than this do not fit into the RAM of the measured firmware.
const MOST_JOINTS: u64 = 40;

/// A file, and what `robot-import` is told of it.
#[derive(clap::Args)]
pub struct Args {
    /// The description, URDF or MJCF, and the options of `robot-import import`: --base, --tip, --joints, --lock,
    /// --free-base, --name, --out, --check, --repair, --keep-roundings, --python
    #[arg(value_name = "FILE", required = true, num_args = 1.., trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
    /// Do not measure in QEMU what inverse dynamics costs
    #[arg(long)]
    no_measure: bool,
    /// The report as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
}

/// An imported robot: its file, and the report of `robot-import`.
pub struct Robot {
    /// The Rust file.
    pub file: PathBuf,
    /// The report.
    pub report: Value,
}

/// Imports, measures and prints.
pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    // Behind the file they are among its options.
    let mut words: Vec<&str> = args.arguments.iter().map(String::as_str).collect();
    let mut flag = |name: &str| {
        let before = words.len();
        words.retain(|word| *word != name);
        words.len() < before
    };
    let no_measure = flag("--no-measure") || args.no_measure;
    let json = flag("--json") || args.json;
    let out = words.iter().position(|word| *word == "--out");
    let kept = out.and_then(|i| words.get(i + 1));
    let scratch = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let file = kept.map_or(scratch.path().join("robot.rs"), PathBuf::from);
    let mut words = words.clone();
    let path = file.to_string_lossy().into_owned();
    if kept.is_none() {
        words.extend(["--out", &path]);
    }
    // The text is of the same run of the same numbers as the JSON, which only the measurement needs.
    let text = command(&workspace, &words)?;
    if no_measure && !json {
        output::print(&text)?;
        show(&file, kept.is_some())?;
        return Ok(ExitCode::SUCCESS);
    }
    words.push("--json");
    let report: Value = serde_json::from_str(&command(&workspace, &words)?)
        .map_err(|error| check!("{PACKAGE} printed no JSON: {error}"))?;
    let robot = Robot { file, report };
    let measured = match no_measure {
        true => Err(check!("not measured: --no-measure")),
        false => setup::for_demo(options).and_then(|tools| measure(&workspace, &tools, &[&robot])),
    };
    if json {
        let mut report = robot.report;
        report["measured"] = serde_json::to_value(measured.unwrap_or_default()).unwrap_or_default();
        docs::print_json(&report)?;
        return Ok(ExitCode::SUCCESS);
    }
    output::print(&text)?;
    match measured {
        Ok(rows) => output::print(&format!("\n{MODEL}:\n{}", table(&rows).text()))?,
        Err(error) => output::note(&format!("not measured: {error}")),
    }
    show(&robot.file, kept.is_some())?;
    Ok(ExitCode::SUCCESS)
}

/// The file itself, where it is not kept.
fn show(file: &Path, kept: bool) -> Result<()> {
    match kept {
        true => output::print(&format!("\nwritten: {}\n", file.display())),
        false => output::print(&format!("\n{}", crate::workspace::read(file)?)),
    }
}

/// What `robot-import import` prints; its errors are shown as they are.
fn command(workspace: &Workspace, words: &[&str]) -> Result<String> {
    let mut command = workspace.cargo("run");
    command
        .args(["--quiet", "--package", PACKAGE, "--", "import"])
        .args(words)
        .current_dir(std::env::current_dir().map_err(Error::file("find", Path::new(".")))?);
    shell::capture(&mut command)
}

/// Imports a file for a report of its own; the Rust file is written to `file`.
pub fn import(workspace: &Workspace, words: &[&str], file: PathBuf) -> Result<Robot> {
    let path = file.to_string_lossy().into_owned();
    let text = command(workspace, &[words, &["--json", "--out", &path]].concat())?;
    let report = serde_json::from_str(&text)
        .map_err(|error| check!("{PACKAGE} printed no JSON: {error}"))?;
    Ok(Robot { file, report })
}

/// Whether the firmware takes a robot.
pub fn is_measurable(robot: &Robot) -> bool {
    let [bodies, q, v] = [0, 1, 2].map(|i| robot.report["sizes"][i].as_u64().unwrap_or_default());
    bodies == v && q == v && v <= MOST_JOINTS
}

/// Builds the firmware's bin for some robots and runs it under the meter; a robot's rows have its number as name.
pub fn measure(workspace: &Workspace, tools: &Tools, robots: &[&Robot]) -> Result<Vec<Row>> {
    if !robots.iter().all(|robot| is_measurable(robot)) {
        return Err(check!(
            "the firmware takes up to {MOST_JOINTS} joints of one coordinate"
        ));
    }
    let spinner = Spinner::start("building the firmware for the robot");
    let mut named = Vec::new();
    for robot in robots {
        let name = robot.report["type_name"].as_str().unwrap_or_default();
        let file = std::path::absolute(&robot.file).map_err(Error::file("find", &robot.file))?;
        named.push(format!("{}:{name}", file.display()));
    }
    let mut build = tools.toolchain.firmware(workspace, "build");
    build
        .args(["--profile", RELEASE, "--features", FEATURE, "--bin", BIN])
        // The firmware's other bins are not built anew for it.
        .arg("--target-dir")
        .arg(workspace.target.join(FEATURE))
        .env("OWN_ROBOTS", named.join(";"));
    shell::capture(&mut build)?;
    let target = workspace
        .target
        .join(FEATURE)
        .join(crate::toolchain::TARGET);
    let elf = target.join(RELEASE).join(BIN);
    let meter = firmware::build_meter(workspace)?;
    spinner.say("running the robot's firmware in QEMU".to_owned());
    Ok(costs::run_bin(tools, &meter, BIN, &elf)?.0)
}

/// What was measured.
pub fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(&[
        "inverse dynamics",
        "form",
        "cycles",
        "instructions",
        "code, B",
        "stack, B",
    ]);
    for row in rows {
        let figures = [
            row.cycles.max,
            row.instructions.max,
            row.code_bytes,
            row.stack_bytes,
        ];
        let names = [row.inputs.clone(), row.form.clone()];
        table.row(names.into_iter().chain(figures.map(thousands)));
    }
    table
}
