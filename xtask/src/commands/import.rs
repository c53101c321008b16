//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse dynamics costs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use crate::kit::error::{Error, Result};
use crate::kit::importer::{ALL, Robot, command, measure, report};
use crate::kit::meter::MODEL;
use crate::kit::rows::Row;
use crate::kit::setup::{self, Options};
use crate::kit::table::{Table, thousands};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, output};

/// A file, and options of `robot-import import`.
#[derive(clap::Args)]
pub struct Args {
    /// The description, URDF or MJCF, and the options of `robot-import import`: --base, --tip, --joints, --lock,
    /// --free-base, --motors, --name, --out, --check, --repair, --keep-roundings, --python, --python-environment, --peer-time
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

pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    // Options after the file are among its arguments.
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
        setup::for_demo(options).and_then(|tools| measure(&workspace, &tools, &[&robot], ALL))
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
