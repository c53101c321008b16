//! The demo where QEMU does not take the cycle meter: how well the arm tracks, and why costs are missing.

use std::path::PathBuf;
use std::process::ExitCode;

use serde::Serialize;

use crate::docs;
use crate::error::{Error, Result};
use crate::output;
use crate::plot;
use crate::progress::Spinner;
use crate::protocol::Recording;
use crate::qemu::Run;
use crate::scene::Scene;
use crate::setup::Tools;
use crate::table::Table;
use crate::workspace::Workspace;

/// What a scene's runs amount to without costs.
#[derive(Debug, Serialize)]
struct Tracked {
    scene: String,
    /// Why there are no costs.
    costs_missing: String,
    runs: Vec<Errors>,
}

/// The tracking error of a run.
#[derive(Debug, Serialize)]
struct Errors {
    plant: String,
    law: String,
    rms_rad: f64,
    max_rad: f64,
    status: String,
}

/// Runs scenes without the meter and prints how they track.
pub fn run(
    workspace: &Workspace,
    tools: &Tools,
    runs: &[(Scene, PathBuf)],
    why: &Error,
    json: bool,
) -> Result<ExitCode> {
    let mut all = Vec::new();
    for (scene, elf) in runs {
        let name = scene.name();
        let spinner = Spinner::start(&format!("running scene {name} in QEMU, without the meter"));
        let mut recording = Recording::default();
        let run = Run {
            name,
            elf,
            meter: None,
            logs: true,
        };
        tools.qemu.run(&run, |line| {
            if !recording.line(line)? {
                spinner.line(&format!("[{name}] {line}"));
            }
            Ok(())
        })?;
        drop(spinner);
        recording.complete()?;
        plot::write(&recording, &workspace.output(&format!("{name}.svg"))?)?;
        all.push(Tracked::of(&recording, why)?);
    }
    if json {
        docs::print_json(&all)?;
    } else {
        for one in &all {
            output::print(&one.text())?;
        }
        output::print(&format!("\nCosts are missing: {why}.\n"))?;
    }
    Ok(ExitCode::SUCCESS)
}

impl Tracked {
    fn of(recording: &Recording, why: &Error) -> Result<Self> {
        let runs = recording.order.iter().map(|(plant, law)| {
            let run = recording.trajectory(plant, law);
            let found = run.and_then(|run| Some((run, run.total?)));
            let (run, rms_rad) = found
                .ok_or_else(|| Error::check(format!("there is no error of {law} on {plant}")))?;
            Ok(Errors {
                plant: plant.clone(),
                law: law.clone(),
                rms_rad,
                max_rad: run.max.iter().copied().fold(0.0, f64::max),
                status: run.status.clone(),
            })
        });
        Ok(Self {
            scene: recording.scene.clone(),
            costs_missing: why.to_string(),
            runs: runs.collect::<Result<_>>()?,
        })
    }

    fn text(&self) -> String {
        let mut table = Table::new(&["model", "law", "RMS, mrad", "largest, mrad", "safety gate"]);
        for run in &self.runs {
            table.row([
                run.plant.clone(),
                run.law.clone(),
                format!("{:.3}", 1e3 * run.rms_rad),
                format!("{:.3}", 1e3 * run.max_rad),
                run.status.clone(),
            ]);
        }
        format!("scene {}: tracking error\n\n{}", self.scene, table.text())
    }
}
