//! The demo where QEMU does not take the cycle meter: how well the arm tracks, and why costs are
//! missing.

use std::path::PathBuf;
use std::process::ExitCode;

use serde_json::{Value, json};

use super::record;
use crate::kit::error::{Error, Result};
use crate::kit::protocol::{Recording, Trajectory};
use crate::kit::scene::Scene;
use crate::kit::setup::Tools;
use crate::kit::table::Table;
use crate::kit::workspace::Workspace;
use crate::kit::{docs, output};
use crate::studies::scenes::plot;
use crate::studies::scenes::render::milli;

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
        plot::write(&recording, &workspace.output(&format!("{}.svg", scene.name()))?)?;
        all.push(recording);
    }
    if json {
        let why = why.to_string();
        docs::print_json(&all.iter().map(|one| in_json(one, &why)).collect::<Vec<_>>())?;
        return Ok(ExitCode::SUCCESS);
    }
    for one in &all {
        output::print(&format!("scene {}: tracking error\n\n{}", one.scene, table(one).text()))?;
    }
    output::print(&format!("\nCosts are missing: {why}.\n"))?;
    Ok(ExitCode::SUCCESS)
}

fn in_json(recording: &Recording, why: &str) -> Value {
    let run = |run: &Trajectory| {
        json!({
            "plant": run.plant, "law": run.law, "rms_rad": run.total, "max_rad": run.largest(), "status": run.status,
        })
    };
    let runs: Vec<Value> = recording.runs.iter().map(run).collect();
    json!({ "scene": recording.scene, "costs_missing": why, "runs": runs })
}

fn table(recording: &Recording) -> Table {
    Table::of(
        &recording.runs,
        &[
            ("model", &|run| run.plant.clone()),
            ("law", &|run| run.law.clone()),
            ("RMS, mrad", &|run| milli(run.total)),
            ("largest, mrad", &|run| milli(run.largest())),
            ("safety gate", &|run| run.status.clone()),
        ],
    )
}
