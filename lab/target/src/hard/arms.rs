//! The arms.

use super::states::{COMMON, FAST, QUARTERS, QUICK, REMAINDERS, SLOW, ZIGZAG};
use super::{Extras, N, Numbers, Problem};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Link, Model, Robot};
use dynamics_core::robots::Ur5e;
use glam::{DMat3, DVec3};

const UR5E: ArmModel<f64, N> = Ur5e::MODEL;

pub const COUNT: usize = 28;

pub(super) static LIST: [Problem<ArmModel<f64, N>>; COUNT] = [
    plain(1, "tip × 10⁶", scaled(UR5E, 5, 1e6)),
    plain(2, "tip × 10⁻⁶", scaled(UR5E, 5, 1e-6)),
    plain(3, "base link × 10⁶", scaled(UR5E, 0, 1e6)),
    plain(
        4,
        "massless wrist links",
        scaled(scaled(UR5E, 3, 0.0), 4, 0.0),
    ),
    plain(5, "massless terminal link", scaled(UR5E, 5, 0.0)),
    armature("armature 10⁻⁸", 1e-8),
    armature("armature 10⁻⁶", 1e-6),
    armature("armature 10⁻⁴", 1e-4),
    armature("armature 10⁻²", 1e-2),
    at_states(11, "zigzag ±75°", RODS, &ZIGZAG),
    plain(13, "base 10⁴ m away", moved(UR5E, [1e4, -1e4, 1e4])),
    at_states(15, "1000 rad/s", UR5E, &FAST),
    at_states(16, "remainder of 10⁶ rad", UR5E, &REMAINDERS),
    at_states(17, "k π/2 ± 1 ulp", UR5E, &QUARTERS),
    plain(20, "coincident axes", coincident(UR5E)),
    plain(21, "parallel axes", RODS),
    plain(22, "triangle inequality broken", fat(UR5E)),
    plain(22, "point masses", POINTS),
    at_states(42, "tiny", sized(UR5E, 1.0 / 16.0, 1.0 / 1024.0), &QUICK),
    at_states(42, "giant", sized(UR5E, 16.0, 512.0), &SLOW),
    plain(44, "base turned, gravity not", turned_base(UR5E)),
    plain(45, "tree", TREE),
    plain(45, "tree, numbered otherwise", RENUMBERED),
    payload("payload 0", 0.0),
    payload("payload 0.1 × the arm", 1.77),
    payload("payload 1 × the arm", 17.7),
    payload("payload 10 × the arm", 177.0),
    plain(48, "general rotations", GENERAL),
];

const fn at_states(
    case: u32,
    name: &'static str,
    arm: ArmModel<f64, N>,
    states: &'static [Numbers],
) -> Problem<ArmModel<f64, N>> {
    let extras = Extras::NONE;
    Problem {
        case,
        name,
        arm,
        states,
        extras,
    }
}

const fn plain(case: u32, name: &'static str, arm: ArmModel<f64, N>) -> Problem<ArmModel<f64, N>> {
    at_states(case, name, arm, &COMMON)
}

/// A massless last link whose rotor has inertia.
const fn armature(name: &'static str, inertia: f32) -> Problem<ArmModel<f64, N>> {
    let mut problem = plain(6, name, scaled(UR5E, 5, 0.0));
    problem.extras.rotors[5] = inertia;
    problem
}

const fn payload(name: &'static str, mass: f32) -> Problem<ArmModel<f64, N>> {
    let mut problem = plain(46, name, UR5E);
    problem.extras.payload = mass;
    problem.extras.payload_at = [0.02, -0.01, 0.08];
    let (a, b) = (0.004 * mass, 0.0005 * mass);
    problem.extras.payload_inertia = [a, b, -b, a, b, a];
    problem
}

const fn times(v: DVec3, by: f64) -> DVec3 {
    DVec3::new(v.x * by, v.y * by, v.z * by)
}

/// A link's mass and inertia times a number.
const fn scaled(mut arm: ArmModel<f64, N>, link: usize, by: f64) -> ArmModel<f64, N> {
    arm.links[link] = heavier(arm.links[link], by);
    arm
}

const fn heavier(mut link: Link<f64>, by: f64) -> Link<f64> {
    let inertia = &mut link.inertia;
    inertia.mass *= by;
    inertia.first_moment = times(inertia.first_moment, by);
    let i = inertia.rotational;
    inertia.rotational = DMat3::from_cols(
        times(i.x_axis, by),
        times(i.y_axis, by),
        times(i.z_axis, by),
    );
    link
}

/// All lengths and all masses times a number.
const fn sized(mut arm: ArmModel<f64, N>, length: f64, mass: f64) -> ArmModel<f64, N> {
    let mut k = 0;
    while k < N {
        let mut link = heavier(arm.links[k], mass);
        link.placement.pos = times(link.placement.pos, length);
        link.inertia.first_moment = times(link.inertia.first_moment, length);
        let (i, by) = (link.inertia.rotational, length * length);
        link.inertia.rotational = DMat3::from_cols(
            times(i.x_axis, by),
            times(i.y_axis, by),
            times(i.z_axis, by),
        );
        arm.links[k] = link;
        k += 1;
    }
    arm
}

const fn moved(mut arm: ArmModel<f64, N>, by: [f64; 3]) -> ArmModel<f64, N> {
    let p = arm.links[0].placement.pos;
    arm.links[0].placement.pos = DVec3::new(p.x + by[0], p.y + by[1], p.z + by[2]);
    arm
}

