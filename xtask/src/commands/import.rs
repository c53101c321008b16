//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse dynamics costs.

use std::path::Path;
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
    #[command(flatten)]
    passed: Passed<false>,
    /// Do not measure in QEMU what inverse dynamics costs
    #[arg(long)]
    no_measure: bool,
}

/// The arguments of `robot-import`: subcommand, option (`-`: none), value (`-`: none; `!`: required), help. A test there compares
/// this list with what it takes.
const OPTIONS: &str = include_str!("../../../robot-import/options.txt");

/// The arguments of its `import` or `new`, passed on as they are.
pub struct Passed<const NEW: bool>(Vec<String>);

impl<const NEW: bool> Passed<NEW> {
    fn listed() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
        OPTIONS.lines().filter_map(|line| {
            let rest = line.strip_prefix(if NEW { "new " } else { "import " })?;
            let (name, rest) = rest.split_once(' ')?;
            let (value, help) = rest.split_once(' ')?;
            Some((name, value, help))
        })
    }

    /// The value of an option that is not passed on.
    fn take(&mut self, option: &str) -> Option<String> {
        let place = self.0.iter().rposition(|word| word.starts_with(option))?;
        Some(self.0.remove(place).split_off(option.len()))
    }
}

impl<const NEW: bool> clap::FromArgMatches for Passed<NEW> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let given = |(name, value, _)| {
            if value == "-" {
                return vec![String::from(name); usize::from(matches.get_flag(name))];
            }
            let values = matches.get_many::<String>(name).into_iter().flatten();
            let option = if name == "-" {
                String::new()
            } else {
                format!("{name}=")
            };
            values.map(|value| format!("{option}{value}")).collect()
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
            let required = value.ends_with('!');
            let action = match value {
                "-" => ArgAction::SetTrue,
                _ if required => ArgAction::Set,
                _ => ArgAction::Append,
            };
            let arg = Arg::new(name).help(help).action(action).required(required);
            let arg = arg.value_name(value.trim_end_matches('!'));
            name.strip_prefix("--").into_iter().fold(arg, Arg::long)
        }))
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        Self::augment_args(command)
    }
}

/// Writes a project.
pub fn new(args: &Passed<true>) -> Result<ExitCode> {
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
