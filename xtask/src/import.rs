//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse dynamics costs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::Value;
use tempfile::TempDir;

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
use crate::workspace::{self, Workspace};

const PACKAGE: &str = "robot-import";
const BIN: &str = "own_robots";
/// The feature of the bins that measure robots from files, here and on the host.
pub const FEATURE: &str = "own-robots";
/// The variable that says to them where the file of modules is.
pub const MODULES: &str = "OWN_ROBOTS";
/// More joints than this do not fit into the RAM of the firmware that measures inverse dynamics.
pub const MOST_JOINTS: u64 = 40;

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

/// The file of a report's robot.
#[derive(clap::Args)]
pub struct Own {
    /// Of the robot of this file, URDF or MJCF, alone; nothing is written
    #[arg(long, value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Options of `cargo xtask import` for the file: --base, --tip, --joints, --lock, --name, --repair …
    #[arg(last = true, requires = "file", value_name = "OPTIONS")]
    options: Vec<String>,
}

impl Own {
    /// The robot, if there is a file, with its Rust file in a folder; fails if the firmware does not take it, or not so
    /// many joints.
    pub fn robot(
        &self,
        workspace: &Workspace,
        folder: &TempDir,
        most: u64,
    ) -> Result<Option<Robot>> {
        let Some(file) = &self.file else {
            return Ok(None);
        };
        let path = file.to_string_lossy();
        let words: Vec<&str> = std::iter::once(&*path)
            .chain(self.options.iter().map(String::as_str))
            .collect();
        let robot = import(workspace, &words, folder.path().join("robot.rs"))?;
        match refusal(&robot.report, most) {
            None => Ok(Some(robot)),
            Some(why) => Err(check!("{path}: {why}")),
        }
    }
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
    let scratch = folder(&workspace)?;
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

impl Robot {
    /// A text of the report.
    pub fn text(&self, name: &str) -> &str {
        self.report[name].as_str().unwrap_or_default()
    }

    /// The number of its velocity coordinates.
    pub fn joints(&self) -> u64 {
        self.report["sizes"][2].as_u64().unwrap_or_default()
    }
}

/// Whether the firmware takes a robot.
pub fn is_measurable(robot: &Robot) -> bool {
    refusal(&robot.report, MOST_JOINTS).is_none()
}

/// Why a firmware for so many joints does not take the robot of a report, if it does not.
fn refusal(report: &Value, most: u64) -> Option<String> {
    let [bodies, q, v] = [0, 1, 2].map(|i| report["sizes"][i].as_u64().unwrap_or_default());
    if bodies != v || q != v {
        return Some(format!(
            "{bodies} bodies have {q} position and {v} velocity coordinates, but the measured firmware takes joints of \
             one coordinate only, and no free base"
        ));
    }
    (v > most).then(|| {
        format!(
            "{v} joints are more than the {most} that fit into the RAM of the measured firmware: --tip, --joints or \
             --lock leave some out"
        )
    })
}

/// Builds the firmware's bin for some robots and runs it under the meter; a robot's rows have its number as name.
pub fn measure(workspace: &Workspace, tools: &Tools, robots: &[&Robot]) -> Result<Vec<Row>> {
    let mut refused = robots
        .iter()
        .filter_map(|robot| refusal(&robot.report, MOST_JOINTS));
    if let Some(why) = refused.next() {
        return Err(check!("{why}"));
    }
    let spinner = Spinner::start("building the firmware for the robot");
    let elves = build(workspace, tools, FEATURE, robots, &[BIN])?;
    drop(spinner);
    Ok(costs::run_all(workspace, tools, &[BIN], &elves)?.0)
}

/// Builds bins of the firmware with these features for some robots.
pub fn build(
    workspace: &Workspace,
    tools: &Tools,
    features: &str,
    robots: &[&Robot],
    bins: &[&str],
) -> Result<Vec<PathBuf>> {
    let folder = folder(workspace)?;
    let modules = modules(&folder, robots)?;
    let mut command = tools.toolchain.firmware(workspace, "build");
    command.args(["--profile", RELEASE, "--features", features]);
    command.env(MODULES, modules);
    firmware::build_by(command, workspace, tools.toolchain, RELEASE, bins)
}

/// A folder that is removed in the end, for the files of a robot: two commands at a time have two.
pub fn folder(workspace: &Workspace) -> Result<TempDir> {
    tempfile::tempdir().map_err(Error::file("create", &workspace.target))
}

/// Writes into a folder a module for each robot, and what the macro `robots` of a bin is given: its number, its type, and the
/// number of its joints.
pub fn modules(folder: &TempDir, robots: &[&Robot]) -> Result<PathBuf> {
    let (mut modules, mut given) = (String::new(), String::new());
    for (i, robot) in robots.iter().enumerate() {
        let file = std::path::absolute(&robot.file).map_err(Error::file("find", &robot.file))?;
        let name = robot.text("type_name");
        modules += &format!("#[path = {file:?}]\nmod robot_{i};\n");
        given += &format!("    \"{i}\" robot_{i}::{name}, robot_{i}::V;\n");
    }
    let file = folder.path().join("own_robots.rs");
    workspace::write(&file, format!("{modules}robots! {{\n{given}}}\n"))?;
    Ok(file)
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

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{MOST_JOINTS, refusal};

    #[test]
    fn robots_that_the_firmware_does_not_take_are_refused_with_the_reason() {
        let said = |sizes: [u64; 3]| refusal(&json!({ "sizes": sizes }), MOST_JOINTS);
        assert_eq!(said([6, 6, 6]), None);
        assert_eq!(said([40, 40, 40]), None);
        let reason = |sizes| said(sizes).unwrap_or_default();
        assert!(reason([41, 41, 41]).starts_with("41 joints are more than the 40"));
        // A universal joint, and a free base.
        for sizes in [[6, 7, 7], [7, 13, 12]] {
            assert!(
                reason(sizes).contains("joints of one coordinate"),
                "{sizes:?}"
            );
        }
        assert!(refusal(&json!({ "sizes": [21, 21, 21] }), 20).is_some());
    }
}
