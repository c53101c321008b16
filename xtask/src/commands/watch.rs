//! `cargo xtask watch`: the telemetry of a machine, live; and the check that telemetry never delays
//! a tick.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use cycle_meter::Sample;
use serde_json::Value;

use crate::kit::callgraph::Instruction;
use crate::kit::elf::Image;
use crate::kit::error::{Error, Result, bail, check, refuse_if};
use crate::kit::progress::Spinner;
use crate::kit::qemu::Run;
use crate::kit::scene::Scene;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::toolchain::{RELEASE, TARGET};
use crate::kit::workspace::Workspace;
use crate::kit::{firmware, meter, shell};

/// The package that listens, and its program.
const LISTENER: &str = "telemetry-watch";
/// The scene whose ticks are compared with a listener and without one.
const SCENE: &str = "ur5e";
/// The serial port of QEMU, connected to the listener.
const SERIAL: &str = "tcp:127.0.0.1:{port}";
const TICKS: usize = 3000;
/// Regions of `firmware_demo::region`: the tick, and those behind it.
const TICK: u8 = 0;
const RECORD: u8 = 6;
const MASKED: u8 = 7;
/// The longest stretch with interrupts masked, in instructions, and the most that a record takes:
/// what the guide says.
const LONGEST: u64 = 10;
const KEPT: u64 = 39;

#[derive(clap::Args)]
pub struct Args {
    /// Run this scene in QEMU
    #[arg(long, value_enum, default_value_t, value_name = "NAME", conflicts_with = "port")]
    scene: Scene,
    /// Every this many ticks an encoder of the scene reports errors
    #[arg(long, value_name = "TICKS", conflicts_with = "port")]
    faults: Option<u32>,
    /// Run the project of `cargo xtask new` in this folder in QEMU
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["port", "scene", "faults"])]
    project: Option<PathBuf>,
    /// Move the project's robot along a motion that shows its parameters, for
    /// `cargo xtask identify`
    #[arg(long, requires = "project")]
    excite: bool,
    /// End the project's program after this many ticks
    #[arg(long, value_name = "N", requires = "project")]
    ticks: Option<u32>,
    /// Listen to the machine on this serial port
    #[arg(long, value_name = "PORT")]
    port: Option<String>,
    /// The rate of the serial port, bit/s
    #[arg(long, value_name = "RATE", requires = "port")]
    baud: Option<u32>,
    /// Record the ticks; the ending .csv or .mcap names the form
    #[arg(long, value_name = "FILE", value_parser = recorded)]
    record: Option<PathBuf>,
    /// End after this many seconds of this computer, in which QEMU may have emulated fewer
    #[arg(long, value_name = "S")]
    seconds: Option<f64>,
    /// Show nothing, and print a summary as JSON at the end
    #[arg(long)]
    json: bool,
}

/// Builds the listener and what it listens to, and shows it until the user ends it.
pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let mut listener = program(&workspace, LISTENER)?;
    let path = args.record.as_ref().map(|path| path.display().to_string());
    let texts = [
        ("--record", path),
        ("--seconds", args.seconds.map(|seconds| seconds.to_string())),
        ("--baud", args.baud.map(|baud| baud.to_string())),
        ("--port", args.port.clone()),
    ];
    for (name, value) in texts {
        listener.args(value.map(|value| format!("{name}={value}")));
    }
    listener.args(args.json.then_some("--json"));
    if args.port.is_none() {
        let tools = setup::for_demo(options)?;
        let name = args.scene.name();
        let elf = match &args.project {
            Some(folder) => project(&workspace, &tools, folder)?,
            None => firmware(&workspace, &tools, name)?,
        };
        let numbers = [("faults", args.faults), ("ticks", args.ticks)];
        let numbers = numbers.map(|(name, number)| format!("{name}={}", number.unwrap_or(0)));
        let words = numbers.iter().map(String::as_str);
        let words: Vec<&str> = words.chain(args.excite.then_some("excite")).collect();
        let mut run = Run::logging(name, &elf, None);
        (run.serial, run.words) = (SERIAL, &words);
        listener.arg("--pace");
        tools.qemu.start_by(&mut listener, &run)?;
    }
    let status = shell::run_for_user(&mut listener)?;
    // It has printed its error.
    Ok(ExitCode::from(u8::from(!status.success())))
}

