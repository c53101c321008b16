//! `cargo xtask demo`: builds scenes, runs them in QEMU, reports.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use crate::kit::elf::Image;
use crate::kit::error::{Error, Result};
use crate::kit::progress::Spinner;
use crate::kit::protocol::{FEEDFORWARD, PD, Recording};
use crate::kit::qemu::Run;
use crate::kit::scene::Scene;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::toolchain::RELEASE;
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, firmware, meter, output};
use crate::studies::scenes::plot;
use crate::studies::scenes::report::Report;
use crate::studies::{budgets, scenes};

/// The picture of the default scene.
const PICTURE: &str = "docs/ur5e.svg";

/// A run of a scene, in full.
pub struct Measured {
    pub report: Report,
    pub recording: Recording,
    pub elf: PathBuf,
    /// The log as it came and the meter's file: the same for each run of the same ELF.
    pub raw: (Vec<u8>, String),
}

#[derive(clap::Args)]
pub struct Args {
    /// The scene
    #[arg(long, value_enum, default_value_t)]
    #[arg(value_name = "NAME", ignore_case = true)]
    scene: Scene,
    /// Every scene, and one table of all
    #[arg(long, conflicts_with = "scene")]
    all: bool,
    /// The report as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
    /// Rewrite docs/scenes.md from this run: with --all, of all scenes
    #[arg(long)]
    write_docs: bool,
    /// Rewrite the scenes' budgets from this run
    #[arg(long)]
    write_budgets: bool,
}

