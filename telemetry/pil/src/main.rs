//! Runs a processor in the loop and compares the motion with that of the plant inside: what `cargo xtask pil` runs.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use telemetry_pil::Error;
use telemetry_pil::comparison::Comparison;
use telemetry_pil::machine::Remote;
use telemetry_pil::motion::Motion;
use telemetry_pil::plant::Outside;
use telemetry_watch::error::Error as Line;
use telemetry_watch::source::Place;

/// Simulates the robot of the scene `ur5e` in f64, its controller on a processor behind a serial line
#[derive(Parser)]
struct Args {
    /// The bytes that the firmware with the robot inside has sent
    #[arg(long, value_name = "FILE")]
    inside: PathBuf,
    /// Ticks to compare
    #[arg(long, value_name = "N")]
    ticks: u32,
    /// Scale the friction of the simulated robot, which the controller does not know
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR")]
    friction: f64,
    /// The processor is behind this serial port
    #[arg(long, value_name = "PORT")]
    port: Option<String>,
    /// The rate of the serial port, bit/s
    #[arg(long, default_value_t = 2_000_000, value_name = "RATE")]
    baud: u32,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
    /// Start this program, which connects to the TCP port that replaces {port} in its arguments
    #[arg(last = true, value_name = "PROGRAM")]
    program: Vec<String>,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // There is no other place to report it to.
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<(), Error> {
    let inside = Motion::recorded(&args.inside, args.ticks as usize)?;
    let place = match &args.port {
        Some(port) => Place::Port(port.clone(), args.baud),
        None => Place::Program(args.program.clone()),
    };
    let mut machine = Remote::new(place.open()?);
    let mut robot = Outside::new(args.friction);
    let outside = Motion::of(&mut machine, &mut robot, args.ticks)?;
    let comparison = Comparison::of(&outside, &inside);
    let text = if args.json {
        serde_json::to_string_pretty(&comparison).map_err(|e| Line::Terminal(e.into()))?
    } else {
        table(&comparison)
    };
    writeln!(std::io::stdout(), "{text}").map_err(Line::Terminal)?;
    comparison.check()
}

fn table(comparison: &Comparison) -> String {
    let mut text =
        String::from("joint  RMS error outside, mrad  inside  largest difference, mrad\n");
    for (number, joint) in comparison.joints.iter().enumerate() {
        text += &format!(
            "{number:5}  {:23.4}  {:6.4}  {:24.4}\n",
            joint.rms_outside_mrad, joint.rms_inside_mrad, joint.max_difference_mrad
        );
    }
    let (difference, rms) = comparison.largest();
    let ticks = comparison.ticks;
    text + &format!(
        "over {ticks} ticks: positions differ by {difference:.3} mrad at most, RMS errors by {rms:.4} mrad"
    )
}
