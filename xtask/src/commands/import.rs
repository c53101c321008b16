//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse dynamics costs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Arg, ArgAction, ArgMatches};

use crate::kit::error::{Error, Result};
use crate::kit::importer::{ALL, Robot, command, measure, report};
use crate::kit::meter::MODEL;
use crate::kit::rows::Row;
use crate::kit::setup::{self, Options};
use crate::kit::table::{Table, thousands};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, output};

/// A file, and the options of `robot-import import`.
#[derive(clap::Args)]
pub struct Args {
    /// The description, URDF or MJCF
    #[arg(value_name = "FILE")]
    file: String,
    #[command(flatten)]
    passed: Passed<false>,
    /// Do not measure in QEMU what inverse dynamics costs
    #[arg(long)]
    no_measure: bool,
}

/// A folder, and the options of `robot-import new`.
#[derive(clap::Args)]
pub struct New {
    /// The folder; its name is the project's
    #[arg(value_name = "FOLDER")]
    folder: String,
    #[command(flatten)]
    passed: Passed<true>,
}

/// The options of `robot-import import`, or of its `new`, passed on as they are. It lists them itself, which a test there
/// compares: the subcommand, the option, its value (`-`: none; `!`: required) and its help.
const OPTIONS: &str = include_str!("../../../robot-import/options.txt");

struct Passed<const NEW: bool>(Vec<(&'static str, Option<String>)>);

impl<const NEW: bool> Passed<NEW> {
    fn listed() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
        let own = if NEW { "new --" } else { "import --" };
        OPTIONS.lines().filter_map(move |line| {
            let mut words = line.strip_prefix(own)?.splitn(3, ' ');
            Some((words.next()?, words.next()?, words.next()?))
        })
    }

    /// The last value of an option, which is not passed on.
    fn take(&mut self, name: &str) -> Option<Option<String>> {
        let place = self.0.iter().rposition(|(own, _)| *own == name)?;
        Some(self.0.remove(place).1)
    }

    fn words(&self) -> impl Iterator<Item = String> {
        self.0.iter().map(|(name, value)| match value {
            Some(value) => format!("--{name}={value}"),
            None => format!("--{name}"),
        })
    }
}

impl<const NEW: bool> clap::FromArgMatches for Passed<NEW> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let given = |(name, value, _)| -> Vec<_> {
            match value {
                "-" => vec![(name, None); usize::from(matches.get_flag(name))],
                _ => {
                    let values = matches.get_many::<String>(name).into_iter().flatten();
                    values.map(|value| (name, Some(value.clone()))).collect()
                }
            }
        };
        Ok(Self(Self::listed().flat_map(given).collect()))
    }

    fn update_from_arg_matches(
        &mut self,
        matches: &ArgMatches,
    ) -> std::result::Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<const NEW: bool> clap::Args for Passed<NEW> {
    fn augment_args(command: clap::Command) -> clap::Command {
        command.args(Self::listed().map(|(name, value, help)| {
            let arg = Arg::new(name).long(name).help(help);
            match value.trim_end_matches('!') {
                "-" => arg.action(ArgAction::SetTrue),
                name => arg
                    .value_name(name)
                    .action(ArgAction::Append)
                    .required(value.ends_with('!')),
            }
        }))
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        Self::augment_args(command)
    }
}

/// Writes a project.
pub fn new(args: &New) -> Result<ExitCode> {
    let words: Vec<String> = args.passed.words().chain([args.folder.clone()]).collect();
    output::print(&command(&Workspace::find()?, "new", &words)?)?;
    Ok(ExitCode::SUCCESS)
}

pub fn run(options: Options, mut args: Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let json = args.passed.take("json").is_some();
    let kept = args.passed.take("out").flatten();
    let report_file = args.passed.take("report").flatten();
    let scratch = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let in_scratch = |name| scratch.path().join(name);
    let file = (kept.as_ref()).map_or_else(|| in_scratch("robot.rs"), PathBuf::from);
    let json_file = report_file.map_or_else(|| in_scratch("report.json"), PathBuf::from);
    let named = [("--out", &file), ("--report", &json_file)]
        .map(|(option, path)| format!("{option}={}", path.display()));
    let words: Vec<String> = (args.passed.words().chain(named))
        .chain([args.file.clone()])
        .collect();
    let text = command(&workspace, "import", &words)?;
    let report = report(&workspace::read(&json_file)?)?;
    let robot = Robot { file, report };
    let measured = (!args.no_measure).then(|| {
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
