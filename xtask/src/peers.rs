//! `cargo xtask peers`: the same dynamics by other libraries and by ours, side by side in one run.

mod bars;
mod build;
mod host;
mod progress;
mod report;
mod robots;
mod target;
#[cfg(test)]
mod tests;
mod tools;

use std::process::{Command, ExitCode};

use serde::Deserialize;

use crate::bars::Held;
use crate::budgets;
use crate::docs;
use crate::error::{Error, Result};
use crate::output;
use crate::peers::build::Workshop;
use crate::peers::progress::Progress;
use crate::peers::report::Report;
use crate::peers::tools::Peers;
use crate::setup::{Options, Tools};
use crate::shell;
use crate::workspace::{self, Workspace};

/// What the peers compute: ID(q, q̇, q̈), ID(q, q̇, 0), ID(q, 0, 0), the mass matrix, and FD(q, q̇, τ).
const ALGORITHMS: [&str; 5] = ["rnea", "bias", "gravity", "crba", "aba"];
const PRECISIONS: [&str; 2] = ["f32", "f64"];
/// Those of the largest robot, in f64 and on the host alone.
const LARGE: [&str; 3] = ["rnea", "crba", "aba"];

/// Steps beside those of host and target: the generator.
const OTHER_STEPS: usize = 1;

/// Numbers that an algorithm gives for a robot of so many joints; of M one triangle.
fn outputs(algorithm: &str, joints: usize) -> usize {
    if algorithm == "crba" {
        joints * (joints + 1) / 2
    } else {
        joints
    }
}

/// Sets up, builds, measures, and writes `docs/peers.md`.
///
/// # Errors
/// Among others, a bar is missed that `budgets.toml` does not record as missed.
pub fn run(options: Options, json: bool) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let (tools, peers) = tools::set_up(&workspace, options)?;
    let robots = robots::export(&workspace)?;
    let steps = OTHER_STEPS + host::steps(&robots) + target::steps(&robots);
    let progress = Progress::new(steps);
    let shop = Workshop::new(&workspace, &peers, &progress)?;
    shop.generate(&robots)?;
    let mut rows = target::measure(&workspace, &shop, &tools, &robots)?;
    rows.extend(host::measure(&workspace, &shop, &robots)?);
    drop(progress);
    let versions = versions(&workspace, &tools, &peers)?;
    let ratios = budgets::bars(&workspace)?;
    let held = bars::held(&ratios, &rows);
    // Times on a host vary: one that happens to meet its bar is no reason to fail.
    let unmet: Vec<String> = held
        .iter()
        .filter(|held| !held.is_met())
        .filter_map(Held::complaint)
        .collect();
    let report = Report {
        rows,
        held,
        versions,
        date: docs::today_and_commit(&workspace),
    };
    workspace::write(&workspace.report("docs/peers.md"), report.markdown())?;
    if json {
        docs::print_json(&report.rows)?;
    } else {
        output::print(&report.text())?;
    }
    if !unmet.is_empty() {
        return Err(Error::check(format!("bar: {}", unmet.join("\nbar: "))));
    }
    Ok(ExitCode::SUCCESS)
}

/// The versions of all that was measured or measured with.
fn versions(workspace: &Workspace, tools: &Tools, peers: &Peers) -> Result<Vec<String>> {
    let script = "from importlib.metadata import version\n\
                  for p in ('pin', 'casadi', 'mujoco'): print(p, version(p))";
    let said = shell::capture(Command::new(&peers.python).args(["-c", script]))?;
    let mut versions: Vec<String> = said.lines().map(str::to_owned).collect();
    versions.push(format!("dynibo {}", locked(workspace, "dynibo")?));
    versions.extend(target::compilers());
    versions.push(tools.toolchain.rustc_version()?);
    versions.push(tools.qemu.version.clone());
    versions.extend(processor().map(|name| format!("host: {name}")));
    Ok(versions)
}

#[derive(Deserialize)]
struct Lock {
    package: Vec<Locked>,
}

#[derive(Deserialize)]
struct Locked {
    name: String,
    version: String,
}

/// The version of a crate in Cargo.lock.
fn locked(workspace: &Workspace, name: &str) -> Result<String> {
    let path = workspace.root.join("Cargo.lock");
    let lock: Lock = toml::from_str(&workspace::read(&path)?)
        .map_err(|e| Error::check(format!("{}: {e}", path.display())))?;
    let found = lock
        .package
        .into_iter()
        .find(|package| package.name == name);
    found
        .map(|package| package.version)
        .ok_or_else(|| Error::check(format!("no `{name}` in Cargo.lock")))
}

/// What this machine calls its processor, if it says.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