/// The path of a record: another ending is refused before anything is built.
fn recorded(text: &str) -> std::result::Result<PathBuf, &'static str> {
    let is_known = text.ends_with(".csv") || text.ends_with(".mcap");
    is_known.then(|| text.into()).ok_or("a record ends with .csv or .mcap")
}

/// The program of a project that sends its ticks, built as the project's own manifest says.
fn project(workspace: &Workspace, tools: &Tools, folder: &Path) -> Result<PathBuf> {
    refuse_if!(
        !folder.join("src/bin/watch.rs").is_file(),
        "{} has no src/bin/watch.rs: `cargo xtask new` writes it into a project in Rust",
        folder.display()
    );
    let target = std::path::absolute(folder.join("target")).map_err(Error::file("find", folder))?;
    let mut cargo = tools.toolchain.cargo(workspace, "build");
    let words = "--release --features telemetry --bin watch --target-dir".split(' ');
    shell::capture(cargo.args(words).arg(&target).current_dir(folder))?;
    Ok(target.join(TARGET).join(RELEASE).join("watch"))
}

/// A host program of the package of its name, built.
pub fn program(workspace: &Workspace, package: &str) -> Result<Command> {
    let _building = Spinner::start(&format!("building `{package}`, the first time for minutes"));
    shell::capture(workspace.cargo("build").args(["--package", package]))?;
    let program = format!("debug/{package}{}", std::env::consts::EXE_SUFFIX);
    Ok(Command::new(workspace.target.join(program)))
}

/// A bin of the firmware that sends telemetry, built.
pub fn firmware(workspace: &Workspace, tools: &Tools, bin: &str) -> Result<PathBuf> {
    let _building = Spinner::start(&format!("building the firmware of {bin}"));
    let (chain, features) = (tools.toolchain, "telemetry");
    let built = firmware::build_with(workspace, chain, RELEASE, features, &[bin], None);
    Ok(built?.remove(0))
}

/// Fails if a tick costs something else with a listener, without one, or with a queue that nobody
/// empties; if a full queue costs more than one with room; if a frame is lost on the line; or if
/// interrupts are masked for longer than stated.
pub fn check(workspace: &Workspace, tools: &Tools, plugin: &Path) -> Result<String> {
    shell::capture(workspace.cargo("test").args(["--package", LISTENER]))?;
    let name = SCENE;
    let elf = firmware(workspace, tools, name)?;
    let ticks = format!("ticks={TICKS}");
    let regions = |case: &str| workspace.output(&format!("watched_{name}.{case}.regions"));
    let run = |case, serial, words: &[&str]| {
        let out = regions(case)?;
        let mut run = Run::logging(name, &elf, Some((plugin, &out)));
        (run.serial, run.words) = (serial, words);
        tools.qemu.lines(&run)?;
        meter::read(&out)
    };
    let alone = run("alone", "null", &[&ticks])?;
    let full = run("full", "null", &[&ticks, "listen=0"])?;

    let out = regions("heard")?;
    let words = [ticks.as_str()];
    let mut heard = Run::logging(name, &elf, Some((plugin, &out)));
    (heard.serial, heard.words) = (SERIAL, &words);
    let mut listener = program(workspace, LISTENER)?;
    tools.qemu.start_by(listener.arg("--json"), &heard)?;
    every_tick_arrived(&shell::capture(&mut listener)?)?;

    masked_nowhere_else(&Image::read(&elf)?)?;
    let said = verdict(&meter::read(&out)?, &alone, &full)?;
    let cycles = longest(&alone);
    Ok(format!("{said}; with detectors and record a tick takes {cycles} cycles at most"))
}

/// The cycles of the longest tick with those of its record.
fn longest(samples: &[Sample]) -> u64 {
    let of = |region: u8| samples.iter().filter(move |sample| sample.region == region);
    let sums = of(TICK).zip(of(RECORD)).map(|(tick, record)| tick.cycles + record.cycles);
    sums.max().unwrap_or(u64::MAX)
}

