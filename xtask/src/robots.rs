//! `cargo xtask robots`: the robots of published packages, imported, checked and measured; rewrites docs/robots.md.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::costs::Row;
use crate::docs;
use crate::error::{Error, Result, check};
use crate::import::{self, Robot, Ways};
use crate::progress::Spinner;
use crate::report::MODEL;
use crate::setup::{self, Options, Tools};
use crate::shell;
use crate::table::{self, Table, thousands};
use crate::workspace::{self, Workspace};

const PAGE: &str = "docs/robots.md";
const LIST: &str = include_str!("robots/list.toml");
/// Robots of one firmware: its compilation takes memory and flash for all of them.
const BATCH: usize = 4;
/// More joints than this take the compiler minutes.
const MOST_JOINTS: u64 = 16;

/// Which robots, and by whom they are compared.
#[derive(clap::Args)]
pub struct Args {
    /// The Python with pip, and with Pinocchio and MuJoCo for the comparison
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: String,
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
    /// The importer's report.
    report: Option<Value>,
    /// Why it is refused.
    refused: Option<String>,
    /// Core and engine, full inverse dynamics.
    rows: Vec<Row>,
}

/// Imports, measures, writes the page and prints it.
pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let tools = setup::for_demo(options)?;
    let list: List = toml::from_str(LIST).map_err(|error| check!("robots/list.toml: {error}"))?;
    let folder = workspace.target.join("robots");
    std::fs::create_dir_all(&folder).map_err(Error::file("create", &folder))?;
    let mut lines = Vec::new();
    for package in &list.package {
        lines.extend(imported(&workspace, package, &folder, &args.python)?);
    }
    measure(&workspace, &tools, &folder, &mut lines)?;
    let page = page(&lines, &tools.toolchain.rustc_version()?);
    workspace::write(&workspace.report(PAGE), &page)?;
    table::show(args.json, &lines, &page)
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
        let words = [&*path, "--name", &entry.name, "--python", python];
        let imported = import::import(workspace, &words, folder.join(format!("{}.rs", entry.name)));
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
        let robot = Robot {
            file: folder.join(format!("{}.rs", line.name)),
            report: report.clone(),
        };
        let joints = robot.report["sizes"][2].as_u64();
        if import::is_measurable(&robot) && joints <= Some(MOST_JOINTS) {
            robots.push((i, robot));
        }
    }
    for batch in robots.chunks(BATCH) {
        let robots: Vec<&Robot> = batch.iter().map(|(_, robot)| robot).collect();
        for row in import::measure(workspace, tools, &robots, Ways::Full)? {
            let number: usize = row.robot.parse().map_err(|_| check!("a row of no robot"))?;
            lines[batch[number].0].rows.push(row);
        }
    }
    Ok(())
}

/// The description that the repository has, and its line of the page.
const SAMPLE: (&str, &str) = ("robot-import/tests/urdf/so101.urdf", "so101");

/// Fails unless the page has today's figures of the sample, measured with the page's compiler.
pub fn check(workspace: &Workspace, tools: &Tools) -> Result<String> {
    let (file, name) = SAMPLE;
    let folder = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let path = workspace.root.join(file).to_string_lossy().into_owned();
    let words = [&*path, "--name", name];
    let robot = import::import(workspace, &words, folder.path().join("robot.rs"))?;
    let rows = import::measure(workspace, tools, &[&robot], Ways::Full)?;
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
    Ok(format!(
        "{name}, {}",
        if same_compiler {
            "measured"
        } else {
            "another compiler"
        }
    ))
}

/// Compares a robot's row of two pages, but for the peer, whom not every machine has.
fn compare(written: &str, fresh: &str, name: &str, same_compiler: bool) -> Result<()> {
    let [old, new] = [written, fresh].map(|page| cells(page, name));
    let (Some(old), Some(new)) = (old, new) else {
        return Err(check!(
            "{PAGE} has no line of {name}: `cargo xtask robots` rewrites it"
        ));
    };
    let measured = if same_compiler { old.len() } else { PEER };
    let differs = |i: &usize| *i != PEER && old.get(*i) != new.get(*i);
    match (0..measured).find(differs) {
        None => Ok(()),
        Some(i) => Err(check!(
            "{PAGE} is out of date: `cargo xtask robots` rewrites it\n  there: {}\n  now:   {}",
            old[i],
            new.get(i).map_or("", |cell| cell)
        )),
    }
}

/// The column of the peer.
const PEER: usize = 4;

/// The cells of a robot's row.
fn cells<'a>(page: &'a str, name: &str) -> Option<Vec<&'a str>> {
    let mut rows = page.lines().filter(|line| line.starts_with("| "));
    rows.find_map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        (cells.first() == Some(&name)).then_some(cells)
    })
}

fn page(lines: &[Line], rustc: &str) -> String {
    let mut table = Table::new(&[
        "robot",
        "joints",
        "advice",
        "f32 error",
        "against the peer",
        "core, cycles",
        "engine, cycles",
        "core, B",
        "engine, B",
    ]);
    let mut sources = String::new();
    let mut refused = String::new();
    for line in lines {
        sources += &format!("- `{}`: {}\n", line.name, line.source);
        let Some(report) = &line.report else {
            let reason = line.refused.as_deref().unwrap_or_default();
            refused += &format!("- `{}`: {}\n", line.name, reason.trim());
            continue;
        };
        let number = |value: &Value| {
            value
                .as_f64()
                .map_or("–".to_owned(), |x| format!("{x:.1e}"))
        };
        let figure = |form: &str, of: fn(&Row) -> u64| {
            let row = line.rows.iter().find(|row| row.form == form);
            row.map_or("–".to_owned(), |row| thousands(of(row)))
        };
        table.row([
            line.name.clone(),
            report["sizes"][2].to_string(),
            topics(&report["advice"]),
            number(&report["check"]["f32"]),
            number(&report["peer"]["difference"]),
            figure("core", |row| row.cycles.max),
            figure("engine", |row| row.cycles.max),
            figure("core", |row| row.code_bytes),
            figure("engine", |row| row.code_bytes),
        ]);
    }
    if refused.is_empty() {
        refused = "None.\n".to_owned();
    }
    let count = lines.iter().filter(|line| line.report.is_some()).count();
    format!(
        include_str!("robots/page.md"),
        count = count,
        model = MODEL,
        table = table.markdown(),
        refused = refused,
        sources = sources,
        rustc = rustc,
    )
}

/// How many pieces of advice there are of each topic.
fn topics(advice: &Value) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for one in advice.as_array().into_iter().flatten() {
        *counts
            .entry(one["topic"].as_str().unwrap_or_default())
            .or_default() += 1;
    }
    let words: Vec<String> = counts
        .iter()
        .map(|(topic, count)| format!("{count} {topic}"))
        .collect();
    match words.is_empty() {
        true => "–".to_owned(),
        false => words.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::compare;

    #[test]
    fn a_row_with_another_figure_is_out_of_date_but_for_the_peer() {
        let page = |cycles: &str, peer: &str| {
            format!("| so101 | 6 | – | 1e-7 | {peer} | 2 | {cycles} | 3 | 4 |")
        };
        let (old, new) = (page("990", "1e-16"), page("989", "–"));
        assert!(compare(&old, &page("990", "–"), "so101", true).is_ok());
        assert!(compare(&old, &new, "so101", true).is_err());
        // Another compiler has other cycles.
        assert!(compare(&old, &new, "so101", false).is_ok());
        assert!(compare(&old, &new, "so100", true).is_err());
    }
}
