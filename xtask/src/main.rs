//! `cargo xtask …`: set-up, demo, test and reports.

mod accuracy;
mod bars;
mod budgets;
mod build_time;
mod callgraph;
mod chart;
mod costs;
mod demo;
mod docs;
mod effects;
mod elf;
mod eliminations;
mod endurance;
mod error;
mod firmware;
mod flags;
mod growth;
mod hard_cases;
mod host_bin;
mod meter;
mod output;
mod peers;
mod plot;
mod processes;
mod progress;
mod protocol;
mod qemu;
mod render;
mod report;
mod sameness;
mod scene;
mod scenes;
mod setup;
mod shell;
mod system;
mod table;
mod test;
mod toolchain;
mod user_firmware;
mod workspace;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::error::{Error, Result};
use crate::scene::Scene;

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
    Demo {
        /// The scene
        #[arg(
            long,
            value_enum,
            default_value_t,
            value_name = "NAME",
            ignore_case = true
        )]
        scene: Scene,
        /// Every scene, and one table of all
        #[arg(long, conflicts_with = "scene")]
        all: bool,
        /// The report as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
        /// Rewrite the README's tables (with --all: docs/scenes.md too) from this run
        #[arg(long)]
        write_docs: bool,
        /// Rewrite the scenes' budgets from this run
        #[arg(long)]
        write_budgets: bool,
    },
    /// Measure what each algorithm costs on each robot, rewrite docs/costs.md
    Costs {
        /// The measurements as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
        /// Rewrite the budgets from this run
        #[arg(long)]
        write_budgets: bool,
    },
    /// Measure how the core's algorithms grow with a chain's length, rewrite docs/growth.md
    Growth {
        /// The measurements as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
    },
    /// Measure what each effect costs and the torque it contributes, rewrite docs/effects.md
    Effects {
        /// The measurements as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
    },
    /// Measure what accuracy costs in time, rewrite docs/accuracy.md and its plots; or choose a configuration
    Accuracy {
        /// Only this robot
        #[arg(long, value_enum, value_name = "NAME", ignore_case = true)]
        robot: Option<accuracy::Robot>,
        /// A dozen configurations of each robot, at opt-level 3
        #[arg(long)]
        quick: bool,
        /// The measurements as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
        /// Choose the cheapest configuration off by no more than this: 0.05Nm, 2mrad
        #[arg(
            long,
            value_name = "ERROR",
            allow_hyphen_values = true,
            requires = "robot",
            conflicts_with = "cycles"
        )]
        error: Option<accuracy::Allowed>,
        /// Choose the most accurate configuration whose worst tick takes no more cycles than this
        #[arg(long, value_name = "CYCLES", requires = "robot")]
        cycles: Option<u64>,
        /// Choose from what is measured now, not from docs/accuracy.json
        #[arg(long)]
        measure: bool,
    },
    /// Measure a firmware of your own between its markers, and check its instructions
    #[command(after_long_help = user_firmware::MARKERS)]
    Meter {
        /// The firmware, with its symbols
        #[arg(value_name = "ELF")]
        elf: PathBuf,
        /// The board that QEMU emulates
        #[arg(long, default_value = qemu::MACHINE, value_name = "NAME")]
        machine: String,
        /// Stop it after so many seconds
        #[arg(long, default_value_t = 10, value_name = "N")]
        seconds: u64,
        /// The measurements as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
    },
    /// Measure on the host which of the two eliminations is less accurate where, rewrite
    /// docs/eliminations.md
    Eliminations,
    /// Measure on the host what breaks dynamics codes, rewrite docs/hard-cases.md
    HardCases {
        /// The measurements as JSON on stdout
        #[arg(long)]
        json: bool,
    },
    /// Measure other libraries and this one side by side, rewrite docs/peers.md: takes minutes
    Peers {
        /// The measurements as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
    },
    /// Time release builds with and without one specialised function, rewrite docs/build-time.md
    BuildTime {
        /// The measurements as JSON on stdout; progress stays on stderr
        #[arg(long)]
        json: bool,
    },
    /// Feed descriptions, dynamics, controller and encoder frames random bytes; CI does so for a moment
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
    /// Run the library's unit tests in Miri, where a nightly toolchain has it
    Miri,
    /// Test all that guards correctness, each claim by its cheapest witness
    Test {
        /// Only these steps (see --list)
        #[arg(value_name = "STEP", value_parser = test::names())]
        steps: Vec<String>,
        /// All robots, all scenes, all reports and whether the documents are current: what CI runs
        #[arg(long)]
        full: bool,
        /// List the steps, and the claims that only --full holds
        #[arg(long)]
        list: bool,
        /// Let the step `debian` install Debian's own compiler, as on CI (CI=true)
        #[arg(long)]
        debian: bool,
    },
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
    let commands = root.get_subcommands().map(clap::Command::get_name);
    match kind {
        ErrorKind::InvalidSubcommand => Some(format!(
            "valid commands: {}",
            commands.collect::<Vec<_>>().join(", ")
        )),
        ErrorKind::UnknownArgument => {
            let command = std::env::args()
                .find_map(|word| root.find_subcommand(&word))
                .unwrap_or(&root);
            let options = command
                .get_arguments()
                .filter(|argument| !argument.is_hide_set())
                .filter_map(|argument| Some(format!("--{}", argument.get_long()?)));
            let options = options.collect::<Vec<_>>().join(", ");
            Some(format!(
                "valid options of {}: {options}",
                command.get_name()
            ))
        }
        _ => None,
    }
}

