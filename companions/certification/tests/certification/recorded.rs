//! Machine code that was compiled one day, and a robot for it.

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

pub fn bytes(hex: &str) -> Vec<u8> {
    let digits: Vec<u32> = hex.chars().filter_map(|c| c.to_digit(16)).collect();
    digits.chunks(2).map(|pair| (pair[0] << 4 | pair[1]) as u8).collect()
}

/// A program of one function, with its address and its effects.
pub fn program(mut code: Vec<u8>, name: &str) -> Image {
    let (size, effects) = (code.len() as u32, bytes(EFFECTS));
    let pointer = BASE + size + effects.len() as u32;
    code.extend(effects);
    code.extend((BASE | 1).to_le_bytes());
    Image::of(BASE, &code)
        .with_function(&name.to_lowercase(), BASE, size)
        .with_function("CERTIFIED_EFFECTS", BASE + size, pointer - BASE - size)
        .with_function(&format!("CERTIFIED_{name}"), pointer, 4)
}

/// A program of forward dynamics and of M at these addresses.
pub fn forward_program(mut code: Vec<u8>, functions: [u32; 2], of_core: &str) -> Image {
    let end = BASE + code.len() as u32;
    let words = functions.into_iter().chain([12, 4, 8, 0]);
    code.extend(words.flat_map(u32::to_le_bytes));
    code.extend(bytes(EFFECTS));
    Image::of(BASE, &code)
        .with_function(&format!("CERTIFIED_{of_core}FORWARD"), end, 4)
        .with_function(&format!("CERTIFIED_{of_core}CRBA"), end + 4, 4)
        .with_function("CERTIFIED_TRIG", end + 8, 16)
        .with_function("CERTIFIED_EFFECTS", end + 24, 16)
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
