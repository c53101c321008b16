//! A robot of more joints than the engine takes in one function: limbs and branches apart.
#![cfg(feature = "full")]

use dynamics_core::effects::{Coriolis, Gravity, Inertia, MovingBase, WorldWrench};
use dynamics_core::model::{BASE, Body, Joint, Model, Robot};
use dynamics_core::spatial::{Force, Motion};
use glam::DVec3;

use super::{Aslant, Drag, Push, ULPS, compare, payload};

/// A trunk of two joints that three arms branch off, one of them sliding, and a second root: 18
/// joints.
struct Large;

const fn link(parent: usize, joint: Joint<f64>, turn: f64) -> Body {
    Body::new("link", parent, joint)
        .xyz([0.05, -0.02, 0.2])
        .rpy([turn, 0.0, -0.5 * turn])
        .mass(1.2)
        .com([0.02, 0.03, 0.1])
        .inertia([0.02, 0.001, -0.002, 0.03, 0.003, 0.015])
}

/// `count` bodies from `first` on, on `parent`.
const fn chain(bodies: &mut [Body; 18], first: usize, count: usize, parent: usize) {
    const AXES: [[f64; 3]; 3] = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let mut i = 0;
    while i < count {
        let on = if i == 0 { parent } else { first + i - 1 };
        let turn = if i % 2 == 0 { 0.4 } else { 0.0 };
        let joint = if first + i == 8 {
            Joint::prismatic([0.0, 0.3, 1.0])
        } else {
            Joint::revolute(AXES[i % 3])
        };
        bodies[first + i] = link(on, joint, turn);
        i += 1;
    }
}

const fn bodies() -> [Body; 18] {
    let mut bodies = [link(BASE, Joint::fixed(), 0.0); 18];
    chain(&mut bodies, 0, 2, BASE);
    chain(&mut bodies, 2, 4, 1);
    chain(&mut bodies, 6, 4, 1);
    chain(&mut bodies, 10, 3, 1);
    chain(&mut bodies, 13, 5, BASE);
    bodies
}

impl Robot<18, 18, 18> for Large {
    const MODEL: Model<f64, 18, 18, 18> = Model::new("large", bodies());
}

#[test]
fn engine_equals_core_on_a_large_tree_under_every_effect() {
    let carried = MovingBase::<f64> {
        velocity: Motion::new(DVec3::new(0.5, -0.3, 0.8), DVec3::new(0.2, 0.4, -0.6)),
        acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.7), DVec3::new(1.5, -2.0, 0.9)),
    };
    let wind = WorldWrench {
        body: 12,
        wrench: Force::<f64>::new(DVec3::new(1.0, 2.0, -3.0), DVec3::new(5.0, -4.0, 2.0)),
    };
    let scene = (
        Gravity::<Aslant>::new(9.81),
        Inertia,
        Coriolis,
        carried,
        Push,
        Drag,
        wind,
        payload::<f64, 17>(),
    );
    let worst = compare::<f64, Large, _, 18, 18>(&scene);
    assert!(worst <= ULPS, "{worst:.2} ulp");
}
