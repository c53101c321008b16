//! The same dynamics by other libraries and by ours, side by side in one run.

mod build;
mod gates;
mod host;
mod report;
mod robots;
mod target;
mod tools;
mod ways;

use std::process::Command;
use std::thread;

use xtask::kit::error::{Result, check};
use xtask::kit::setup::Tools;
use xtask::kit::shell;
use xtask::studies::study::Bench;

use crate::page::Part;
use crate::peers::build::Workshop;
use crate::peers::report::Report;
use crate::peers::tools::Peers;

/// ID(q, q̇, q̈), ID(q, q̇, 0), ID(q, 0, 0), the mass matrix, FD(q, q̇, τ), and Λ⁻¹ of the tip of
/// an arm.
const ALGORITHMS: [&str; 6] = ["rnea", "bias", "gravity", "crba", "aba", "osim"];
/// The algorithms that CasADi prints: Pinocchio's, and those in the coordinates of the links. Each
/// has the end of its functions' names, and the peer's.
const FORMS: [[&str; 2]; 2] = [["", "casadi"], ["links", "casadi links"]];
/// ∂ID/∂q and ∂ID/∂q̇, on the host alone.
const GRADIENT: &str = "gradient";
const PRECISIONS: [&str; 2] = ["f32", "f64"];

/// The forms in which an algorithm is printed: Λ⁻¹ by Pinocchio's alone.
fn forms(algorithm: &str) -> &'static [[&'static str; 2]] {
    if algorithm == "osim" { &FORMS[..1] } else { &FORMS }
}

/// The number of outputs of an algorithm with this number of velocity coordinates; of a matrix one
/// triangle counts.
fn outputs(algorithm: &str, velocities: usize) -> usize {
    match algorithm {
        "crba" => velocities * (velocities + 1) / 2,
        "osim" => 21,
        _ => velocities,
    }
}

/// Sets up, builds and measures.
///
/// # Errors
/// Among others, a function's result is not Pinocchio's.
pub fn measure(bench: &Bench<'_>) -> Result<Vec<Part>> {
    let workspace = bench.workspace;
    let (tools, peers) = tools::set_up(workspace, bench.options)?;
    let shop = Workshop::new(workspace, &peers)?;
    let robots = robots::export(workspace)?;
    // Nothing but the times waits for Pinocchio.
    let (others, pinocchio) = thread::scope(|scope| {
        let pinocchio = scope.spawn(|| host::pinocchio(&shop));
        let others = || {
            let benches = host::benches(workspace)?;
            shop.generate(&robots)?;
            let on_target = target::measure(bench, &shop, &robots)?;
            let on_gates = gates::measure(bench, &shop, &robots)?;
            Ok((on_target, on_gates, host::casadi(&shop, &robots)?, benches))
        };
        (others(), pinocchio.join())
    });
    let ((mut rows, builds), on_gates, casadi, benches) = others?;
    pinocchio.map_err(|_| check!("a build of Pinocchio panicked"))??;
    rows.extend(on_gates);
    rows.extend(host::measure(&shop, &robots, casadi, &benches)?);
    Ok(Report { rows, builds, versions: versions(&tools, &peers)? }.parts())
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
