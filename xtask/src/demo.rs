//! `cargo xtask demo`: builds a scene, runs it in QEMU, reports.

use std::path::{Path, PathBuf};

use crate::elf::Image;
use crate::error::Result;
use crate::firmware;
use crate::meter;
use crate::progress::Spinner;
use crate::protocol::Recording;
use crate::qemu::Run;
use crate::report::Report;
use crate::scene::Scene;
use crate::setup::Tools;
use crate::toolchain::Toolchain;
use crate::workspace::{self, Workspace};

/// A run of a scene, in full.
pub struct Measured {
    /// What it amounts to.
    pub report: Report,
    /// What the firmware said.
    pub recording: Recording,
    /// The firmware.
    pub elf: PathBuf,
    /// The log as it came and the meter's file: the same for each run of the same ELF.
    pub raw: (Vec<u8>, String),
}

/// Builds a scene and the meter, and runs the one under the other.
pub fn build_and_measure(workspace: &Workspace, tools: &Tools, scene: Scene) -> Result<Measured> {
    let building = Spinner::start(&format!("building scene {}", scene.name()));
    let elf = firmware::build(workspace, tools.toolchain, scene.name())?;
    building.say("building the cycle meter".into());
    let meter = firmware::build_meter(workspace)?;
    drop(building);
    measure(workspace, tools, scene, tools.toolchain, &elf, &meter)
}

/// Runs a scene under the meter.
pub fn measure(
    workspace: &Workspace,
    tools: &Tools,
    scene: Scene,
    toolchain: Toolchain,
    elf: &Path,
    plugin: &Path,
) -> Result<Measured> {
    let name = scene.name();
    let regions = workspace.output(&format!("{name}.regions"))?;
    let spinner = Spinner::start(&format!("running scene {name} in QEMU"));
    let mut recording = Recording::default();
    let run = Run {
        name,
        elf,
        meter: Some((plugin, &regions)),
        logs: true,
    };
    let raw = tools.qemu.run(&run, |line| {
        if !recording.line(line)? {
            spinner.line(&format!("[{name}] {line}"));
        } else if line.starts_with("run ") {
            spinner.say(format!("scene {name} in QEMU: {line}"));
        }
        Ok(())
    })?;
    drop(spinner);
    let metered = workspace::read(&regions)?;
    let report = Report::new(
        &recording,
        &meter::read(&regions)?,
        &Image::read(elf)?,
        toolchain.rustc_version()?,
        tools.qemu.version.clone(),
    )?;
    Ok(Measured {
        report,
        recording,
        elf: elf.to_owned(),
        raw: (raw, metered),
    })
}