fn run(cli: Cli) -> Result<ExitCode> {
    processes::end_with_us().map_err(|e| Error::check(format!("cannot handle signals: {e}")))?;
    if let Some(dir) = cli.out {
        workspace::write_reports_to(dir)?;
    }
    match cli.command {
        Command::Demo {
            scene,
            all,
            json,
            write_docs,
            write_budgets,
        } => {
            let wish = demo::Wish {
                scenes: if all {
                    Scene::ALL.to_vec()
                } else {
                    vec![scene]
                },
                all,
                json,
                write_docs,
                write_budgets,
            };
            demo::run(cli.setup, wish)
        }
        Command::Costs {
            json,
            write_budgets,
        } => {
            let wish = costs::Wish {
                json,
                write_budgets,
            };
            costs::run(cli.setup, wish)
        }
        Command::Growth { json } => growth::run(cli.setup, json),
        Command::Effects { json } => effects::run(cli.setup, json),
        Command::Accuracy {
            robot,
            quick,
            json,
            error,
            cycles,
            measure,
        } => {
            let budget = error.map(accuracy::Budget::Error);
            let wish = accuracy::Wish {
                robot,
                quick,
                json,
                budget: budget.or(cycles.map(accuracy::Budget::Cycles)),
                measure,
            };
            accuracy::run(cli.setup, wish)
        }
        Command::Meter {
            elf,
            machine,
            seconds,
            json,
        } => {
            let wish = user_firmware::Wish {
                elf,
                machine,
                seconds,
                json,
            };
            user_firmware::run(cli.setup, &wish)
        }
        Command::Eliminations => eliminations::run(),
        Command::HardCases { json } => hard_cases::run(json),
        Command::Peers { json } => peers::run(cli.setup, json),
        Command::BuildTime { json } => build_time::run(cli.setup, json),
        Command::Fuzz { seconds } => endurance::fuzz(seconds),
        Command::Soak { ticks } => endurance::soak(ticks),
        Command::Miri => endurance::miri(),
        Command::Test { list: true, .. } => test::list(),
        Command::Test {
            steps,
            full,
            debian,
            ..
        } => {
            let args = test::Args {
                steps,
                full,
                debian,
            };
            test::run(cli.setup, &args)
        }
    }
}
