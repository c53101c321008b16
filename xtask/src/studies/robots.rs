//! `cargo xtask robots`: the robots of published packages, imported, checked and measured; rewrites
//! docs/robots.md.

mod page;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::kit::error::{Error, Result, check};
use crate::kit::importer::{self, FULL, Robot};
use crate::kit::progress::Spinner;
use crate::kit::rows::Row;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, output, shell};
use crate::studies::study::Bench;
use page::{compare, page};

const PAGE: &str = "docs/robots.md";
/// The library's robots that the importer writes.
const IMPORTED: &str = "dynamics-core/src/robots/imported";
const LIST: &str = include_str!("robots/list.toml");
/// Robots of one firmware: its compilation takes memory and flash for all of them.
const BATCH: usize = 4;
/// More joints than this take the compiler minutes.
const MOST_JOINTS: u64 = 16;

#[derive(clap::Args)]
pub struct Args {
    /// The Python with pip, and with Pinocchio and MuJoCo for the comparison
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: String,
    /// Only write those robots of the library that are in one of the packages
    #[arg(long, conflicts_with = "json")]
    library: bool,
    /// The report as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
}

#[derive(Deserialize)]
struct List {
    package: Vec<Package>,
}

/// A package of the Python index with descriptions in it.
#[derive(Deserialize)]
struct Package {
    name: String,
    version: String,
    folder: String,
    files: Vec<Entry>,
    #[serde(default)]
    library: Vec<Own>,
}

/// A robot of the library that is written by the importer.
#[derive(Deserialize)]
struct Own {
    name: String,
    file: String,
    options: Vec<String>,
}

#[derive(Deserialize)]
struct Entry {
    name: String,
    file: String,
}

/// A robot of the page; its fields are those of the JSON.
#[derive(Serialize)]
struct Line {
    name: String,
    source: String,
    report: Option<Value>,
    refused: Option<String>,
    /// Core and engine, full inverse dynamics.
    rows: Vec<Row>,
}

