//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse dynamics costs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::Value;

use crate::costs::{self, Row};
use crate::docs;
use crate::error::{Error, Result, check};
use crate::output;
use crate::own_robot::{self, FEATURE};
use crate::progress::Spinner;
use crate::report::MODEL;
use crate::setup::{self, Options, Tools};
use crate::shell;
use crate::table::{Table, thousands};
use crate::workspace::{self, Workspace};

const PACKAGE: &str = "robot-import";
const BIN: &str = "own_robots";
/// More joints than this do not fit into the RAM of the measured firmware.
const MOST_JOINTS: u64 = 40;

/// A file, and options of `robot-import import`.
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

/// A folder, and options of `robot-import new`.
#[derive(clap::Args)]
pub struct New {
    /// The folder, --robot FILE, and the other options of `robot-import new`: --c, --git, and those of `import`
    #[arg(value_name = "FOLDER", required = true, num_args = 1.., trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

/// Writes a project that uses this checkout's library, unless an option names another.
pub fn new(args: &New) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let library = workspace
        .root
        .join("dynamics-core")
        .to_string_lossy()
        .into_owned();
    let mut words: Vec<&str> = args.arguments.iter().map(String::as_str).collect();
    if !words
        .iter()
        .any(|word| *word == "--git" || *word == "--library")
    {
        words.extend(["--library", &library]);
    }
    output::print(&command(&workspace, "new", &words)?)?;
    Ok(ExitCode::SUCCESS)
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
    let json_file = scratch.path().join("report.json");
    let json_path = json_file.to_string_lossy().into_owned();
    words.extend(["--report", &json_path]);
    let text = command(&workspace, "import", &words)?;
    let report = report(&workspace::read(&json_file)?)?;
    let robot = Robot { file, report };
    let measured = (!no_measure).then(|| {
        setup::for_demo(options).and_then(|tools| measure(&workspace, &tools, &[&robot], Ways::All))
    });
    if json {
        let mut report = robot.report;
        let rows = measured.transpose().unwrap_or_default();
        report["measured"] = serde_json::to_value(rows.unwrap_or_default()).unwrap_or_default();
        docs::print_json(&report)?;
        return Ok(ExitCode::SUCCESS);
    }
    output::print(&text)?;
    match measured {
        Some(Ok(rows)) => output::print(&format!("\n{MODEL}:\n{}", table(&rows).text()))?,
        Some(Err(error)) => output::note(&format!("not measured: {error}")),
        None => {}
    }
    show(&robot.file, kept.is_some())?;
    Ok(ExitCode::SUCCESS)
}

/// The file itself, where it is not kept.
fn show(file: &Path, kept: bool) -> Result<()> {
    match kept {
        true => output::print(&format!("\nwritten: {}\n", file.display())),
        false => output::print(&format!("\n{}", workspace::read(file)?)),
    }
}

/// What a subcommand of `robot-import` prints; its errors are shown as they are.
fn command(workspace: &Workspace, subcommand: &str, words: &[&str]) -> Result<String> {
    let mut command = workspace.cargo("run");
    command
        .args(["--quiet", "--package", PACKAGE, "--", subcommand])
        .args(words)
        .current_dir(std::env::current_dir().map_err(Error::file("find", Path::new(".")))?);
    shell::capture(&mut command)
}

/// Imports a file for a report of its own; the Rust file is written to `file`.
pub fn import(workspace: &Workspace, words: &[&str], file: PathBuf) -> Result<Robot> {
    let path = file.to_string_lossy().into_owned();
    let text = command(
        workspace,
        "import",
        &[words, &["--json", "--out", &path]].concat(),
    )?;
    Ok(Robot {
        file,
        report: report(&text)?,
    })
}

/// The report of `robot-import` from its JSON.
fn report(json: &str) -> Result<Value> {
    serde_json::from_str(json).map_err(|error| check!("{PACKAGE} printed no JSON: {error}"))
}

/// Which inverse dynamics is measured.
#[derive(Clone, Copy)]
pub enum Ways {
    /// Full, and gravity alone.
    All,
    /// Full.
    Full,
}

impl Ways {
    /// The firmware's function.
    fn function(self) -> &'static str {
        match self {
            Self::All => "robot",
            Self::Full => "in_full",
        }
    }
}

/// Whether the firmware takes a robot.
pub fn is_measurable(robot: &Robot) -> bool {
    let [bodies, q, v] = [0, 1, 2].map(|i| robot.report["sizes"][i].as_u64().unwrap_or_default());
    bodies == v && q == v && v <= MOST_JOINTS
}

/// Builds the firmware's bin for some robots and runs it under the meter; a robot's rows have its number as name.
pub fn measure(
    workspace: &Workspace,
    tools: &Tools,
    robots: &[&Robot],
    ways: Ways,
) -> Result<Vec<Row>> {
    if !robots.iter().all(|robot| is_measurable(robot)) {
        return Err(check!(
            "the firmware takes up to {MOST_JOINTS} joints of one coordinate"
        ));
    }
    let spinner = Spinner::start("building the firmware for the robot");
    let (mut modules, mut calls) = (String::new(), String::new());
    for (i, robot) in robots.iter().enumerate() {
        let name = robot.report["type_name"].as_str().unwrap_or_default();
        let file = std::path::absolute(&robot.file).map_err(Error::file("find", &robot.file))?;
        modules += &format!("#[path = {file:?}]\nmod robot_{i};\n");
        let function = ways.function();
        calls += &format!("    {function}::<robot_{i}::{name}, {{ robot_{i}::V }}>(\"{i}\");\n");
    }
    let folder = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let included = folder.path().join("own_robots.rs");
    workspace::write(&included, format!("{modules}\nfn robots() {{\n{calls}}}\n"))?;
    let elves = own_robot::build(workspace, tools, &included, FEATURE, &[BIN])?;
    drop(spinner);
    Ok(costs::run_all(workspace, tools, &[BIN], &elves)?.0)
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