/// Fails if a function masks interrupts that is neither the initialisation, the interrupt, nor the
/// log.
fn masked_nowhere_else(image: &Image) -> Result<()> {
    const KNOWN: [&str; 4] = ["cortex_m_rt_main", "watch5watch", "_defmt_acquire", "SysTick"];
    const CPSID_I: u16 = 0xb672;
    let masks = |one: &Instruction| one.code[0] == CPSID_I;
    let others = image.instructions().find(|(function, one)| {
        masks(one) && !function.is_named(|name| KNOWN.iter().any(|known| name.contains(known)))
    });
    match others {
        None => Ok(()),
        Some((function, _)) => Err(check!("`{}` masks interrupts", function.names.join("`, `"))),
    }
}

/// Fails if the listener's summary lacks a tick, has a bad frame, or an event: nothing disturbs the
/// arm, and its detectors must not find anything.
fn every_tick_arrived(json: &str) -> Result<()> {
    let summary: Value = serde_json::from_str(json)
        .map_err(|e| check!("`{LISTENER}` printed what is not understood: {e}"))?;
    let of = |key: &str| summary[key].as_u64();
    let counts = ["ticks", "bad_frames", "dropped", "lost", "restarts"].map(of);
    let expected = [TICKS as u64, 0, 0, 0, 0].map(Some);
    refuse_if!(
        counts != expected,
        "ticks, bad frames, drops, losses, restarts are {counts:?}, not {expected:?}"
    );
    let events = summary["events"].as_array();
    refuse_if!(
        events.is_none_or(|events| !events.is_empty()),
        "the arm has events although nothing disturbed it: {}",
        summary["events"]
    );
    Ok(())
}

/// Compares the ticks of three runs, and what their records and masked stretches cost.
fn verdict(heard: &[Sample], alone: &[Sample], full: &[Sample]) -> Result<String> {
    let of = |samples: &[Sample], is_mine: fn(u8) -> bool| -> Vec<Sample> {
        let mine = samples.iter().filter(|sample| is_mine(sample.region));
        // Caches depend on what ran between two ticks, so that what flash waits for may differ.
        mine.map(|sample| Sample { waits: [0; 2], ..*sample }).collect()
    };
    let ticks = |samples| of(samples, |region| region < RECORD);
    let (with, without) = (ticks(heard), ticks(alone));
    let found = with.len() / meter::REGIONS.len();
    refuse_if!(found != TICKS, "{found} ticks were measured, not {TICKS}");
    for (what, others) in [("a listener", with), ("a full queue", ticks(full))] {
        let pairs = others.iter().zip(&without).position(|(one, other)| one != other);
        let differs = pairs.or((others.len() != without.len()).then_some(without.len()));
        if let Some(at) = differs {
            let tick = at / meter::REGIONS.len();
            bail!("with {what}, tick {tick} costs something else than without");
        }
    }
    let most = |samples, mine: fn(u8) -> bool| {
        let mine = of(samples, mine);
        mine.iter().map(|sample| sample.instructions).max()
    };
    let record = |samples| most(samples, |region| region == RECORD);
    let (kept, dropped) = (record(alone), record(full));
    let is_stated = kept.is_some_and(|kept| kept <= KEPT);
    refuse_if!(
        !is_stated || dropped > kept || record(heard) != kept,
        "recording a tick takes {kept:?} instructions ({KEPT} are stated), with a listener {:?}, \
         with a full queue {dropped:?}",
        record(heard)
    );
    let masked = [heard, alone, full].map(|samples| most(samples, |region| region == MASKED));
    let longest = masked.into_iter().max().flatten().unwrap_or(u64::MAX);
    refuse_if!(
        longest > LONGEST,
        "interrupts are masked for {longest} instructions, {LONGEST} are stated"
    );
    Ok(format!(
        "{TICKS} ticks the same; a record takes {} instructions at most; interrupts are masked for \
         {longest}",
        kept.unwrap_or_default()
    ))
}

#[cfg(test)]
mod tests;
