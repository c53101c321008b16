//! `cargo xtask pil`: the controller of the scene `ur5e` in QEMU or on a board, its robot in f64 on the host.

use std::process::{Command, ExitCode};

use crate::commands::watch;
use crate::kit::error::Result;
use crate::kit::progress::Spinner;
use crate::kit::qemu::Run;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::shell;
use crate::kit::workspace::Workspace;

/// The package that simulates the robot and compares.
const HOST: &str = "telemetry-pil";
/// The firmware whose robot is inside, and the one without a robot.
const INSIDE: &str = "watch_ur5e";
const OUTSIDE: &str = "pil_ur5e";
/// The serial port of QEMU, connected to the host program, which waits for each reply.
const SERIAL: &str = "tcp:127.0.0.1:{port},nodelay=on";
const TICKS: u32 = 1000;

#[derive(clap::Args)]
pub struct Args {
    /// Ticks to compare, at most those of the trajectory
    #[arg(long, default_value_t = 1500, value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=6800))]
    ticks: u32,
    /// Scale the friction of the simulated robot, which the controller does not know
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR")]
    friction: f64,
    /// The processor is on a board behind this serial port, not in QEMU
    #[arg(long, value_name = "PORT")]
    port: Option<String>,
    /// The figures as JSON on stdout
    #[arg(long)]
    json: bool,
}

/// Builds both firmwares and the host program, and compares.
pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    let (workspace, tools) = (Workspace::find()?, setup::for_demo(options)?);
    let mut host = host(&workspace, &tools, args)?;
    let status = shell::run_for_user(&mut host)?;
    // It has printed its error.
    Ok(ExitCode::from(u8::from(!status.success())))
}

/// Fails if the motion differs from that of the plant inside by more than stated; returns the figures.
pub fn check(workspace: &Workspace, tools: &Tools) -> Result<String> {
    shell::cargo(workspace.cargo("test").args(["--package", HOST]))?;
    let args = Args {
        ticks: TICKS,
        friction: 1.0,
        port: None,
        json: false,
    };
    let table = shell::capture(&mut host(workspace, tools, &args)?)?;
    Ok(table.lines().last().unwrap_or_default().to_owned())
}

/// The host program, complete with what it compares.
fn host(workspace: &Workspace, tools: &Tools, args: &Args) -> Result<Command> {
    let inside = watch::firmware(workspace, tools, INSIDE)?;
    let mut host = watch::program(workspace, HOST)?;
    let record = workspace.output("inside.frames")?;
    let serial = format!("file:{}", record.display());
    let words = [format!("ticks={}", args.ticks)];
    let words = words.each_ref().map(String::as_str);
    let mut run = Run::logging(INSIDE, &inside, None);
    (run.serial, run.words) = (&serial, &words);
    let spinner = Spinner::start("the plant inside");
    tools.qemu.lines(&run)?;
    drop(spinner);

    host.arg("--inside").arg(&record);
    host.arg(format!("--ticks={}", args.ticks));
    host.arg(format!("--friction={}", args.friction));
    host.args(args.json.then_some("--json"));
    match &args.port {
        Some(port) => {
            host.arg(format!("--port={port}"));
        }
        None => {
            let outside = watch::firmware(workspace, tools, OUTSIDE)?;
            let mut run = Run::logging(OUTSIDE, &outside, None);
            run.serial = SERIAL;
            tools.qemu.start_by(&mut host, &run)?;
        }
    }
    Ok(host)
}
