//! `peers-bench MANIFEST`: checks every function of the manifest, and ours, against what Pinocchio
//! recorded, then times them in one process, their batches interleaved. Each line on stdout is a
//! JSON object. `cargo xtask peers` writes the manifest and reads the lines.

mod dynibo;
mod foreign;
mod loops;
mod ours;
mod robot;
mod subject;

use std::error::Error;
use std::path::PathBuf;

use cluster_tests::DeltaRobot;
use dynamics_core::robots::{A1, G1, Iiwa14, Panda, Ur5e};
use firmware_demo::robots::{AnkleLeg, FourBarLeg, StewartPlatform};
use loop_tests::machines::{Delta, Stewart};
use serde::Deserialize;

use foreign::Foreign;

/// What xtask has built.
#[derive(Deserialize)]
struct Manifest {
    foreign: Vec<Foreign>,
    /// The directory of `<robot>.urdf`; nothing if robots without loops are not compared.
    urdfs: Option<PathBuf>,
    /// Names and libraries of Pinocchio's side of robots with loops.
    loops: Vec<(String, PathBuf)>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args()
        .nth(1)
        .ok_or("usage: peers-bench MANIFEST")?;
    let manifest: Manifest = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let loops = &manifest.loops;
    loops::general::<Delta, 10, 22, 21, 6, 18, 3>(loops)?;
    loops::general::<Stewart, 13, 25, 24, 6, 18, 6>(loops)?;
    // Planar, so that one row of three is redundant.
    loops::clustered::<FourBarLeg, 5, 5, 3>(loops, 1e-10)?;
    loops::clustered::<AnkleLeg, 9, 9, 3>(loops, 0.0)?;
    loops::clustered::<DeltaRobot, 12, 12, 3>(loops, 0.0)?;
    loops::clustered::<StewartPlatform, 24, 24, 6>(loops, 0.0)?;
    let Some(urdfs) = &manifest.urdfs else {
        return Ok(());
    };
    macro_rules! robots {
        ($($robot:ident $b:literal $n:literal $known:ident;)*) => {$(
            let known = Some((ours::$known::<$robot, _, $b, $n> as _, ours::$known::<$robot, _, $b, $n> as _));
            robot::run::<$robot, $b, $n>(&manifest, urdfs, known)?;
        )*};
    }
    robots! { Ur5e 6 6 all; Panda 7 7 all; Iiwa14 7 7 all; A1 16 12 inverse; }
    robot::run::<G1, 29, 29>(&manifest, urdfs, None)
}
