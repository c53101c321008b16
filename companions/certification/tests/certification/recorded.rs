//! Machine code that was compiled one day, and robots for it.

use certification::bodies::{Body, Moves};
use certification::bound::SineErrors;
use certification::graph::Graph;
use certification::image::Image;
use certification::interval::Interval;
use certification::search::Effort;
use certification::state_box::{Joint, Robot};
use certification::walk::walk;
use dynamics_core::model::{BASE as NONE, JointKind, Link, Model};

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

/// As the firmware writes it.
pub fn bodies<const B: usize, const N: usize>(model: &Model<f64, B, N, N>) -> Vec<Body> {
    let body = |link: &Link<f64>| {
        let columns = link.placement.rot.to_cols_array_2d();
        let i = link.inertia.rotational.to_cols_array();
        let [x, y, z] = link.inertia.first_moment.to_array();
        Body {
            parent: (link.parent != NONE).then_some(link.parent),
            moves: match link.joint.kind {
                JointKind::Fixed => Moves::Fixed,
                JointKind::Prismatic => Moves::Slides(link.idx_v),
                _ => Moves::Turns(link.idx_v),
            },
            rot: std::array::from_fn(|row| std::array::from_fn(|column| columns[column][row])),
            pos: link.placement.pos.to_array(),
            inertia: [link.inertia.mass, x, y, z, i[0], i[1], i[2], i[4], i[5], i[8]],
        }
    };
    model.links.iter().map(body).collect()
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
