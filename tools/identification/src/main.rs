//! The parameters of a robot's file from a recording of its ticks: what `cargo xtask identify`
//! runs.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use identification::files::error::{Error, Result};
use identification::files::map::Map;
use identification::files::recorded::Recorded;
use identification::files::robot::Robot;
use identification::files::run::{self, JointEffect, Options};
use identification::files::{paste, picture};

/// The parameters of a robot's file from a recording of its ticks
#[derive(Parser)]
struct Args {
    /// The recording: of `cargo xtask watch --record FILE`, or any CSV or MCAP with --columns
    #[arg(value_name = "FILE")]
    recording: PathBuf,
    /// The description of the robot, URDF or MJCF
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    /// Which columns of the recording are what, in which units; of a known layout not needed
    #[arg(long, value_name = "TOML")]
    columns: Option<PathBuf>,
    /// The robot's name in its Rust file: that of the project's folder; that of the description if
    /// not given
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// The effects at joints that are identified; the others stay as described
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        default_value = "viscous,coulomb,armature,offset"
    )]
    effects: Vec<JointEffect>,
    /// Compare with this recording of another path, instead of with the last part of the first one
    #[arg(long, value_name = "FILE")]
    validate: Option<PathBuf>,
    /// The speed below which Coulomb friction fades, rad/s or m/s
    #[arg(long, value_name = "W", default_value = "0.02", value_parser = positive)]
    width: f64,
    /// Compare torques up to this frequency, Hz; the highest that the ticks allow, at most 10, if
    /// not given
    #[arg(long, value_name = "HZ", value_parser = positive)]
    cutoff: Option<f64>,
    /// The direction of gravity in the frame of the base, of an arm on a wall or a ceiling
    #[arg(
        long,
        value_name = "X,Y,Z",
        default_value = "0,0,-1",
        allow_hyphen_values = true,
        value_parser = direction
    )]
    gravity: [f64; 3],
    /// Write the robot's Rust file with what was found
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    /// Draw torques, residuals and friction into this file; beside the recording, with the ending .torques.svg, if not
    /// given
    #[arg(long, value_name = "SVG")]
    picture: Option<PathBuf>,
    #[command(flatten)]
    options: robot_import::import::Options,
}

fn positive(text: &str) -> std::result::Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|x| *x > 0.0 && x.is_finite());
    number.ok_or_else(|| "not a positive number".to_owned())
}

/// A unit vector.
fn direction(text: &str) -> std::result::Result<[f64; 3], String> {
    let numbers: Vec<f64> = text.split(',').filter_map(|x| x.trim().parse().ok()).collect();
    let length = numbers.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit: Vec<f64> = numbers.into_iter().map(|x| x / length).collect();
    let unit = unit.try_into().ok().filter(|_| length > 0.0 && length.is_finite());
    unit.ok_or_else(|| "not three numbers such as 1,0,0".to_owned())
}

fn main() -> ExitCode {
    let error = match run(&Args::parse()) {
        Ok((text, refused)) => match (std::io::stdout().write_all(text.as_bytes()), refused) {
            // The reader of a pipe, such as `| head`, has closed it.
            (Err(_), _) => return ExitCode::from(128 + 13),
            (Ok(()), None) => return ExitCode::SUCCESS,
            (Ok(()), Some(error)) => error,
        },
        Err(error) => error,
    };
    // It names what files have, whose control characters are not for the terminal.
    let text = error.to_string();
    let lines: Vec<String> = text.lines().map(robot_import::text::visible).collect();
    eprintln!("error: {}", lines.join("\n"));
    ExitCode::FAILURE
}

/// The output, and the reason if nothing is offered to paste.
fn run(args: &Args) -> Result<(String, Option<Error>)> {
    let beside = || args.recording.with_extension("torques.svg");
    let picture = args.picture.clone().unwrap_or_else(beside);
    let inputs =
        [&args.recording, &args.robot].into_iter().chain(&args.validate).chain(&args.columns);
    let inputs: Vec<&Path> = inputs.map(PathBuf::as_path).collect();
    let outputs: Vec<&Path> = args.out.iter().chain([&picture]).map(PathBuf::as_path).collect();
    robot_import::outputs::are_apart(&inputs, &outputs)
        .map_err(|error| Error::Output(error.into()))?;
    let map = args.columns.as_deref().map(Map::read).transpose()?;
    let mut robot = Robot::read(&args.robot, args.name.as_deref(), &args.options)?;
    robot.gravity = args.gravity;
    let names = robot.joints();
    let read = |path: &Path| Recorded::read(path, &names, map.as_ref());
    let recorded = read(&args.recording)?;
    let other = args.validate.as_deref().map(read).transpose()?;
    let options = Options {
        effects: args.effects.clone(),
        width: args.width,
        cutoff: args.cutoff,
        hold_out: 0.3,
    };
    let validate = args.validate.as_deref().zip(other.as_ref());
    let found = run::identify(&robot, (&args.recording, &recorded), validate, &options)?;
    write(&picture, &picture::svg(&found.traces))?;
    let file = paste::file(&robot, &found);
    let text = match (args.json, &found.mistake) {
        (true, _) => serde_json::to_string_pretty(&found)? + "\n",
        (false, Some(_)) => format!("{}\ndrawn: {}\n", found.text(), picture.display()),
        (false, None) => format!(
            "{}\ndrawn: {}\n\nto paste into the robot's Rust file:\n\n{}\nfor C:\n\n{}",
            found.text(),
            picture.display(),
            paste::lines(&file),
            paste::c(&found)
        ),
    };
    let Some(mistake) = found.mistake else {
        args.out.as_deref().map_or(Ok(()), |out| write(out, &file))?;
        return Ok((text, None));
    };
    let path = args.recording.clone();
    Ok((text, Some(Error::Mistake { path, mistake })))
}

fn write(path: &Path, text: &str) -> Result<()> {
    std::fs::write(path, text).map_err(|source| Error::Write { path: path.to_owned(), source })
}
