//! The host's side: every peer in one process, their batches interleaved.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Serialize;

use crate::error::{Result, check};
use crate::peers::build::Workshop;
use crate::peers::report::{HOST, Row};
use crate::peers::robots::Robot;
use crate::peers::{ALGORITHMS, LARGE, PRECISIONS, outputs};
use crate::progress::Spinner;
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

/// The input of the benchmark.
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
        .map_err(|e| check!("cannot write the manifest: {e}"))?;
    workspace::write(&path, json)?;
    run(&bench(workspace)?, &path)
}

fn build(shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Foreign>> {
    let mut foreign = Vec::new();
    for compiler in CPP_COMPILERS {
        let library = shop.pinocchio(compiler)?;
        for one in all(robots) {
            let precision = one.precision;
            let open = (format!("pinocchio_{precision}_open"), shop.robots_file());
            let run = format!("pinocchio_{precision}_{}", one.algorithm);
            foreign.push(one.by(format!("pinocchio {compiler}"), &library, run, Some(open)));
        }
    }
    let library = shop.mujoco()?;
    for robot in robots {
        for (algorithm, peer, run) in MUJOCO {
            let file = shop.robots.join(format!("{}.xml", robot.name));
            let open = ("mujoco_f64_open".to_owned(), file);
            let one = Wanted {
                robot,
                algorithm,
                precision: "f64",
            };
            foreign.push(one.by(
                peer.into(),
                &library,
                format!("mujoco_f64_{run}"),
                Some(open),
            ));
        }
    }
    let spinner = Spinner::start("building CasADi's C for the host");
    for one in all(robots) {
        let (name, algorithm) = (&one.robot.name, one.algorithm);
        let sizes = [one.robot.joints(), outputs(algorithm, one.robot.joints())];
        for (inputs, compilers) in [("q", &C_COMPILERS[..]), ("cs", &C_COMPILERS[..1])] {
            // What takes cosines is for the target, where large robots are not compared.
            if inputs == "cs" && one.robot.has_subtree_functions() {
                continue;
            }
            let name = format!("{name}_{algorithm}_{inputs}_{}", one.precision);
            for compiler in compilers {
                spinner.say(format!("building {name} by {compiler}"));
                let library = shop.casadi(compiler, &name, sizes)?;
                let peer = format!("casadi {compiler}");
                foreign.push(Foreign {
                    cs: inputs == "cs",
                    // It is timed there.
                    timed: inputs == "q",
                    outputs: sizes[1],
                    square: false,
                    ..one.by(peer, &library, format!("casadi_{name}"), None)
                });
            }
        }
    }
    Ok(foreign)
}

/// What is to be computed.
struct Wanted<'a> {
    robot: &'a Robot,
    algorithm: &'static str,
    precision: &'static str,
}

/// Everything that is compared.
fn all(robots: &[Robot]) -> impl Iterator<Item = Wanted<'_>> {
    robots.iter().flat_map(|robot| {
        let (algorithms, precisions) = compared(robot);
        let pairs = precisions
            .iter()
            .flat_map(|p| algorithms.iter().map(move |a| (a, p)));
        pairs.map(move |(algorithm, precision)| Wanted {
            robot,
            algorithm,
            precision,
        })
    })
}

impl Wanted<'_> {
    /// A library's function for it, which writes M as a square.
    fn by(
        &self,
        peer: String,
        library: &Path,
        run: String,
        open: Option<(String, PathBuf)>,
    ) -> Foreign {
        let (joints, square) = (self.robot.joints(), self.algorithm == "crba");
        Foreign {
            robot: self.robot.name.clone(),
            algorithm: self.algorithm.into(),
            peer,
            precision: self.precision.into(),
            library: library.to_owned(),
            run,
            open,
            cs: false,
            outputs: if square { joints * joints } else { joints },
            square,
            timed: true,
        }
    }
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
