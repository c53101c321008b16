//! `robot-import`: robots from URDF or MJCF as constants of dynamics-core, and projects of one's
//! own for them.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use robot_import::import;
use robot_import::project::{self, Board, Framework, Kind, Library, Project};
use robot_import::text::visible;

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
    /// Write a firmware project, or a static library for C, for a robot
    New(New),
}

#[derive(clap::Args)]
struct New {
    /// The folder; its name is the project's
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// The description: URDF or MJCF
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    /// Firmware for this board, such as nucleo-f446re; a wrong name lists all. Without it the
    /// firmware drives a simulation
    #[arg(long, value_name = "BOARD")]
    board: Option<String>,
    /// The board's firmware under Embassy
    #[arg(long, requires = "board", conflicts_with = "rtic")]
    embassy: bool,
    /// The board's firmware under RTIC
    #[arg(long, requires = "board")]
    rtic: bool,
    /// A static library with a header for C in place of firmware in Rust
    #[arg(long, conflicts_with = "board")]
    c: bool,
    /// Depend on the crates of this repository of dynamics-core in place of a copy of them in the
    /// project
    #[arg(long, value_name = "ADDRESS", conflicts_with = "library")]
    git: Option<String>,
    /// Depend on the crates beside this folder of the crate dynamics-core in place of a copy of
    /// them
    #[arg(long, value_name = "FOLDER")]
    library: Option<PathBuf>,
    #[command(flatten)]
    options: import::Options,
}

fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Import(args) => import(&args),
        Command::New(args) => new(args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // It names what the file has, whose control characters are not for the terminal.
            let text = error.to_string();
            let lines: Vec<String> = text.lines().map(visible).collect();
            eprintln!(
                "error: {}",
                lines.join(
                    "
"
                )
            );
            ExitCode::FAILURE
        }
    }
}

fn import(args: &import::Args) -> Result<(), Box<dyn std::error::Error>> {
    let imported = import::run(args, &today())?;
    let json = serde_json::to_string_pretty(&imported.report)? + "\n";
    if let Some(file) = &args.report {
        robot_import::outputs::write(file, &json)?;
    }
    let report = match args.json {
        true => json,
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

fn new(args: New) -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::path::absolute(&args.folder)?;
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let framework = match (args.embassy, args.rtic) {
        (true, _) => Some(Framework::Embassy),
        (_, true) => Some(Framework::Rtic),
        _ => None,
    };
    let kind = match (&args.board, args.c) {
        (Some(board), _) => Kind::Board(Board::find(board, framework)?),
        (None, true) => Kind::C,
        (None, false) => Kind::Simulation,
    };
    let library = match (args.library, args.git) {
        (Some(path), _) => Library::Path(std::path::absolute(path)?),
        (None, Some(address)) => Library::Git(address),
        (None, None) => Library::own(),
    };
    project::check_folder(&folder, &name)?;
    let imported = import::import(
        &import::Args {
            file: args.robot,
            options: args.options,
            name: Some(name.clone()),
            ..import::Args::default()
        },
        &today(),
    )?;
    let created =
        project::create(&folder, &Project { name, robot: imported.robot_file(), library, kind })?;
    print!("{}", imported.report.text());
    println!("\nwritten into {}:", folder.display());
    let paths = (created.files.iter()).map(|file| file.strip_prefix(&folder).unwrap_or(file));
    let (copied, own): (Vec<_>, Vec<_>) = paths.partition(|path| path.starts_with("libraries"));
    for path in own {
        println!("  {}", path.display());
    }
    if !copied.is_empty() {
        println!("  libraries: a copy of the library, {} files", copied.len());
    }
    if let Some(reason) = created.robot_only {
        println!("\nnote: {reason}");
    } else {
        let next = match kind {
            Kind::Simulation => "cargo qemu",
            Kind::C => "make run",
            Kind::Board(_) => "cargo build --release; README.md says what to connect",
        };
        println!("\nnext: cd {} && {next}", args.folder.display());
    }
    for note in created.notes {
        println!("note: {}", visible(&note));
    }
    Ok(())
}

/// The day in UTC.
fn today() -> String {
    let today = time::OffsetDateTime::now_utc();
    format!("{}-{:02}-{:02}", today.year(), u8::from(today.month()), today.day())
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use clap::CommandFactory;
    use expect_test::expect_file;

    use super::Cli;

    /// `cargo xtask` declares the options of its `import` and `new` from this list.
    #[test]
    fn the_list_of_options_is_that_of_the_program() {
        let mut list = String::new();
        for command in Cli::command().get_subcommands() {
            for arg in command.get_arguments() {
                let long = arg.get_long().map_or("-".to_owned(), |long| format!("--{long}"));
                let value = match arg.get_action().takes_values() {
                    true => arg.get_value_names().unwrap_or_default().concat(),
                    false => "-".to_owned(),
                };
                let required = if arg.is_required_set() { "!" } else { "" };
                let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
                let default: Vec<_> = (arg.get_default_values().iter())
                    .filter(|_| arg.get_action().takes_values())
                    .map(|value| format!(" [default: {}]", value.to_string_lossy()))
                    .collect();
                let name = command.get_name();
                let _ =
                    writeln!(list, "{name} {long} {value}{required} {help}{}", default.concat());
            }
        }
        expect_file!["../options.txt"].assert_eq(&list);
    }
}
