//! A user-defined robot: from a data sheet or a URDF to a `const` that the compiler checks.
//!
//! `cargo run -p dynamics-core --example own_robot`

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::{Core, Engine, state::State};

/// A lifting column, and a shoulder and an elbow with vertical axes, as in a SCARA.
///
/// The numbers of `Robot<3, 3, 3>`: bodies, position coordinates and velocity coordinates. The last
/// two differ only for robots with spherical or free joints, whose attitude is a quaternion.
struct Scara;
impl Robot<3, 3, 3> for Scara {
    const MODEL: ArmModel<f64, 3> = Model::new("scara", [COLUMN, UPPER_ARM, FOREARM]);
}
const _: ArmModel<f64, 3> = Scara::MODEL; // `cargo check` now reports a description that is wrong

const Z: [f64; 3] = [0.0, 0.0, 1.0];
const COLUMN: Body = Body::new("column", BASE, Joint::prismatic(Z)).mass(4.0);
/// The parent is body 0: every body is listed after its parent.
const UPPER_ARM: Body = Body::new("upper arm", 0, Joint::revolute(Z))
    .xyz([0.0, 0.0, 0.4]) // where the joint is, in the frame of the body before, m
    .mass(2.0)
    .com([0.12, 0.0, 0.0]) // in the body's own frame
    .inertia([0.002, 0.0, 0.0, 0.012, 0.0, 0.012]); // xx xy xz yy yz zz about the centre of mass
/// Mounted upside down, half a turn about x. A URDF writes 3.14159, whose sine is not zero: quarter
/// turns give exact zeros, whose products the engine omits.
const FOREARM: Body = Body::new("forearm", 1, Joint::revolute(Z))
    .xyz([0.25, 0.0, 0.0])
    .quarter_turns([2, 0, 0])
    .mass(1.2)
    .com([0.1, 0.0, 0.05])
    .inertia([0.001, 0.0, 0.0, 0.006, 0.0, 0.006]);

fn main() {
    // Checks that the moments of inertia of the data sheet are physical, within 0.1 %.
    Scara::MODEL.check(1e-3).expect("possible inertias");

    println!("              q̈ | column, N; shoulder, elbow, N·m");
    for joint in 0..3 {
        let mut state = State::at([0.1_f32, 0.4, 0.6]);
        state.qdd[joint] = 1.0;
        let tau = Engine::<Scara>::rnea(&state, &RIGID_BODY);
        println!("{:?} | {tau:8.4?}", state.qdd);

        // The column lifts all bodies: 7.2 kg.
        assert!((tau[0] - 7.2 * (9.81 + state.qdd[0])).abs() < 1e-4);
        // The textbook algorithm in f64 agrees.
        let qdd = state.qdd.map(f64::from);
        let exact = Core::<Scara>::rnea(&State { qdd, ..State::at([0.1, 0.4, 0.6]) }, &RIGID_BODY);
        for (tau, exact) in tau.iter().zip(exact) {
            assert!((f64::from(*tau) - exact).abs() < 1e-4);
        }
    }
}
