//! `robot-import`: robots from URDF or MJCF as constants of dynamics-core, and projects of one's own for them.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use robot_import::import;
use robot_import::project::{self, Library, Project};
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
    /// A static library with a header for C in place of firmware in Rust
    #[arg(long)]
    c: bool,
    /// The folder of the crate dynamics-core
    #[arg(
        long,
        value_name = "FOLDER",
        required_unless_present = "git",
        conflicts_with = "git"
    )]
    library: Option<PathBuf>,
    /// The address of the repository of dynamics-core
    #[arg(long, value_name = "ADDRESS")]
    git: Option<String>,
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
        std::fs::write(file, &json).map_err(|error| format!("{}: {error}", file.display()))?;
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
    let name = folder
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let imported = import::import(
        &import::Args {
            file: args.robot,
            options: args.options,
            name: Some(name.clone()),
            ..import::Args::default()
        },
        &today(),
    )?;
    print!("{}", imported.report.text());
    let library = match (args.library, args.git) {
        (Some(path), _) => Library::Path(std::path::absolute(path)?),
        (None, git) => Library::Git(git.unwrap_or_default()),
    };
    let robot = imported.robot_file();
    let c = args.c;
    let created = project::create(
        &folder,
        &Project {
            name,
            robot,
            library,
            c,
        },
    )?;
    println!("\nwritten into {}:", folder.display());
    for file in &created.files {
        println!("  {}", file.strip_prefix(&folder).unwrap_or(file).display());
    }
    if let Some(reason) = created.robot_only {
        println!("\nnote: {reason}");
    } else {
        println!(
            "\nnext: cd {} && {}",
            args.folder.display(),
            if c { "make run" } else { "cargo qemu" }
        );
    }
    if let Some(note) = created.note {
        println!("note: {note}");
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
