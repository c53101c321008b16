//! `robot-import`: robots from URDF or MJCF as constants of dynamics-core.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use robot_import::error::Result;
use robot_import::import;

/// Robots from URDF or MJCF as constants of dynamics-core
#[derive(Parser)]
#[command(version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Write the Rust file of a robot, with advice and a check
    Import(import::Args),
}

fn main() -> ExitCode {
    match run(Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(cli: Cli) -> Result<()> {
    let Command::Import(args) = cli.command;
    let imported = import::run(&args, &today())?;
    let report = match args.json {
        true => serde_json::to_string_pretty(&imported.report).unwrap_or_default() + "\n",
        false => imported.report.text(),
    };
    match (&args.out, args.json) {
        (None, false) => {
            eprint!("{report}");
            print!("{}", imported.source);
        }
        _ => print!("{report}"),
    }
    Ok(())
}

/// The day in UTC.
fn today() -> String {
    let today = time::OffsetDateTime::now_utc();
    format!(
        "{}-{:02}-{:02}",
        today.year(),
        u8::from(today.month()),
        today.day()
    )
}