/// A quarter turn about x before the first joint: the arm stands on a wall.
const fn turned_base(mut arm: ArmModel<f64, N>) -> ArmModel<f64, N> {
    arm.links[0].placement.rot = DMat3::from_cols(DVec3::X, DVec3::new(0.0, 0.0, -1.0), DVec3::Y);
    arm
}

/// The last joint on the axis of the one before, of which nothing else hangs.
const fn coincident(arm: ArmModel<f64, N>) -> ArmModel<f64, N> {
    let mut arm = scaled(arm, 4, 0.0);
    arm.links[5].placement.rot = DMat3::IDENTITY;
    arm.links[5].placement.pos = DVec3::new(0.0, 0.0, 0.25);
    arm
}

/// A last link whose largest moment exceeds the sum of the others by [`EXCESS`] of itself.
const fn fat(mut arm: ArmModel<f64, N>) -> ArmModel<f64, N> {
    let inertia = &mut arm.links[5].inertia;
    // The centre of mass is on z.
    let across = inertia.first_moment.z * inertia.first_moment.z / inertia.mass;
    let (x, y) = (inertia.rotational.x_axis.x, inertia.rotational.y_axis.y);
    let z = (x + y - 2.0 * across) / (1.0 - EXCESS);
    inertia.rotational =
        DMat3::from_cols(times(DVec3::X, x), times(DVec3::Y, y), times(DVec3::Z, z));
    arm
}

/// As of one of PUMA 560's links, as published.
pub const EXCESS: f64 = 0.087;

/// Rods of 1 m and 1 kg along x, on parallel axes.
const RODS: ArmModel<f64, N> = {
    let mut bodies = [Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])); N];
    let mut i = 0;
    while i < N {
        let (parent, at) = if i == 0 { (BASE, 0.0) } else { (i - 1, 1.0) };
        bodies[i] = Body::new("rod", parent, Joint::revolute([0.0, 1.0, 0.0]))
            .xyz([at, 0.0, 0.0])
            .mass(1.0)
            .com([0.5, 0.0, 0.0])
            .inertia([0.0, 0.0, 0.0, 1.0 / 12.0, 0.0, 1.0 / 12.0]);
        i += 1;
    }
    Model::new("rods", bodies)
};

/// Point masses away from the axes, which turn by quarters.
const POINTS: ArmModel<f64, N> = {
    let mut bodies = [Body::new("point", BASE, Joint::revolute([0.0, 0.0, 1.0])); N];
    let mut i = 0;
    while i < N {
        let parent = if i == 0 { BASE } else { i - 1 };
        let names = ["first", "second", "third", "fourth", "fifth", "sixth"];
        bodies[i] = Body::new(names[i], parent, Joint::revolute([0.0, 0.0, 1.0]))
            .xyz([0.1, 0.0, 0.2])
            .quarter_turns([1, 0, 0])
            .mass(1.5)
            .com([0.2, 0.1, 0.05]);
        i += 1;
    }
    Model::new("points", bodies)
};

const fn limb(parent: usize, axis: [f64; 3], at: [f64; 3]) -> Body {
    Body::new("limb", parent, Joint::revolute(axis))
        .xyz(at)
        .mass(0.5 + at[0])
        .com([0.05, at[1], -0.1])
        .inertia([0.02, 0.001, -0.002, 0.03, 0.0015, 0.025])
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A trunk with two limbs, one of which forks.
const TREE: ArmModel<f64, N> = Model::new(
    "tree",
    [
        limb(BASE, Z, [0.0, 0.0, 0.3]),
        limb(0, Y, [0.2, 0.1, 0.3]),
        limb(0, X, [-0.2, 0.1, 0.3]),
        limb(1, X, [0.25, 0.0, -0.1]),
        limb(1, Z, [0.15, -0.2, 0.1]),
        limb(4, Y, [0.1, 0.1, 0.2]),
    ],
);

/// The same, its bodies in the order [`RENUMBERING`].
const RENUMBERED: ArmModel<f64, N> = Model::new(
    "tree",
    [
        limb(BASE, Z, [0.0, 0.0, 0.3]),
        limb(0, X, [-0.2, 0.1, 0.3]),
        limb(0, Y, [0.2, 0.1, 0.3]),
        limb(2, Z, [0.15, -0.2, 0.1]),
        limb(3, Y, [0.1, 0.1, 0.2]),
        limb(2, X, [0.25, 0.0, -0.1]),
    ],
);

/// The index of each body of the renumbered tree in the original one.
pub const RENUMBERING: [usize; N] = [0, 2, 1, 4, 5, 3];

/// Axes, placements and inertias without a zero.
const GENERAL: ArmModel<f64, N> = {
    let mut bodies = [Body::new("link", BASE, Joint::revolute(Z)); N];
    let mut i = 0;
    while i < N {
        let (k, parent) = (i as f64, if i == 0 { BASE } else { i - 1 });
        bodies[i] = Body::new("link", parent, Joint::revolute([0.3 - 0.2 * k, 0.5, 0.9]))
            .xyz([0.1 + 0.02 * k, -0.05, 0.2])
            .rpy([0.7 - 0.3 * k, 0.4 + 0.1 * k, -0.9 + 0.5 * k])
            .mass(3.0 - 0.4 * k)
            .com([0.02, 0.05, 0.1])
            .inertia([0.02, 0.001, -0.002, 0.018, 0.0015, 0.012]);
        i += 1;
    }
    Model::new("general", bodies)
};
