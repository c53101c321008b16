//! The command line: what a user types first, and the laboratory's commands apart.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::commands::{demo, identify, import, meter, test, watch};
use crate::kit::error::{Result, VERBOSE, check};
use crate::kit::{output, processes, setup, workspace};
use crate::studies;

/// Set-up, demo, tests and reports of this workspace
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
#[command(subcommand_required = true, arg_required_else_help = true)]
pub struct Cli {
    /// None if a study's is chosen.
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    setup: setup::Options,
    /// Write reports and their pictures into this directory instead of docs/ (budgets stay where
    /// they are)
    #[arg(long, global = true, value_name = "DIR")]
    reports: Option<PathBuf>,
    /// Name the program behind an error of `new` and `import` first
    #[arg(long, global = true)]
    verbose: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Run a scene in QEMU, report what a tick costs and how well the arm tracks
    Demo(demo::Args),
    /// Test all that guards correctness, each claim by its cheapest witness
    Test(test::Args),
    /// Write a project for a robot from URDF or MJCF: firmware, simulated or with --board for a
    /// board, or with --c a library for C
    New(import::New),
    /// Write the Rust file of a robot from URDF or MJCF, with advice, a check, and what its inverse
    /// dynamics costs
    Import(import::Args),
    /// Measure a firmware of your own between its markers, and check its instructions
    #[command(after_long_help = meter::MARKERS)]
    Meter(meter::Args),
    /// Show and record the telemetry of a scene or of your project in QEMU, or of a machine on a
    /// serial port
    Watch(watch::Args),
    /// Find masses, inertias and frictions of a robot from a record of `watch`, for its file
    Identify(identify::Args),
}

/// The commands for users, in the order of the help; all others are the laboratory's.
const FIRST: [&str; 9] =
    ["demo", "test", "new", "import", "meter", "watch", "identify", "costs", "accuracy"];

const LABORATORY: &str = "\x1b[1;4mLaboratory, which writes the pages of docs/\x1b[0m";

/// All commands; those of the laboratory stand behind the help's other parts.
fn command() -> clap::Command {
    let place = |name: &str| FIRST.iter().position(|first| *first == name);
    let last = |arg: clap::Arg| arg.display_order(900);
    let root = Cli::command().mut_args(last).subcommands(studies::commands());
    let root = root.mut_subcommands(|command| match place(command.get_name()) {
        Some(place) => command.display_order(place),
        None => command.hide(true),
    });
    let hidden = root.get_subcommands().filter(|command| command.is_hide_set());
    let lines = hidden.map(|command| {
        let about = command.get_about().map(ToString::to_string);
        format!("\n  {:13} {}", command.get_name(), about.unwrap_or_default())
    });
    let laboratory = format!("{LABORATORY}:{}", lines.collect::<String>());
    root.after_help(laboratory)
}

/// The command line of this process, or what is wrong with it, or the help that was asked for.
pub fn parse() -> std::result::Result<(Cli, ArgMatches), clap::Error> {
    let matches = command().try_get_matches()?;
    Ok((Cli::from_arg_matches(&matches)?, matches))
}

/// Prints help or what is wrong with the command line.
pub fn explain(error: &clap::Error) -> i32 {
    if let Err(error) = error.print() {
        // A reader such as `head` may close the pipe early.
        if error.kind() != std::io::ErrorKind::BrokenPipe {
            output::note(&format!("error: cannot print: {error}"));
        }
        return 1;
    }
    error.exit_code()
}

pub fn run((cli, matches): (Cli, ArgMatches)) -> Result<ExitCode> {
    processes::end_with_us().map_err(|e| check!("cannot handle signals: {e}"))?;
    VERBOSE.store(cli.verbose, Ordering::Relaxed);
    if let Some(dir) = cli.reports {
        workspace::write_reports_to(dir)?;
    }
    let setup = cli.setup;
    if let Some((study, matches)) = studies::chosen(&matches) {
        return study.run(setup, matches);
    }
    match cli.command.expect("clap requires a command") {
        Command::Demo(args) => demo::run(setup, args),
        Command::Test(args) => test::run(setup, &args),
        Command::New(args) => import::new(&args),
        Command::Import(args) => import::run(setup, args),
        Command::Meter(args) => meter::run(setup, &args),
        Command::Watch(args) => watch::run(setup, &args),
        Command::Identify(args) => identify::run(&args.arguments),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect_file;

    use super::command;

    #[test]
    fn the_help_shows_a_users_commands_before_the_laboratorys() {
        let help = command().term_width(100).render_help().to_string();
        expect_file!["help.txt"].assert_eq(&help);
    }

    #[test]
    fn a_file_excludes_other_robots() {
        let parses = |words: &str| {
            let words = ["cargo xtask"].into_iter().chain(words.split(' '));
            command().try_get_matches_from(words).is_ok()
        };
        for good in [
            "costs --file arm.urdf",
            "costs --file arm.urdf --json",
            "costs --file arm.xml --tip hand --lock finger=0.01",
            "accuracy --file arm.urdf",
            "accuracy --file arm.urdf --error 0.05Nm",
            "accuracy --file arm.urdf --cycles 600 --json --name arm",
            "accuracy --robot ur5e --cycles 600",
        ] {
            assert!(parses(good), "{good}");
        }
        for bad in [
            "costs --file",
            "costs --tip hand",
            "accuracy --file arm.urdf --robot ur5e",
            "accuracy --file arm.urdf --error 0.05Nm --cycles 600",
            "accuracy --file arm.urdf --error 0.05",
            "accuracy --cycles 600",
            "accuracy --error 0.05Nm",
        ] {
            assert!(!parses(bad), "{bad}");
        }
    }
}