/// Runs scenes, writes what the arguments name, and prints.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let one = [args.scene];
    let scenes = if args.all { Scene::all() } else { &one };
    output::note(
        "builds the firmware and a cycle meter, and runs them in QEMU: some two minutes the first \
         time, seconds a scene later",
    );
    let tools = setup::for_demo(options)?;
    let built = Built::new(&workspace, &tools, scenes)?;
    let measured = built.measure(&workspace, &tools)?;
    let mut pictures = Vec::new();
    for one in &measured {
        let picture = workspace.output(&format!("{}.svg", one.report.scene))?;
        plot::write(&one.recording, &picture)?;
        pictures.push(picture);
        if args.write_budgets {
            budgets::write(&workspace, &one.report)?;
        }
    }
    let reports: Vec<&Report> = measured.iter().map(|one| &one.report).collect();
    if args.write_docs {
        write_docs(&workspace, &measured)?;
        if args.all {
            scenes::PAGE.write(&workspace, &scenes::markdown(&reports))?;
        }
    }
    match reports.as_slice() {
        [one] if args.json && !args.all => docs::print_json(one)?,
        all if args.json => docs::print_json(&all)?,
        all if args.all => output::print(&scenes::text(all))?,
        all => {
            for (report, picture) in all.iter().zip(&pictures) {
                output::print(&report.text(workspace.relative(picture)))?;
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The table and the picture of the default scene.
fn write_docs(workspace: &Workspace, measured: &[Measured]) -> Result<()> {
    let shown = Scene::default().name();
    for one in measured.iter().filter(|one| one.report.scene == shown) {
        scenes::TICK.write(workspace, &one.report.markdown())?;
        plot::write(&one.recording, &workspace.report(PICTURE))?;
    }
    Ok(())
}

/// Scenes and the meter, built.
pub struct Built {
    meter: PathBuf,
    runs: Vec<(Scene, PathBuf)>,
}

impl Built {
    pub fn new(workspace: &Workspace, tools: &Tools, scenes: &[Scene]) -> Result<Self> {
        let names: Vec<&str> = scenes.iter().map(|scene| scene.name()).collect();
        let building = Spinner::start("building the cycle meter");
        let meter = firmware::build_meter(workspace)?;
        // Before the longer build: a QEMU may refuse it.
        tools.qemu.interface(&meter)?;
        building.say(format!("building {}", names.join(", ")));
        let elves = firmware::build_bins(workspace, tools.toolchain, RELEASE, &names)?;
        drop(building);
        let runs = scenes.iter().copied().zip(elves).collect();
        Ok(Self { meter, runs })
    }

    /// Runs the ones under the other, as many at a time as there are cores, and returns them in
    /// their order.
    pub fn measure(&self, workspace: &Workspace, tools: &Tools) -> Result<Vec<Measured>> {
        let (runs, meter, next) = (&self.runs, &self.meter, AtomicUsize::new(0));
        let done: Vec<_> = runs.iter().map(|_| OnceLock::new()).collect();
        let work = || {
            while let Some(number) = Some(next.fetch_add(1, Relaxed)).filter(|n| *n < runs.len()) {
                let (scene, elf) = &runs[number];
                done[number].get_or_init(|| measure(workspace, tools, *scene, elf, meter));
            }
        };
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        std::thread::scope(|scope| {
            for _ in 0..cores.min(runs.len()) {
                scope.spawn(work);
            }
        });
        done.into_iter().filter_map(OnceLock::into_inner).collect()
    }
}

/// A run in words, from the line that announces it: `run exact pd 0x800b789`.
fn run_in_words(line: &str) -> Option<String> {
    let mut words = line.strip_prefix("run ")?.split(' ');
    let (plant, law) = (words.next()?, words.next()?);
    let law = match law {
        PD => "PD alone".to_owned(),
        FEEDFORWARD => "feed-forward and PD".to_owned(),
        _ => law.replace('-', " "),
    };
    Some(format!("{law}, with the {plant} model"))
}

/// Runs a scene under the meter.
pub fn measure(
    workspace: &Workspace,
    tools: &Tools,
    scene: Scene,
    elf: &Path,
    plugin: &Path,
) -> Result<Measured> {
    let regions = workspace.output(&format!("{}.regions", scene.name()))?;
    // A later build of the same bin with other features takes the place of cargo's file.
    let kept = workspace.output(&format!("{}.elf", scene.name()))?;
    // A second run has the kept file itself, which a copy onto itself would empty.
    if elf != kept {
        std::fs::copy(elf, &kept).map_err(Error::file("copy", &kept))?;
    }
    let elf = &*kept;
    let (recording, raw) = record(tools, scene, elf, Some((plugin, &regions)))?;
    let metered = workspace::read(&regions)?;
    let report = Report::new(
        &recording,
        &meter::read(&regions)?,
        &Image::read(elf)?,
        tools.toolchain.rustc_version()?,
        tools.qemu.version.clone(),
    )?;
    Ok(Measured { report, recording, elf: elf.to_owned(), raw: (raw, metered) })
}

/// Runs a scene, with the meter and its file or without, and returns what it said, and that as it
/// came.
fn record(
    tools: &Tools,
    scene: Scene,
    elf: &Path,
    meter: Option<(&Path, &Path)>,
) -> Result<(Recording, Vec<u8>)> {
    let name = scene.name();
    let spinner = Spinner::start(&format!("running scene {name} in QEMU"));
    let mut recording = Recording::default();
    let run = Run::logging(name, elf, meter);
    let raw = tools.qemu.run(&run, |line| {
        if !recording.line(line)? {
            output::note(&format!("[{name}] {line}"));
        } else if let Some(words) = run_in_words(line) {
            spinner.say(format!("scene {name} in QEMU: {words}"));
        }
        Ok(())
    })?;
    Ok((recording, raw))
}

#[cfg(test)]
mod tests {
    use super::run_in_words;

    #[test]
    fn a_run_is_said_in_words() {
        let words = |line: &str| run_in_words(line);
        let pd = words("run exact pd 0x800b789").expect("a run");
        assert_eq!(pd, "PD alone, with the exact model");
        let without = words("run mismatched without-Coulomb 0x1").expect("a run");
        assert_eq!(without, "without Coulomb, with the mismatched model");
        assert_eq!(words("tick 7"), None);
    }
}
