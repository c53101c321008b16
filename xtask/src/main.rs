//! `cargo xtask …`: set-up, demo, test and reports.

mod accuracy;
mod bars;
mod bracket;
mod budgets;
mod build_time;
mod callgraph;
mod chart;
mod cores;
mod costs;
mod demo;
mod docs;
mod effects;
mod elf;
mod endurance;
mod error;
mod firmware;
mod flags;
mod flexible;
mod growth;
mod hard_cases;
mod history;
mod host_bin;
mod host_table;
mod import;
mod layers;
mod lines;
mod meter;
mod mutants;
mod output;
mod own_robot;
mod peers;
mod pil;
mod plot;
mod processes;
mod progress;
mod protocol;
mod qemu;
mod render;
mod report;
mod robots;
mod same_code;
mod scene;
mod scenes;
mod setup;
mod shell;
mod silicon;
mod system;
mod table;
mod test;
mod toolchain;
mod trial;
mod user_firmware;
mod watch;
mod workspace;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::error::{Result, check};

/// Set-up, demo, tests and reports of this workspace
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    setup: setup::Options,
    /// Write reports and their pictures into this directory instead of docs/ (budgets stay where they are)
    #[arg(long, global = true, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Subcommand)]
enum Command {
    /// Run a scene in QEMU, report what a tick costs and how well the arm tracks
    Demo(demo::Args),
    /// Measure what each algorithm costs on each robot, rewrite docs/costs.md
    Costs(costs::Args),
    /// Run the control loop on every core that QEMU emulates: the same bits, instructions, stack
    Cores(cores::Args),
    /// Measure how the core's algorithms grow with a chain's length, rewrite docs/growth.md
    Growth(Json),
    /// Measure what today's algorithms replaced, rewrite docs/history.md
    History(Json),
    /// Measure what each effect costs and the torque it contributes, rewrite docs/effects.md
    Effects(Json),
    /// Measure what accuracy costs in time, rewrite docs/accuracy.md and its plots; or choose a configuration
    Accuracy(accuracy::Args),
    /// Write the Rust file of a robot from URDF or MJCF, with advice, a check, and what its inverse dynamics costs
    Import(import::Args),
    /// Write a firmware project, or with --c a static library for C, for a robot from URDF or MJCF
    New(import::New),
    /// Import, check and measure the robots of published packages, rewrite docs/robots.md: takes minutes
    Robots(robots::Args),
    /// Measure a firmware of your own between its markers, and check its instructions
    #[command(after_long_help = user_firmware::MARKERS)]
    Meter(user_firmware::Args),
    /// Measure on the host which of the two eliminations is less accurate where, rewrite
    /// docs/eliminations.md
    Eliminations,
    /// Measure on the host what breaks dynamics codes, rewrite docs/hard-cases.md
    HardCases(Json),
    /// Measure on the host how accurate dynamics with kinematic loops are, rewrite docs/loops.md
    Loops,
    /// Measure on the host what few modes leave out of links that bend, rewrite docs/flexible.md
    Flexible,
    /// Measure other libraries and this one side by side, rewrite docs/peers.md: takes minutes
    Peers(peers::Args),
    /// Measure code whose cycles others published from chips, rewrite docs/silicon.md
    Silicon(silicon::Args),
    /// Time release builds with and without one specialised function, rewrite docs/build-time.md
    BuildTime(Json),
    /// Feed descriptions, files, dynamics, controller and encoder frames random bytes; CI does so for a moment
    Fuzz {
        /// Seconds for each target
        #[arg(long, default_value_t = 60, value_name = "N")]
        seconds: u64,
    },
    /// Run the control loop under random faults; CI does so for 200,000 ticks
    Soak {
        /// Ticks
        #[arg(long, default_value_t = 10_000_000, value_name = "N")]
        ticks: u64,
    },
    /// Change the code in a few hundred places, one at a time, and rewrite docs/mutants.md: takes an hour
    Mutants(mutants::Args),
    /// Run the library's unit tests in Miri, where a nightly toolchain has it
    Miri,
    /// Count the lines of code of the library and of the tooling, without tests, comments and blanks
    Lines,
    /// Show the telemetry of a scene in QEMU or of a machine on a serial port, live in the terminal
    Watch(watch::Args),
    /// Compare the scene ur5e with its robot in f64 on the host, processor in the loop, and with its robot inside
    Pil(pil::Args),
    /// Test all that guards correctness, each claim by its cheapest witness
    Test(test::Args),
}

#[derive(clap::Args)]
struct Json {
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
}

