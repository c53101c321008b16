//! Input at the edges: what is out of range, missing or contradictory is taken as the documentation says, or refused.

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Arm, BASE, Body, Joint, Model, Robot};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// A turn, a slide, a turn.
struct Quill;

impl Robot<3, 3, 3> for Quill {
    const MODEL: Arm<f64, 3> = Model::new(
        "quill",
        [
            link("arm", BASE, Joint::revolute([0.3, 0.2, 0.9])),
            link("slide", 0, Joint::prismatic([0.6, 0.0, 0.8])),
            link("tip", 1, Joint::revolute(Y)),
        ],
    );
}

const fn link(name: &'static str, parent: usize, joint: Joint<f64>) -> Body {
    Body::new(name, parent, joint)
        .xyz([0.3, -0.1, 0.2])
        .rpy([0.2, -0.4, 0.5])
        .mass(1.5)
        .com([0.1, 0.05, -0.2])
        .inertia([0.05, 0.004, 0.0, 0.06, 0.0, 0.04])
}

/// Whether the numbers are the same but for rounding.
fn same(a: [f64; 3], b: [f64; 3]) -> bool {
    std::iter::zip(a, b).all(|(a, b)| (a - b).abs() < 1e-12)
}

#[test]
fn slides_come_from_the_posture_in_core_and_engine_alike() {
    let there = State {
        qd: [0.5, -0.7, 0.9],
        qdd: [1.0, -2.0, 3.0],
        ..State::at([0.3_f64, 0.5, 0.7])
    };
    let elsewhere = State {
        q: [0.0; 3],
        ..there
    };
    let posture = Engine::<Quill>::posture(&there.q);
    let tau = Core::<Quill>::rnea(&there, &RIGID_BODY);
    assert!(same(
        Core::<Quill>::rnea_at(&posture, &elsewhere, &RIGID_BODY),
        tau
    ));
    assert!(same(
        Engine::<Quill>::rnea_at(&posture, &elsewhere, &RIGID_BODY),
        tau
    ));
    let forward = Engine::<Quill>::forward_at(&posture, &elsewhere, &tau, &RIGID_BODY).unwrap();
    let articulated = Engine::<Quill>::aba_at(&posture, &elsewhere, &tau, &RIGID_BODY).unwrap();
    assert!(same(forward, there.qdd) && same(articulated, there.qdd));
}

/// A turn with as many bodies welded to it as a cable tray has brackets.
struct Tray;

impl Robot<40, 1, 1> for Tray {
    const MODEL: Model<f64, 40, 1, 1> = {
        let mut bodies = [link("bracket", 0, Joint::fixed()); 40];
        bodies[0] = link("tray", BASE, Joint::revolute(Y));
        Model::new("tray", bodies)
    };
}

#[test]
fn any_number_of_bodies_may_move_with_one_joint_where_no_wrench_acts() {
    let state = State { qd: [0.5], qdd: [1.0], ..State::at([0.3_f64]) };
    let [engine] = Engine::<Tray>::rnea(&state, &RIGID_BODY);
    let [core] = Core::<Tray>::rnea(&state, &RIGID_BODY);
    assert!((engine - core).abs() < 1e-12 * core.abs());
}
