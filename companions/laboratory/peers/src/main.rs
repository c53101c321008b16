//! `peers-bench MANIFEST`: checks every function of the manifest, and ours, against what Pinocchio
//! recorded, then times them in one process, their batches interleaved. Each line on stdout is a
//! JSON object. The command `peers` writes the manifest and reads the lines.

mod foreign;
mod ours;
mod robot;
mod subject;

use std::error::Error;

use dynamics_core::robots::{A1, A1Free, G1, G1Free, Iiwa14, Panda, Ur5e, XArm7};
use serde::Deserialize;

use foreign::Foreign;

/// The library that xtask has built.
#[derive(Deserialize)]
struct Manifest {
    foreign: Vec<Foreign>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: peers-bench MANIFEST")?;
    let manifest: Manifest = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    const ARM: &[&str] = &["rnea", "bias", "gravity", "crba", "aba", "gradient", "osim"];
    const DYNAMICS: &[&str] = &["rnea", "crba", "aba"];
    macro_rules! arms {
        ($($robot:ident $n:literal $tip:literal;)*) => {$(
            let known = (ours::arm::<$robot, _, $n, $n, $tip> as _, Some(ours::arm::<$robot, _, $n, $n, $tip> as _));
            robot::run::<$robot, $n, $n, $n, $n>(&manifest, ARM, known)?;
        )*};
    }
    arms! { Ur5e 6 5; Panda 7 6; Iiwa14 7 6; XArm7 7 6; }
    let known = (ours::tree::<A1, _, 16, 12, 12> as _, Some(ours::tree::<A1, _, 16, 12, 12> as _));
    robot::run::<A1, 16, 12, 12, 12>(&manifest, &ARM[..6], known)?;
    let known = (
        ours::dynamics::<A1Free, _, 17, 19, 18> as _,
        Some(ours::dynamics::<A1Free, _, 17, 19, 18> as _),
    );
    robot::run::<A1Free, 17, 13, 19, 18>(&manifest, DYNAMICS, known)?;
    robot::run::<G1, 29, 29, 29, 29>(&manifest, DYNAMICS, (|_, _| Vec::new(), None))?;
    let known = (ours::dynamics::<G1Free, _, 30, 36, 35> as _, None);
    robot::run::<G1Free, 30, 30, 36, 35>(&manifest, DYNAMICS, known)
}