fn main() -> ExitCode {
    let cli = Cli::try_parse().unwrap_or_else(|error| {
        // Clap lists the values that it would take, but not the commands and options.
        let valid = valid_words(error.kind());
        let code = error.exit_code();
        if let Err(error) = error.print() {
            // Behind `| head` nobody minds.
            if error.kind() != std::io::ErrorKind::BrokenPipe {
                output::note(&format!("error: cannot print: {error}"));
            }
            std::process::exit(1);
        }
        if let Some(valid) = valid {
            output::note(&format!("\n{valid}"));
        }
        std::process::exit(code);
    });
    match run(cli) {
        Ok(code) => code,
        // As if the signal of the closed pipe had ended it, which is what other programs do.
        Err(error) if error.is_closed_pipe() => ExitCode::from(128 + 13),
        Err(error) => {
            output::note(&format!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

/// What could have stood where a word was not understood.
fn valid_words(kind: ErrorKind) -> Option<String> {
    let mut root = Cli::command();
    root.build();
    let (what, words): (_, Vec<String>) = match kind {
        ErrorKind::InvalidSubcommand => {
            let names = root
                .get_subcommands()
                .map(|command| command.get_name().to_owned());
            ("commands".to_owned(), names.collect())
        }
        ErrorKind::UnknownArgument => {
            let typed = std::env::args().find_map(|word| root.find_subcommand(&word));
            let command = typed.unwrap_or(&root);
            let shown = command
                .get_arguments()
                .filter(|argument| !argument.is_hide_set());
            let options = shown.filter_map(|argument| Some(format!("--{}", argument.get_long()?)));
            (
                format!("options of {}", command.get_name()),
                options.collect(),
            )
        }
        _ => return None,
    };
    Some(format!("valid {what}: {}", words.join(", ")))
}

fn run(cli: Cli) -> Result<ExitCode> {
    processes::end_with_us().map_err(|e| check!("cannot handle signals: {e}"))?;
    if let Some(dir) = cli.out {
        workspace::write_reports_to(dir)?;
    }
    let setup = cli.setup;
    match cli.command {
        Command::Demo(args) => demo::run(setup, args),
        Command::Costs(args) => costs::run(setup, args),
        Command::Cores(args) => cores::run(setup, args),
        Command::Growth(Json { json }) => growth::run(setup, json),
        Command::History(Json { json }) => history::run(setup, json),
        Command::Effects(Json { json }) => effects::run(setup, json),
        Command::Accuracy(wish) => accuracy::run(setup, wish),
        Command::Import(args) => import::run(setup, &args),
        Command::New(args) => import::new(&args),
        Command::Robots(args) => robots::run(setup, &args),
        Command::Meter(args) => user_firmware::run(setup, &args),
        Command::Eliminations => host_table::ELIMINATIONS.run(),
        Command::Loops => host_table::LOOPS.run(),
        Command::Flexible => flexible::run(),
        Command::HardCases(Json { json }) => hard_cases::run(json),
        Command::Peers(args) => peers::run(setup, &args),
        Command::Silicon(args) => silicon::run(setup, &args),
        Command::BuildTime(Json { json }) => build_time::run(setup, json),
        Command::Fuzz { seconds } => endurance::fuzz(seconds),
        Command::Soak { ticks } => endurance::soak(ticks),
        Command::Miri => endurance::miri(),
        Command::Mutants(args) => mutants::run(&args),
        Command::Lines => output::print(&lines::text()?).map(|()| ExitCode::SUCCESS),
        Command::Watch(args) => watch::run(setup, &args),
        Command::Pil(args) => pil::run(setup, &args),
        Command::Test(args) => test::run(setup, &args),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::Cli;

    #[test]
    fn a_file_excludes_what_is_written_or_of_other_robots() {
        let parses = |words: &str| {
            let words = ["cargo xtask"].into_iter().chain(words.split(' '));
            Cli::try_parse_from(words).is_ok()
        };
        for good in [
            "costs --file arm.urdf",
            "costs --file arm.urdf --json",
            "costs --file arm.xml -- --tip hand --lock finger=0.01",
            "accuracy --file arm.urdf",
            "accuracy --file arm.urdf --error 0.05Nm",
            "accuracy --file arm.urdf --cycles 600 --json -- --name arm",
            "accuracy --robot ur5e --cycles 600",
        ] {
            assert!(parses(good), "{good}");
        }
        for bad in [
            "costs --file",
            "costs --file arm.urdf --write-budgets",
            "costs -- --tip hand",
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
