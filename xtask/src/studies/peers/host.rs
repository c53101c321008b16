//! The host's side: every peer in one process, their batches interleaved.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

use crate::kit::error::{Result, check};
use crate::kit::progress::Spinner;
use crate::kit::shell;
use crate::kit::workspace::{self, Workspace};
use crate::studies::peers::build::Workshop;
use crate::studies::peers::report::{HOST, Row};
use crate::studies::peers::robots::Robot;
use crate::studies::peers::{ALGORITHMS, LARGE, PRECISIONS, outputs};

const C_COMPILERS: [&str; 2] = ["gcc", "clang"];
/// MuJoCo's: algorithm, name in the report, function.
const MUJOCO: [(&str, &str, &str); 4] = [
    ("rnea", "mujoco mj_inverse", "inverse"),
    ("rnea", "mujoco mj_rne", "rnea"),
    ("crba", "mujoco mj_makeM", "crba"),
    ("aba", "mujoco mj_solveM", "forward"),
];
const CPP_COMPILERS: [&str; 2] = ["g++", "clang++"];

/// A computation: its robot, algorithm and precision.
type Wanted<'a> = (&'a Robot, &'static str, &'static str);

/// Algorithms and precisions of a robot.
fn compared(robot: &Robot) -> (&'static [&'static str], &'static [&'static str]) {
    if robot.has_subtree_functions() {
        (&LARGE, &PRECISIONS[1..])
    } else {
        (&ALGORITHMS, &PRECISIONS)
    }
}

/// Builds the peers and the benchmark, and runs it; without robots those with loops alone.
pub fn measure(workspace: &Workspace, shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Row>> {
    let loops = CPP_COMPILERS.map(|compiler| {
        let library = shop.pinocchio("pinocchio_loops", compiler)?;
        Ok((format!("pinocchio {compiler}"), library))
    });
    let loops: Vec<_> = loops.into_iter().collect::<Result<_>>()?;
    let manifest = match robots {
        [] => json!({ "foreign": [], "loops": loops }),
        _ => json!({ "foreign": build(shop, robots)?, "urdfs": shop.robots, "loops": loops }),
    };
    let path = shop.built.join("manifest.json");
    workspace::write(&path, manifest.to_string())?;
    run(&bench(workspace)?, &path)
}

fn build(shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Value>> {
    let mut all = Vec::new();
    for compiler in CPP_COMPILERS {
        let library = shop.pinocchio("pinocchio_peer", compiler)?;
        for wanted in wanted(robots) {
            let (_, algorithm, precision) = wanted;
            let open = (format!("pinocchio_{precision}_open"), shop.robots_file());
            let run = format!("pinocchio_{precision}_{algorithm}");
            all.push(foreign(
                wanted,
                &format!("pinocchio {compiler}"),
                &library,
                run,
                Some(open),
            ));
        }
    }
    let library = shop.mujoco()?;
    for robot in robots {
        for (algorithm, peer, run) in MUJOCO {
            let file = shop.robots.join(format!("{}.xml", robot.name));
            let open = ("mujoco_f64_open".to_owned(), file);
            let run = format!("mujoco_f64_{run}");
            all.push(foreign(
                (robot, algorithm, "f64"),
                peer,
                &library,
                run,
                Some(open),
            ));
        }
    }
    let spinner = Spinner::start("building CasADi's C for the host");
    for wanted in wanted(robots) {
        let (robot, algorithm, precision) = wanted;
        let sizes = [robot.joints(), outputs(algorithm, robot.joints())];
        for (inputs, compilers) in [("q", &C_COMPILERS[..]), ("cs", &C_COMPILERS[..1])] {
            // Functions that take cosines are for the target, where large robots are not compared; they are timed there.
            if inputs == "cs" && robot.has_subtree_functions() {
                continue;
            }
            let name = format!("{}_{algorithm}_{inputs}_{precision}", robot.name);
            for compiler in compilers {
                spinner.say(format!("building {name} by {compiler}"));
                let library = shop.casadi(compiler, &name, sizes)?;
                let (peer, run) = (format!("casadi {compiler}"), format!("casadi_{name}"));
                let mut one = foreign(wanted, &peer, &library, run, None);
                one["cs"] = (inputs == "cs").into();
                one["timed"] = (inputs == "q").into();
                one["outputs"] = sizes[1].into();
                one["square"] = false.into();
                all.push(one);
            }
        }
    }
    Ok(all)
}

fn wanted(robots: &[Robot]) -> impl Iterator<Item = Wanted<'_>> {
    robots.iter().flat_map(|robot| {
        let (algorithms, precisions) = compared(robot);
        let pairs = precisions
            .iter()
            .flat_map(|p| algorithms.iter().map(move |a| (a, p)));
        pairs.map(move |(algorithm, precision)| (robot, *algorithm, *precision))
    })
}

/// A library's function (see `lab/peers/bench/src/foreign.rs`), which writes M as a square.
fn foreign(
    (robot, algorithm, precision): Wanted<'_>,
    peer: &str,
    library: &Path,
    run: String,
    open: Option<(String, PathBuf)>,
) -> Value {
    let (joints, square) = (robot.joints(), algorithm == "crba");
    let outputs = if square { joints * joints } else { joints };
    json!({
        "robot": robot.name, "algorithm": algorithm, "precision": precision, "peer": peer,
        "library": library, "run": run, "open": open,
        "cs": false, "outputs": outputs, "square": square, "timed": true,
    })
}

/// Our side, for this very processor like the others: in a directory of its own, since other flags
/// rebuild everything.
fn bench(workspace: &Workspace) -> Result<PathBuf> {
    let _spinner = Spinner::start("compiling our side and dynibo for this processor");
    let target = workspace.target.join("peers/native");
    let mut command = workspace.cargo("build");
    command
        .args(["--release", "--package", "peers-bench", "--target-dir"])
        .arg(&target)
        .env("RUSTFLAGS", "-Ctarget-cpu=native")
        // It would take precedence.
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    shell::capture(&mut command)?;
    Ok(target.join("release/peers-bench"))
}

fn run(bench: &Path, manifest: &Path) -> Result<Vec<Row>> {
    let spinner = Spinner::start("timing on the host");
    let mut command = Command::new(bench);
    command.arg(manifest);
    let mut rows = Vec::new();
    shell::each_line(&mut command, |line| {
        let mut row: Row =
            serde_json::from_str(line).map_err(|e| check!("peers-bench printed {line:?}: {e}"))?;
        spinner.say(format!("timing {} of {}", row.algorithm, row.robot));
        row.target = HOST;
        rows.extend(row.ns.is_some().then_some(row));
        Ok(())
    })?;
    Ok(rows)
}