/// Imports, measures, writes the page and prints it.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let list: List =
        toml_edit::de::from_str(LIST).map_err(|error| check!("robots/list.toml: {error}"))?;
    let folder = workspace.target.join("robots");
    std::fs::create_dir_all(&folder).map_err(Error::file("create", &folder))?;
    if args.library {
        for package in &list.package {
            write_library(&workspace, package, &folder, &args.python)?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let tools = setup::for_demo(options)?;
    let mut lines = Vec::new();
    for package in &list.package {
        lines.extend(imported(&workspace, package, &folder, &args.python)?);
    }
    measure(&workspace, &tools, &folder, &mut lines)?;
    let page = page(&lines, &tools.toolchain.rustc_version()?);
    workspace::write(&workspace.report(PAGE), &page)?;
    docs::show(args.json, &lines, &page)
}

/// Writes the robots of the library that are in a package.
fn write_library(
    workspace: &Workspace,
    package: &Package,
    folder: &Path,
    python: &str,
) -> Result<()> {
    if package.library.is_empty() {
        return Ok(());
    }
    let unpacked = unpacked(package, folder, python)?.join(&package.folder);
    for own in &package.library {
        let file = workspace.root.join(IMPORTED).join(format!("{}.rs", own.name));
        let path = unpacked.join(&own.file).to_string_lossy().into_owned();
        let mut words = vec![&*path, "--name", &own.name];
        words.extend(own.options.iter().map(String::as_str));
        let written = importer::import(workspace, &words, file)?.file;
        output::note(&format!("written: {}", written.display()));
    }
    Ok(())
}

/// The robots of a package, each imported or refused.
fn imported(
    workspace: &Workspace,
    package: &Package,
    folder: &Path,
    python: &str,
) -> Result<Vec<Line>> {
    let unpacked = unpacked(package, folder, python)?;
    let spinner = Spinner::start("importing");
    let mut lines = Vec::new();
    for entry in &package.files {
        spinner.say(format!("importing {}", entry.name));
        let path = unpacked.join(&package.folder).join(&entry.file);
        let path = path.to_string_lossy().into_owned();
        let words = [&*path, "--name", &entry.name];
        let imported =
            importer::import(workspace, &words, folder.join(format!("{}.rs", entry.name)));
        let (report, refused) = match imported {
            Ok(robot) => (Some(robot.report), None),
            Err(error) => (None, Some(error.to_string())),
        };
        lines.push(Line {
            name: entry.name.clone(),
            source: format!("{} {}, `{}`", package.name, package.version, entry.file),
            report,
            refused,
            rows: Vec::new(),
        });
    }
    Ok(lines)
}

/// The folder of a package's files, downloaded once.
fn unpacked(package: &Package, folder: &Path, python: &str) -> Result<PathBuf> {
    let name = format!("{}-{}", package.name, package.version);
    let unpacked = folder.join(&name);
    if unpacked.is_dir() {
        return Ok(unpacked);
    }
    let _spinner = Spinner::start(&format!("downloading {name}"));
    let wheels = folder.join(format!("{name}-wheel"));
    let requirement = format!("{}=={}", package.name, package.version);
    let mut pip = Command::new(python);
    pip.args(["-m", "pip", "download", "--quiet", "--no-deps", "--dest"]);
    shell::capture(pip.arg(&wheels).arg(requirement))?;
    let files = std::fs::read_dir(&wheels).map_err(Error::file("read", &wheels))?;
    for wheel in files.flatten() {
        let mut unzip = Command::new(python);
        unzip.args(["-m", "zipfile", "-e"]);
        shell::capture(unzip.arg(wheel.path()).arg(&unpacked))?;
    }
    Ok(unpacked)
}

/// Measures all robots that the firmware takes, some at a time.
fn measure(workspace: &Workspace, tools: &Tools, folder: &Path, lines: &mut [Line]) -> Result<()> {
    let mut robots = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let Some(report) = &line.report else { continue };
        let robot =
            Robot { file: folder.join(format!("{}.rs", line.name)), report: report.clone() };
        let joints = robot.report["sizes"][2].as_u64();
        if importer::is_measurable(&robot) && joints <= Some(MOST_JOINTS) {
            robots.push((i, robot));
        }
    }
    for batch in robots.chunks(BATCH) {
        let robots: Vec<&Robot> = batch.iter().map(|(_, robot)| robot).collect();
        for row in importer::measure(workspace, tools, &robots, FULL)? {
            let number: usize = row.robot.parse().map_err(|_| check!("a row of no robot"))?;
            lines[batch[number].0].rows.push(row);
        }
    }
    Ok(())
}

/// The description that the repository has, and its line of the page.
const SAMPLE: (&str, &str) = ("tools/robot-import/tests/urdf/so101.urdf", "so101");

/// Fails unless the page has today's figures of the sample, measured with the page's compiler.
pub fn check(bench: &Bench<'_>) -> Result<String> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let (file, name) = SAMPLE;
    let folder = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let path = workspace.root.join(file).to_string_lossy().into_owned();
    let words = [&*path, "--name", name];
    let robot = importer::import(workspace, &words, folder.path().join("robot.rs"))?;
    let rows = importer::measure(workspace, tools, &[&robot], FULL)?;
    let line = Line {
        name: name.to_owned(),
        source: String::new(),
        report: Some(robot.report),
        refused: None,
        rows,
    };
    let rustc = tools.toolchain.rustc_version()?;
    let written = workspace::read(&workspace.root.join(PAGE))?;
    let same_compiler = docs::rustc_of(&written) == Some(&*rustc);
    compare(&written, &page(&[line], &rustc), name, same_compiler)?;
    Ok(format!("{name}, {}", if same_compiler { "measured" } else { "another compiler" }))
}
