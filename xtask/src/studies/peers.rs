//! `cargo xtask peers`: the same dynamics by other libraries and by ours, side by side in one run.

mod bars;
mod build;
mod gates;
mod host;
mod report;
mod robot_dynamics;
mod robots;
mod target;
mod tools;

use std::process::{Command, ExitCode};
use std::thread;

use crate::kit::docs;
use crate::kit::error::{Result, bail, check};
use crate::kit::setup::{Options, Tools};
use crate::kit::shell;
use crate::kit::workspace::{self, Workspace};
use crate::studies::peers::build::Workshop;
use crate::studies::peers::report::Report;
use crate::studies::peers::tools::Peers;

/// ID(q, q̇, q̈), ID(q, q̇, 0), ID(q, 0, 0), the mass matrix, FD(q, q̇, τ), and Λ⁻¹ of the tip of
/// an arm.
const ALGORITHMS: [&str; 6] = ["rnea", "bias", "gravity", "crba", "aba", "osim"];
/// ∂ID/∂q and ∂ID/∂q̇, on the host alone.
const GRADIENT: &str = "gradient";
const PRECISIONS: [&str; 2] = ["f32", "f64"];
const PAGE: &str = "docs/peers.md";
/// The most seconds of processor time of a release build of firmware with one function.
const BUILD: f64 = 60.0;

/// The number of outputs of an algorithm with this number of velocity coordinates; of a matrix one
/// triangle counts.
fn outputs(algorithm: &str, velocities: usize) -> usize {
    match algorithm {
        "crba" => velocities * (velocities + 1) / 2,
        "osim" => 21,
        _ => velocities,
    }
}

#[derive(clap::Args)]
pub struct Args {
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
}

/// Sets up, builds, measures, and writes `docs/peers.md`.
///
/// # Errors
/// Among others, a function takes the compiler longer than [`BUILD`].
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let (tools, peers) = tools::set_up(&workspace, options)?;
    let shop = Workshop::new(&workspace, &peers)?;
    let robots = robots::export(&workspace)?;
    // Nothing but the times waits for Pinocchio.
    let (others, pinocchio) = thread::scope(|scope| {
        let pinocchio = scope.spawn(|| host::pinocchio(&shop));
        let others = || {
            let benches = host::benches(&workspace)?;
            shop.generate(&robots)?;
            let on_target = target::measure(&workspace, &shop, &tools, &robots)?;
            let on_gates = gates::measure(&workspace, &shop, options, &robots)?;
            Ok((on_target, on_gates, host::casadi(&shop, &robots)?, benches))
        };
        (others(), pinocchio.join())
    });
    let ((mut rows, builds), on_gates, casadi, benches) = others?;
    pinocchio.map_err(|_| check!("a build of Pinocchio panicked"))??;
    rows.extend(on_gates);
    rows.extend(host::measure(&shop, &robots, casadi, &benches)?);
    let versions = versions(&tools, &peers)?;
    let compared = bars::compared(&bars::read()?, &rows);
    let slow = builds.iter().filter(|(_, seconds)| *seconds > BUILD);
    let slow = slow.map(|(function, seconds)| format!("{function}: built in {seconds:.0} s"));
    let unmet: Vec<String> = slow.collect();
    let report =
        Report { rows, builds, compared, versions, date: docs::today_and_commit(&workspace) };
    let page = report.markdown();
    workspace::write(&workspace.report(PAGE), &page)?;
    let code = docs::show(args.json, &report.rows, &page)?;
    if !unmet.is_empty() {
        bail!("bar: {}", unmet.join("\nbar: "));
    }
    Ok(code)
}

/// The versions of all that was measured or measured with.
fn versions(tools: &Tools, peers: &Peers) -> Result<Vec<String>> {
    let script = "from importlib.metadata import version\n\
                  for p in ('pin', 'casadi'): print(p, version(p))";
    let said = shell::capture(Command::new(&peers.python).args(["-c", script]))?;
    let mut versions: Vec<String> = said.lines().map(str::to_owned).collect();
    versions.extend(build::compilers());
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
