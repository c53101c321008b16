//! `peers-bench MANIFEST`: checks every function of the manifest, and ours, against what Pinocchio
//! recorded, then times them in one process, their batches interleaved. Each line on stdout is a
//! JSON object. `cargo xtask peers` writes the manifest and reads the lines.

mod dynibo;
mod foreign;
mod ours;
mod robot;
mod subject;

use std::error::Error;
use std::path::PathBuf;

use dynamics_core::robots::{A1, G1, Iiwa14, Panda, Ur5e};
use serde::Deserialize;

use foreign::Foreign;

/// What xtask has built.
#[derive(Deserialize)]
struct Manifest {
    /// The functions.
    foreign: Vec<Foreign>,
    /// The directory of `<robot>.urdf`.
    urdfs: PathBuf,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args()
        .nth(1)
        .ok_or("usage: peers-bench MANIFEST")?;
    let manifest: Manifest = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    macro_rules! robots {
        ($($robot:ident $b:literal $n:literal $known:ident;)*) => {$(
            let known = Some((ours::$known::<$robot, _, $b, $n> as _, ours::$known::<$robot, _, $b, $n> as _));
            robot::run::<$robot, $b, $n>(&manifest, known)?;
        )*};
    }
    robots! { Ur5e 6 6 all; Panda 7 7 all; Iiwa14 7 7 all; A1 16 12 inverse; }
    robot::run::<G1, 29, 29>(&manifest, None)
}
