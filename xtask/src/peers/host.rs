//! The host's side: every peer in one process, their batches interleaved.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::peers::build::Workshop;
use crate::peers::report::{HOST, Row};
use crate::peers::robots::Robot;
use crate::peers::{ALGORITHMS, LARGE, PRECISIONS, outputs};
use crate::shell;
use crate::workspace::{self, Workspace};

const C_COMPILERS: [&str; 2] = ["gcc", "clang"];
/// MuJoCo's: algorithm, name in the report, function.
const MUJOCO: [(&str, &str, &str); 4] = [
    ("rnea", "mujoco mj_inverse", "inverse"),
    ("rnea", "mujoco mj_rne", "rnea"),
    ("crba", "mujoco mj_makeM", "crba"),
    ("aba", "mujoco mj_solveM", "forward"),
];
const CPP_COMPILERS: [&str; 2] = ["g++", "clang++"];

/// What the benchmark is told.
#[derive(Serialize)]
struct Manifest {
    foreign: Vec<Foreign>,
    urdfs: PathBuf,
}

/// A function in a shared library (see `host-tests/peers/bench/src/foreign.rs`).
#[derive(Serialize)]
struct Foreign {
    robot: String,
    algorithm: String,
    peer: String,
    precision: String,
    library: PathBuf,
    run: String,
    open: Option<(String, PathBuf)>,
    cs: bool,
    outputs: usize,
    square: bool,
    timed: bool,
}

/// A line of the benchmark's.
#[derive(Deserialize)]
struct Line {
    robot: String,
    algorithm: String,
    peer: String,
    precision: String,
    ns: Option<f64>,
}

/// Shared libraries that [`measure`] makes.
pub fn steps(robots: &[Robot]) -> usize {
    let casadi = robots.iter().map(|robot| {
        let (algorithms, precisions) = compared(robot);
        let cs = usize::from(!robot.has_subtree_functions());
        algorithms.len() * precisions.len() * (C_COMPILERS.len() + cs)
    });
    casadi.sum::<usize>() + CPP_COMPILERS.len() + 1
}

/// Algorithms and precisions of a robot.
fn compared(robot: &Robot) -> (&'static [&'static str], &'static [&'static str]) {
    if robot.has_subtree_functions() {
        (&LARGE, &PRECISIONS[1..])
    } else {
        (&ALGORITHMS, &PRECISIONS)
    }
}

/// Builds the peers and the benchmark, and runs it.
pub fn measure(workspace: &Workspace, shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Row>> {
    let manifest = Manifest {
        foreign: build(shop, robots)?,
        urdfs: shop.robots.clone(),
    };
    let path = shop.built.join("manifest.json");
    let json = serde_json::to_string_pretty(&manifest)
        .map_err(|e| Error::check(format!("cannot write the manifest: {e}")))?;
    workspace::write(&path, json)?;
    let bench = bench(workspace, shop)?;
    run(&bench, &path, shop)
}

fn build(shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Foreign>> {
    let mut foreign = Vec::new();
    for compiler in CPP_COMPILERS {
        let library = shop.pinocchio(compiler)?;
        for robot in robots {
            let (algorithms, precisions) = compared(robot);
            for precision in precisions {
                for algorithm in algorithms {
                    let one = casadi(robot, algorithm, precision, "", &library);
                    foreign.push(Foreign {
                        peer: format!("pinocchio {compiler}"),
                        run: format!("pinocchio_{precision}_{algorithm}"),
                        open: Some((format!("pinocchio_{precision}_open"), shop.robots_file())),
                        ..square(one, robot)
                    });
                }
            }
        }
    }
    let library = shop.mujoco()?;
    for robot in robots {
        for (algorithm, peer, run) in MUJOCO {
            let one = casadi(robot, algorithm, "f64", "", &library);
            foreign.push(Foreign {
                peer: peer.into(),
                run: format!("mujoco_f64_{run}"),
                open: Some((
                    "mujoco_f64_open".into(),
                    shop.robots.join(format!("{}.xml", robot.name)),
                )),
                ..square(one, robot)
            });
        }
    }
    shop.progress.doing("building CasADi's C for the host");
    for robot in robots {
        let (algorithms, precisions) = compared(robot);
        for algorithm in algorithms {
            for precision in precisions {
                let sizes = [robot.joints(), outputs(algorithm, robot.joints())];
                let all = [("q", &C_COMPILERS[..]), ("cs", &C_COMPILERS[..1])];
                // What takes cosines is for the target.
                let wanted = if robot.has_subtree_functions() {
                    &all[..1]
                } else {
                    &all
                };
                for &(inputs, compilers) in wanted {
                    let name = format!("{}_{algorithm}_{inputs}_{precision}", robot.name);
                    for compiler in compilers {
                        let library = shop.casadi(compiler, &name, sizes)?;
                        foreign.push(Foreign {
                            peer: format!("casadi {compiler}"),
                            cs: inputs == "cs",
                            // What takes cosines is timed on the target.
                            timed: inputs == "q",
                            ..casadi(robot, algorithm, precision, inputs, &library)
                        });
                    }
                }
            }
        }
    }
    Ok(foreign)
}

/// A function of CasADi's, and what all functions have in common.
fn casadi(
    robot: &Robot,
    algorithm: &str,
    precision: &str,
    inputs: &str,
    library: &Path,
) -> Foreign {
    Foreign {
        robot: robot.name.clone(),
        algorithm: algorithm.into(),
        peer: String::new(),
        precision: precision.into(),
        library: library.to_owned(),
        run: format!("casadi_{}_{algorithm}_{inputs}_{precision}", robot.name),
        open: None,
        cs: false,
        outputs: outputs(algorithm, robot.joints()),
        square: false,
        timed: true,
    }
}

/// The same by a library that writes M as a square.
fn square(mut of: Foreign, robot: &Robot) -> Foreign {
    if of.algorithm == "crba" {
        of.outputs = robot.joints() * robot.joints();
        of.square = true;
    }
    of
}

/// Our side, for this very processor like the others: in a directory of its own, since other flags
/// rebuild everything.
fn bench(workspace: &Workspace, shop: &Workshop<'_>) -> Result<PathBuf> {
    shop.progress
        .doing("compiling our side and dynibo for this processor");
    let target = workspace.target.join("peers").join("native");
    let mut command = workspace.cargo("build");
    command
        .args(["--release", "--package", "peers-bench", "--target-dir"])
        .arg(&target)
        .env("RUSTFLAGS", "-Ctarget-cpu=native")
        // It would take precedence.
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    shell::capture(&mut command)?;
    Ok(target
        .join("release")
        .join(format!("peers-bench{}", std::env::consts::EXE_SUFFIX)))
}

fn run(bench: &Path, manifest: &Path, shop: &Workshop<'_>) -> Result<Vec<Row>> {
    shop.progress.doing("timing on the host");
    let mut command = Command::new(bench);
    command.arg(manifest);
    let mut rows = Vec::new();
    shell::each_line(&mut command, |line| {
        let line: Line = serde_json::from_str(line)
            .map_err(|e| Error::check(format!("peers-bench printed {line:?}: {e}")))?;
        shop.progress
            .doing_quietly(&format!("timing {} of {}", line.algorithm, line.robot));
        if line.ns.is_some() {
            rows.push(Row {
                target: HOST,
                robot: line.robot,
                algorithm: line.algorithm,
                peer: line.peer,
                precision: line.precision,
                ns: line.ns,
                ..Row::default()
            });
        }
        Ok(())
    })?;
    Ok(rows)
}
