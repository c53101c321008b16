//! The host's side: every peer in one process, their batches interleaved; five such runs.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use serde_json::{Value, json};

use xtask::kit::error::{Result, check};
use xtask::kit::progress::Spinner;
use xtask::kit::shell;
use xtask::kit::workspace::{self, Workspace};

use crate::MANIFEST;
use crate::peers::build::Workshop;
use crate::peers::report::{self, HOST, Row};
use crate::peers::robots::Robot;
use crate::peers::target;
use crate::peers::{GRADIENT, outputs};

const C_COMPILERS: [&str; 2] = ["gcc", "clang"];
const CPP_COMPILERS: [&str; 2] = ["g++", "clang++"];
/// A time is the median of this many runs, and so is a ratio.
const RUNS: usize = 5;

/// A computation: its robot, algorithm and precision.
type Wanted<'a> = (&'a Robot, &'static str, &'static str);

/// Builds Pinocchio's side, which takes compilers minutes: both beside each other.
pub fn pinocchio(shop: &Workshop<'_>) -> Result<()> {
    let built = thread::scope(|scope| {
        let threads = CPP_COMPILERS.map(|compiler| scope.spawn(move || shop.pinocchio(compiler)));
        threads.map(|thread| thread.join())
    });
    for result in built {
        result.map_err(|_| check!("a build of Pinocchio panicked"))??;
    }
    Ok(())
}

/// Runs the benchmark five times, with CasADi's functions and Pinocchio's.
pub fn measure(
    shop: &Workshop<'_>,
    robots: &[Robot],
    mut foreign: Vec<Value>,
    benches: &[PathBuf; 2],
) -> Result<Vec<Row>> {
    foreign.extend(trees(shop, robots)?);
    let manifest = json!({ "foreign": foreign });
    let path = shop.built.join("manifest.json");
    workspace::write(&path, manifest.to_string())?;
    let spinner = Spinner::start("timing on the host");
    let mut rows = [Vec::new(), Vec::new()];
    for number in 1..=RUNS {
        spinner.say(format!("timing on the host: run {number} of {RUNS}"));
        for (bench, rows) in benches.iter().zip(&mut rows) {
            rows.extend(run(bench, &path)?);
        }
    }
    let [rows, fused] = rows.map(report::of_runs);
    Ok(report::with_fused(rows, fused))
}

/// Pinocchio's functions.
fn trees(shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Value>> {
    let mut all = Vec::new();
    let text = shop.robots_file();
    for compiler in CPP_COMPILERS {
        let library = shop.pinocchio(compiler)?;
        for wanted in wanted(robots) {
            let (_, algorithm, precision) = wanted;
            let (peer, prefix) =
                (format!("pinocchio {compiler}"), format!("pinocchio_{precision}_"));
            all.push(foreign(wanted, &peer, &library, &prefix, algorithm, Some(&text)));
        }
    }
    Ok(all)
}

/// Builds CasADi's C.
pub fn casadi(shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Value>> {
    let mut all = Vec::new();
    let spinner = Spinner::start("building CasADi's C for the host");
    for robot in robots {
        for [algorithm, form, inputs, precision] in robot.casadi() {
            // Functions that take cosines are for the target, and are timed there.
            let compilers = match inputs {
                "q" => &C_COMPILERS[..],
                _ if robot.precisions().contains(&precision) => &C_COMPILERS[..1],
                _ => &[],
            };
            let name = format!("{}_{algorithm}{form}_{inputs}_{precision}", robot.name);
            let [_, positions, velocities] = robot.size();
            let sizes = [positions, velocities, outputs(algorithm, velocities)];
            for compiler in compilers {
                spinner.say(format!("building {name} by {compiler}"));
                let library = shop.casadi(compiler, &name, sizes)?;
                let wanted = (robot, algorithm, precision);
                let peer = format!("{} {compiler}", target::parts(form).0[1]);
                let mut one = foreign(wanted, &peer, &library, "casadi_", &name, None);
                one["cs"] = (inputs == "cs").into();
                one["timed"] = (inputs == "q").into();
                all.push(one);
            }
        }
    }
    Ok(all)
}

fn wanted(robots: &[Robot]) -> impl Iterator<Item = Wanted<'_>> {
    robots.iter().flat_map(|robot| {
        let gradient = (!robot.is_free() && !robot.has_many_joints()).then_some(&GRADIENT);
        let pairs = (robot.precisions().iter())
            .flat_map(move |p| robot.algorithms().iter().chain(gradient).map(move |a| (a, p)));
        pairs.map(move |(algorithm, precision)| (robot, *algorithm, *precision))
    })
}

/// A library's function (see `companions/laboratory/peers/src/foreign.rs`): the names of all its functions
/// begin with `prefix`, and the one that opens takes a file.
fn foreign(
    (robot, algorithm, precision): Wanted<'_>,
    peer: &str,
    library: &Path,
    prefix: &str,
    run: &str,
    file: Option<&Path>,
) -> Value {
    json!({
        "robot": robot.name, "algorithm": algorithm, "precision": precision, "peer": peer,
        "library": library, "run": format!("{prefix}{run}"),
        "open": file.map(|file| (format!("{prefix}open"), file)),
        "cs": false, "timed": true,
    })
}

/// The flags of our side, and the same with fused arithmetic, which that of gcc is on this machine;
/// each with the name of a directory of its own, since other flags rebuild everything.
const NATIVE: [[&str; 2]; 2] = [
    ["native", "-Ctarget-cpu=native"],
    ["fused", "-Ctarget-cpu=native -Ctarget-feature=+fma -Cllvm-args=-fp-contract=fast"],
];

/// Our side, for this very processor like the others.
pub fn benches(workspace: &Workspace) -> Result<[PathBuf; 2]> {
    let [plain, fused] = NATIVE.map(|of| bench(workspace, of));
    Ok([plain?, fused?])
}

fn bench(workspace: &Workspace, [name, flags]: [&str; 2]) -> Result<PathBuf> {
    let _spinner = Spinner::start(&format!("compiling our side for this processor: {name}"));
    let target = workspace.target.join("peers").join(name);
    let mut command = workspace.cargo("build");
    command
        .args([
            "--release",
            "--manifest-path",
            MANIFEST,
            "--package",
            "peers-bench",
            "--target-dir",
        ])
        .arg(&target)
        .env("RUSTFLAGS", flags)
        // It would take precedence.
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    shell::capture(&mut command)?;
    Ok(target.join("release/peers-bench"))
}

fn run(bench: &Path, manifest: &Path) -> Result<Vec<Row>> {
    let mut command = Command::new(bench);
    command.arg(manifest);
    let mut rows = Vec::new();
    for line in shell::capture(&mut command)?.lines() {
        let mut row: Row =
            serde_json::from_str(line).map_err(|e| check!("peers-bench printed {line:?}: {e}"))?;
        row.target = HOST;
        rows.extend(row.ns.is_some().then_some(row));
    }
    Ok(rows)
}
