//! A firmware with one specialised function, or none: `cargo xtask build-time` times how long the compiler
//! takes for each. `BUILD_TIME_ROBOT`, at compile time, names the robot.
#![no_std]
#![no_main]

use core::f64::consts::FRAC_PI_2;
use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{BASE, Body, Joint, JointLimits, Model, Robot};
use dynamics_core::robots::Panda;
use dynamics_core::state::State;
use firmware_demo::target;

const ROBOT: &[u8] = match option_env!("BUILD_TIME_ROBOT") {
    Some(name) => name.as_bytes(),
    None => b"none",
};

/// A made-up humanoid with its pelvis held: two legs of six joints, a waist of three, two arms of
/// seven; dense inertias, placements in quarter turns and with tilted hips and shoulders, as
/// published ones have them. Not a robot to compute with: a load for the compiler.
struct Humanoid;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// Of the left side, along y mirrored for the right one: the axis, the place on the body before, the mass in
/// kg, the link's own length in m, and a turn about x and y.
type Link = ([f64; 3], [f64; 3], f64, [f64; 3], [f64; 2]);

const LEG: [Link; 6] = [
    (
        Y,
        [0.0, 0.064, -0.103],
        1.35,
        [0.0, 0.05, -0.03],
        [0.0, 0.0],
    ),
    (
        X,
        [0.0, 0.052, -0.030],
        1.52,
        [0.03, 0.0, -0.1],
        [0.0, -0.175],
    ),
    (Z, [0.025, 0.0, -0.124], 1.7, [0.0, 0.02, -0.15], [0.0, 0.0]),
    (
        Y,
        [-0.078, 0.002, -0.177],
        1.93,
        [0.0, 0.0, -0.3],
        [0.0, 0.175],
    ),
    (Y, [0.0, 0.0, -0.3], 0.07, [0.0, 0.0, -0.02], [0.0, 0.0]),
    (X, [0.0, 0.0, -0.018], 0.61, [0.13, 0.0, -0.03], [0.0, 0.0]),
];
const WAIST: [Link; 3] = [
    (Z, [0.0, 0.0, 0.0], 0.24, [0.0, 0.0, 0.03], [0.0, 0.0]),
    (X, [-0.004, 0.0, 0.035], 0.05, [0.0, 0.0, 0.01], [0.0, 0.0]),
    (Y, [0.0, 0.0, 0.019], 9.6, [0.01, 0.0, 0.35], [0.0, 0.0]),
];
const ARM: [Link; 7] = [
    (Y, [0.004, 0.1, 0.248], 0.72, [0.0, 0.04, 0.0], [0.279, 0.0]),
    (
        X,
        [0.0, 0.038, -0.014],
        0.64,
        [0.0, 0.01, -0.09],
        [-0.279, 0.0],
    ),
    (Z, [0.0, 0.006, -0.103], 0.73, [0.01, 0.0, -0.1], [0.0, 0.0]),
    (Y, [0.016, 0.0, -0.081], 0.6, [0.1, 0.0, -0.01], [0.0, 0.0]),
    (X, [0.1, 0.002, -0.01], 0.09, [0.04, 0.0, 0.0], [0.0, 0.0]),
    (Y, [0.038, 0.0, 0.0], 0.48, [0.05, 0.0, 0.0], [0.0, 0.0]),
    (Z, [0.046, 0.0, 0.0], 0.25, [0.09, 0.01, 0.0], [0.0, 0.0]),
];

/// The body of a link; `left` is 1 or -1.
const fn body((axis, at, mass, length, turn): Link, parent: usize, left: f64) -> Body {
    let [x, y, z] = length;
    let axis_inv = mass / 12.0;
    Body::new("link", parent, Joint::revolute(axis))
        .xyz([at[0], at[1] * left, at[2]])
        .rpy([turn[0] * left, turn[1], 0.0])
        .mass(mass)
        .com([0.5 * x + 0.003, 0.5 * y * left - 0.002, 0.5 * z + 0.001])
        .inertia([
            axis_inv * (y * y + z * z + 0.01),
            1e-5 * mass,
            -2e-5 * mass,
            axis_inv * (x * x + z * z + 0.01),
            3e-5 * mass,
            axis_inv * (x * x + y * y + 0.01),
        ])
        .limits(JointLimits {
            lower: -FRAC_PI_2,
            upper: FRAC_PI_2,
            velocity: 20.0,
            torque: 80.0,
        })
}

/// The bodies of a limb from `first` on, the first of them on `parent`.
const fn limb(bodies: &mut [Body; 29], links: &[Link], first: usize, parent: usize, left: f64) {
    let mut i = 0;
    while i < links.len() {
        let parent = if i == 0 { parent } else { first + i - 1 };
        bodies[first + i] = body(links[i], parent, left);
        i += 1;
    }
}

const fn humanoid() -> [Body; 29] {
    let mut bodies = [body(WAIST[0], BASE, 1.0); 29];
    limb(&mut bodies, &LEG, 0, BASE, 1.0);
    limb(&mut bodies, &LEG, 6, BASE, -1.0);
    limb(&mut bodies, &WAIST, 12, BASE, 1.0);
    limb(&mut bodies, &ARM, 15, 14, 1.0);
    limb(&mut bodies, &ARM, 22, 14, -1.0);
    bodies
}

impl Robot<29, 29, 29> for Humanoid {
    const MODEL: Model<f64, 29, 29, 29> = Model::new("humanoid", humanoid());
}

/// One call that the compiler cannot foresee.
fn call<T: Robot<N, N, N>, const N: usize>() {
    let state = black_box(State {
        q: [0.1_f32; N],
        qd: [0.2; N],
        qdd: [0.3; N],
    });
    black_box(Engine::<T>::rnea(&state, &RIGID_BODY));
}

#[entry]
fn main() -> ! {
    if const { matches!(ROBOT, b"panda") } {
        call::<Panda, 7>();
    }
    if const { matches!(ROBOT, b"humanoid") } {
        call::<Humanoid, 29>();
    }
    target::leave(debug::EXIT_SUCCESS)
}
