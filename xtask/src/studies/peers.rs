//! `cargo xtask peers`: the same dynamics by other libraries and by ours, side by side in one run.

mod bars;
mod build;
mod host;
mod report;
mod robots;
mod target;
#[cfg(test)]
mod tests;
mod tools;

use std::process::{Command, ExitCode};

use crate::kit::bars::Compared;
use crate::kit::docs::{self, Page};
use crate::kit::error::{Result, bail};
use crate::kit::setup::{Options, Tools};
use crate::kit::shell;
use crate::kit::workspace::{self, Workspace};
use crate::studies::peers::build::Workshop;
use crate::studies::peers::report::Report;
use crate::studies::peers::tools::Peers;
use crate::studies::{budgets, drawn};

/// ID(q, q̇, q̈), ID(q, q̇, 0), ID(q, 0, 0), the mass matrix, and FD(q, q̇, τ).
const ALGORITHMS: [&str; 5] = ["rnea", "bias", "gravity", "crba", "aba"];
const PRECISIONS: [&str; 2] = ["f32", "f64"];
/// The algorithms for the largest robot, in f64 and on the host alone.
const LARGE: [&str; 3] = ["rnea", "crba", "aba"];

/// The number of outputs of an algorithm for a robot with this number of joints; of M one triangle counts.
fn outputs(algorithm: &str, joints: usize) -> usize {
    if algorithm == "crba" {
        joints * (joints + 1) / 2
    } else {
        joints
    }
}

/// The part of the page about robots with loops.
const LOOPS: Page<'_> = Page {
    file: "docs/peers.md",
    name: "loops",
    command: "cargo xtask peers --loops",
};

#[derive(clap::Args)]
pub struct Args {
    /// Measure robots with kinematic loops only, on the host, and rewrite their part of the page
    #[arg(long)]
    loops: bool,
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
}

/// Sets up, builds, measures, and writes `docs/peers.md`.
///
/// # Errors
/// Among others, a bar is missed that `budgets.toml` does not record as missed.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let (tools, peers) = tools::set_up(&workspace, options)?;
    let shop = Workshop::new(&workspace, &peers)?;
    if args.loops {
        let report = Report {
            rows: host::measure(&workspace, &shop, &[])?,
            compared: Vec::new(),
            versions: versions(&workspace, &tools, &peers)?,
            date: docs::today_and_commit(&workspace),
        };
        let text = report.loops();
        LOOPS.write(&workspace, &text)?;
        return docs::show(args.json, &report.rows, &text);
    }
    let robots = robots::export(&workspace)?;
    shop.generate(&robots)?;
    let mut rows = target::measure(&workspace, &shop, &tools, &robots)?;
    rows.extend(host::measure(&workspace, &shop, &robots)?);
    let versions = versions(&workspace, &tools, &peers)?;
    let ratios = budgets::bars(&workspace)?;
    let compared = bars::compared(&ratios, &rows);
    // Times on a host vary: one that happens to meet its bar is no reason to fail.
    let unmet: Vec<String> = compared
        .iter()
        .filter(|compared| !compared.is_met())
        .filter_map(Compared::complaint)
        .collect();
    let report = Report {
        rows,
        compared,
        versions,
        date: docs::today_and_commit(&workspace),
    };
    let page = LOOPS.replaced(&report.markdown(), &report.loops())?;
    workspace::write(&workspace.report("docs/peers.md"), &page)?;
    drawn::write(&workspace, "docs/peers.md")?;
    let code = docs::show(args.json, &report.rows, &page)?;
    if !unmet.is_empty() {
        bail!("bar: {}", unmet.join("\nbar: "));
    }
    Ok(code)
}

/// The versions of all that was measured or measured with.
fn versions(workspace: &Workspace, tools: &Tools, peers: &Peers) -> Result<Vec<String>> {
    let script = "from importlib.metadata import version\n\
                  for p in ('pin', 'casadi', 'mujoco'): print(p, version(p))";
    let said = shell::capture(Command::new(&peers.python).args(["-c", script]))?;
    let mut versions: Vec<String> = said.lines().map(str::to_owned).collect();
    let dynibo = shell::capture(workspace.cargo("pkgid").arg("dynibo"))?;
    versions.extend(
        dynibo
            .trim()
            .rsplit_once('@')
            .map(|(_, version)| format!("dynibo {version}")),
    );
    versions.extend(target::compilers());
    versions.push(tools.toolchain.rustc_version()?);
    versions.push(tools.qemu.version.clone());
    versions.extend(processor().map(|name| format!("host: {name}")));
    Ok(versions)
}

/// The name of this machine's processor, if the system has it.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
