//! Shows and records the telemetry of a machine: what `cargo xtask watch` runs.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

use clap::Parser;
use telemetry_watch::error::{Error, Result};
use telemetry_watch::record::{self, Recorder};
use telemetry_watch::session::{self, Options, Show};
use telemetry_watch::source::Place;
use telemetry_watch::summary::{self, Summary};

/// Shows and records the telemetry of a machine
#[derive(Parser)]
struct Args {
    /// Read from this serial port
    #[arg(long, value_name = "PORT", conflicts_with = "file")]
    port: Option<String>,
    /// The rate of the serial port, bit/s
    #[arg(long, default_value_t = 2_000_000, value_name = "RATE")]
    baud: u32,
    /// Read from a file of bytes received earlier
    #[arg(long, value_name = "FILE")]
    file: Option<PathBuf>,
    /// Record the ticks; the ending .csv or .mcap names the form
    #[arg(long, value_name = "FILE", value_parser = record::named)]
    record: Option<PathBuf>,
    /// End after this many seconds of this computer, in which an emulated machine may have had
    /// fewer
    #[arg(long, value_name = "S")]
    seconds: Option<f64>,
    /// Show nothing, and print a summary as JSON at the end
    #[arg(long)]
    json: bool,
    /// Take no more than the ticks that are due: a program that runs faster than the machine then
    /// waits
    #[arg(long)]
    pace: bool,
    /// Start this program, which connects to the TCP port that replaces {port} in its arguments
    #[arg(last = true, value_name = "PROGRAM")]
    program: Vec<String>,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of a pipe, such as `| head`, has closed it.
        Err(Error::Terminal(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => {
            ExitCode::from(128 + 13)
        }
        Err(error) => {
            // There is no other place to report it to.
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Whether two paths lead to one file.
fn is_one(a: &Path, b: &Path) -> bool {
    std::fs::canonicalize(a).is_ok_and(|a| std::fs::canonicalize(b).is_ok_and(|b| a == b))
}

fn run(args: &Args) -> Result<()> {
    // Without a handler a signal ends the program, but not its children.
    let _ = ctrlc::set_handler(|| session::ENDED.store(true, Relaxed));
    if let (Some(read), Some(written)) = (&args.file, &args.record)
        && is_one(read, written)
    {
        let source = std::io::Error::other("it is the file that is read");
        let path = written.clone();
        return Err(Error::Record { path, source });
    }
    let recorder = args.record.as_deref().map(Recorder::create).transpose()?;
    let place = match (&args.port, &args.file) {
        (Some(port), _) => Place::Port(port.clone(), args.baud),
        (_, Some(file)) => Place::File(file.clone()),
        _ => Place::Program(args.program.clone()),
    };
    let show = if args.json { Show::Nothing } else { Show::Live };
    let limit = args.seconds.map(|seconds| Duration::from_secs_f64(seconds.max(0.0)));
    let options = Options { show, limit, pace: args.pace };
    let mut source = place.open()?;
    let start = Instant::now();
    let view = session::run(&mut source, recorder, options)?;
    if !args.json {
        let line = summary::duration(&view, start.elapsed());
        writeln!(std::io::stdout(), "{line}")?;
    } else {
        let json = serde_json::to_string_pretty(&Summary::of(&view));
        writeln!(std::io::stdout(), "{}", json.map_err(std::io::Error::from)?)?;
    }
    Ok(())
}
