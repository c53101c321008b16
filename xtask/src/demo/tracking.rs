//! The demo where QEMU does not take the cycle meter: how well the arm tracks, and why costs are missing.

use std::path::PathBuf;
use std::process::ExitCode;

use serde::Serialize;

use super::record;
use crate::bars::largest;
use crate::docs;
use crate::error::{Error, Result};
use crate::output;
use crate::plot;
use crate::protocol::Recording;
use crate::render::milli;
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
        let (recording, _) = record(tools, *scene, elf, None)?;
        recording.complete()?;
        let picture = workspace.output(&format!("{}.svg", scene.name()))?;
        plot::write(&recording, &picture)?;
        all.push(Tracked::of(recording, why));
    }
    if json {
        docs::print_json(&all)?;
        return Ok(ExitCode::SUCCESS);
    }
    for one in &all {
        output::print(&one.text())?;
    }
    output::print(&format!("\nCosts are missing: {why}.\n"))?;
    Ok(ExitCode::SUCCESS)
}

impl Tracked {
    fn of(recording: Recording, why: &Error) -> Self {
        let runs = recording.runs.into_iter().map(|run| Errors {
            rms_rad: run.total,
            max_rad: largest(run.max.into_iter()),
            plant: run.plant,
            law: run.law,
            status: run.status,
        });
        Self {
            scene: recording.scene,
            costs_missing: why.to_string(),
            runs: runs.collect(),
        }
    }

    fn text(&self) -> String {
        let table = Table::of(
            &self.runs,
            &[
                ("model", &|run| run.plant.clone()),
                ("law", &|run| run.law.clone()),
                ("RMS, mrad", &|run| milli(run.rms_rad)),
                ("largest, mrad", &|run| milli(run.max_rad)),
                ("safety gate", &|run| run.status.clone()),
            ],
        );
        format!("scene {}: tracking error\n\n{}", self.scene, table.text())
    }
}
