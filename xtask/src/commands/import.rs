//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse
//! dynamics costs.

use std::path::Path;
use std::process::ExitCode;

use crate::kit::error::{Error, Result};
use crate::kit::importer::passed::{IMPORT, NEW, Passed};
use crate::kit::importer::{Robot, command, measure, report};
use crate::kit::meter::{CHIPS, IN_FLASH, MODEL};
use crate::kit::rows::Row;
use crate::kit::setup::{self, Options};
use crate::kit::table::{Table, thousands};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, output};

/// A file, and the options of `robot-import import`.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    passed: Passed<IMPORT>,
    /// Do not measure in QEMU what inverse dynamics costs
    #[arg(long)]
    no_measure: bool,
}

/// The arguments of `robot-import new`.
pub type New = Passed<NEW>;

/// Writes a project.
pub fn new(args: &New) -> Result<ExitCode> {
    output::print(&command(&Workspace::find()?, "new", &args.0)?)?;
    Ok(ExitCode::SUCCESS)
}

pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let scratch = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let mut passed = args.passed;
    let json = passed.take("--json").is_some();
    let [kept, reported] = ["--out=", "--report="].map(|option| passed.take(option));
    let scratch = |name| scratch.path().join(name).display().to_string();
    let file = kept.clone().unwrap_or_else(|| scratch("robot.rs"));
    let json_file = reported.unwrap_or_else(|| scratch("report.json"));
    let written = [format!("--out={file}"), format!("--report={json_file}")];
    passed.0.extend(written);
    let text = command(&workspace, "import", &passed.0)?;
    let report = report(&workspace::read(json_file.as_ref())?)?;
    let file = file.into();
    let robot = Robot { file, report };
    let measured = (!args.no_measure)
        .then(|| setup::for_demo(options).and_then(|tools| measure(&workspace, &tools, &[&robot])));
    if json {
        let mut report = robot.report;
        let rows = measured.transpose().unwrap_or_default();
        report["measured"] = serde_json::to_value(rows.unwrap_or_default()).unwrap_or_default();
        docs::print_json(&report)?;
        return Ok(ExitCode::SUCCESS);
    }
    // A measured figure is not estimated.
    let is_measured = matches!(&measured, Some(Ok(rows)) if !rows.is_empty());
    output::print(if is_measured { without_estimate(&text) } else { &text })?;
    match measured {
        Some(Ok(rows)) => {
            output::print(&format!("\n{MODEL}. {IN_FLASH}:\n{}", table(&rows).text()))?
        }
        Some(Err(error)) => output::note(&format!("not measured: {error}")),
        None => {}
    }
    show(&robot.file, kept.is_some())?;
    Ok(ExitCode::SUCCESS)
}

/// The importer's report up to its last paragraph, the estimate of the cycles.
fn without_estimate(text: &str) -> &str {
    let estimate = "\nInverse dynamics by the engine: about ";
    text.rsplit_once(estimate).map_or(text, |(before, _)| before)
}

/// The file itself, where it is not kept.
fn show(file: &Path, kept: bool) -> Result<()> {
    match kept {
        true => output::print(&format!("\nwritten: {}\n", file.display())),
        false => output::print(&format!("\n{}", workspace::read(file)?)),
    }
}

pub fn table(rows: &[Row]) -> Table {
    let [first, second] = CHIPS;
    let head = ["inverse dynamics", "form", "cycles", first, second, "instructions"];
    let mut table = Table::new(&[&head[..], &["code, B", "stack, B"]].concat());
    for row in rows {
        let [first, second] = row.in_flash.map(|flash| flash.max);
        let cycles = [row.cycles.max, first, second];
        let figures = [row.instructions.max, row.code_bytes, row.stack_bytes];
        let figures = cycles.into_iter().chain(figures);
        let names = [row.inputs.clone(), row.form.clone()];
        table.row(names.into_iter().chain(figures.map(thousands)));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::without_estimate;

    #[test]
    fn no_estimate_stands_beside_a_measurement() {
        let report = "Advice:\n  none\n\nInverse dynamics by the engine: about 740 cycles on a \
            Cortex-M4F and 2664 B of code (estimated).\n";
        assert_eq!(without_estimate(report), "Advice:\n  none\n");
        assert_eq!(without_estimate("Advice:\n  none\n"), "Advice:\n  none\n");
    }
}
