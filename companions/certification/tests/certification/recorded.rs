//! Machine code that was compiled one day, and a robot for it.

use std::process::Command;

use certification::bound::SineErrors;
use certification::graph::Graph;
use certification::image::Image;
use certification::interval::Interval;
use certification::search::Effort;
use certification::state_box::{Joint, Robot};
use certification::walk::walk;

/// `Engine::<Ur5e>::rnea` and the same of gravity alone as they were compiled one day.
pub const RNEA: &str = include_str!("ur5e_rnea.hex");
pub const GRAVITY: &str = include_str!("ur5e_gravity.hex");
/// The bytes of `RIGID_BODY` in memory.
pub const EFFECTS: &str = "1f85eb51b89e2340c3f51c4100000000";
pub const BASE: u32 = 0x0800_0000;

/// Whether Gappa can check a script here; if not, the output says so.
pub fn gappa_is_installed() -> bool {
    let version = Command::new("gappa").arg("--version").output();
    if version.is_err() {
        eprintln!("not tested: Gappa is not installed (Debian: gappa)");
    }
    version.is_ok()
}

pub fn bytes(hex: &str) -> Vec<u8> {
    let digits: Vec<u32> = hex.chars().filter_map(|c| c.to_digit(16)).collect();
    digits.chunks(2).map(|pair| (pair[0] << 4 | pair[1]) as u8).collect()
}

pub fn graph(hex: &str) -> Graph {
    let mut code = bytes(hex);
    let effects = BASE + code.len() as u32;
    code.extend(bytes(EFFECTS));
    let walked = walk(&Image::of(BASE, &code), BASE, [None, None, None, Some(effects)]);
    walked.expect("it is straight-line").graph
}

pub fn robot(joints: usize) -> Robot {
    let joint =
        Joint { turns: true, position: Interval::new(-3.0, 3.0), speed: 3.0, acceleration: 10.0 };
    Robot { joints: vec![joint; joints], trig: [12, 4, 8, 0] }
}

pub const SINES: SineErrors = SineErrors { sine: 1e-7, cosine: 1e-7 };
pub const LITTLE: Effort = Effort { random: 2000, generations: 4, children: 100 };
