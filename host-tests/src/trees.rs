//! Two trees that mix every kind of joint: each kind at a root, in the middle and at a leaf, with
//! general axes, placements and inertias.
//!
//! The numbers are drawn while compiling from a fixed seed, on a grid that f32 represents; every
//! inertia is that of a real distribution of mass.

use dynamics_core::model::{BASE, Body, Joint, Model, Robot};

/// 17 bodies: the joints of roots and leaves are free, revolute, fixed, universal, helical; those
/// between are spherical, prismatic, planar, continuous, cylindrical.
#[derive(Clone, Copy, Debug, Default)]
pub struct TreeA;

/// 17 bodies, the other way round.
#[derive(Clone, Copy, Debug, Default)]
pub struct TreeB;

/// The numbers of one body, drawn in a fixed order.
struct Draw(u64);

impl Draw {
    const fn new(tree: u64, body: u64) -> Self {
        Self(tree << 32 | body << 16 | 0x2024)
    }

    /// A number in [-1, 1) on a grid of 1/128: the mixing function of splitmix64 (Steele, Lea,
    /// Flood 2014).
    const fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 56) as f64 / 128.0 - 1.0
    }

    const fn vector(&mut self, scale: f64) -> [f64; 3] {
        [scale * self.next(), scale * self.next(), scale * self.next()]
    }

    /// An axis of any direction, away from zero.
    const fn axis(&mut self) -> [f64; 3] {
        let [x, y, z] = self.vector(1.0);
        [x, y, if z < 0.0 { z - 0.5 } else { z + 0.5 }]
    }

    /// Σ (d·d 1 − d dᵀ) over six points of mass m/6 at ±d, about their centre.
    const fn inertia(&mut self, mass: f64) -> [f64; 6] {
        let (mut i, mut k) = ([0.0; 6], 0);
        while k < 3 {
            let mut d = self.vector(0.125);
            d[k] += 0.1875;
            let ([x, y, z], m) = (d, mass / 3.0);
            i[0] += m * (y * y + z * z);
            i[1] -= m * x * y;
            i[2] -= m * x * z;
            i[3] += m * (x * x + z * z);
            i[4] -= m * y * z;
            i[5] += m * (x * x + y * y);
            k += 1;
        }
        i
    }
}

const fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// The joint of this name with general axes.
const fn joint(name: &str, draw: &mut Draw) -> Joint<f64> {
    let (axis, other) = (draw.axis(), draw.axis());
    match name.as_bytes() {
        [b'r', ..] => Joint::revolute(axis),
        [b'c', b'o', ..] => Joint::continuous(axis),
        [b'p', b'r', ..] => Joint::prismatic(axis),
        [b'h', ..] => Joint::helical(axis, 0.125 + 0.0625 * draw.next()),
        [b'c', b'y', ..] => Joint::cylindrical(axis),
        [b'u', ..] => Joint::universal(axis, cross(axis, other)),
        [b's', ..] => Joint::spherical(),
        [b'p', b'l', ..] => Joint::planar(),
        [b'f', b'r', ..] => Joint::free(),
        [b'f', b'i', ..] => Joint::fixed(),
        _ => panic!("no such joint"),
    }
}

const fn body(tree: u64, index: usize, parent: usize, name: &'static str) -> Body {
    let mut draw = Draw::new(tree, index as u64);
    let mass = 1.5 + draw.next();
    Body::new(name, parent, joint(name, &mut draw))
        .xyz(draw.vector(0.5))
        .rpy(draw.vector(3.0))
        .mass(mass)
        .com(draw.vector(0.125))
        .inertia(draw.inertia(mass))
}

/// Parents first and depth first; a body's name begins with its joint's.
const fn tree(number: u64, list: [(usize, &'static str); 17]) -> [Body; 17] {
    let mut bodies = [Body::new("", BASE, Joint::fixed()); 17];
    let mut i = 0;
    while i < 17 {
        bodies[i] = body(number, i, list[i].0, list[i].1);
        i += 1;
    }
    bodies
}

impl Robot<17, 35, 32> for TreeA {
    const MODEL: Model<f64, 17, 35, 32> = Model::new(
        "tree_a",
        tree(
            1,
            [
                (BASE, "universal root"),
                (0, "helical leaf"),
                (BASE, "helical root"),
                (2, "revolute leaf"),
                (BASE, "fixed root"),
                (4, "revolute root"),
                (5, "planar"),
                (6, "fixed leaf"),
                (5, "cylindrical"),
                (8, "free leaf"),
                (BASE, "free root"),
                (10, "spherical"),
                (11, "continuous"),
                (12, "helical leaf"),
                (11, "prismatic"),
                (14, "revolute leaf"),
                (14, "universal tip"),
            ],
        ),
    );
}

impl Robot<17, 35, 32> for TreeB {
    const MODEL: Model<f64, 17, 35, 32> = Model::new(
        "tree_b",
        tree(
            2,
            [
                (BASE, "spherical root"),
                (0, "revolute"),
                (1, "prismatic leaf"),
                (BASE, "cylindrical root"),
                (3, "continuous leaf"),
                (BASE, "prismatic root"),
                (5, "prismatic leaf"),
                (BASE, "continuous root"),
                (7, "free"),
                (8, "spherical leaf"),
                (BASE, "planar root"),
                (10, "universal"),
                (11, "helical"),
                (12, "planar leaf"),
                (12, "fixed"),
                (14, "continuous leaf"),
                (14, "cylindrical tip"),
            ],
        ),
    );
}
