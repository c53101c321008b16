//! Input at the edges: values out of range, missing or contradictory are treated as documented, or
//! refused.

use dynamics_core::algorithms::{crba_jacobian, jacobian, rnea};
use dynamics_core::effects::{
    BodyWrench, Contact, ContactPoint, Effect, Gravity, MovingBase, RIGID_BODY, Width, WorldWrench,
};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use glam::{DMat3, DVec3};

const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// A turn, a slide, a turn.
struct Quill;

impl Robot<3, 3, 3> for Quill {
    const MODEL: ArmModel<f64, 3> = Model::new(
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
    let there =
        State { qd: [0.5, -0.7, 0.9], qdd: [1.0, -2.0, 3.0], ..State::at([0.3_f64, 0.5, 0.7]) };
    let elsewhere = State { q: [0.0; 3], ..there };
    let trig = Engine::<Quill>::joint_trig(&there.q);
    let tau = Core::<Quill>::rnea(&there, &RIGID_BODY);
    assert!(same(Core::<Quill>::rnea(trig.with(&elsewhere), &RIGID_BODY), tau));
    assert!(same(Engine::<Quill>::rnea(trig.with(&elsewhere), &RIGID_BODY), tau));
    let forward =
        Engine::<Quill>::forward_dynamics(trig.with(&elsewhere), &tau, &RIGID_BODY).unwrap();
    let articulated = Engine::<Quill>::aba(trig.with(&elsewhere), &tau, &RIGID_BODY).unwrap();
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

// No wrench acts on them.
#[test]
fn many_bodies_may_move_with_one_joint() {
    let state = State { qd: [0.5], qdd: [1.0], ..State::at([0.3_f64]) };
    let [engine] = Engine::<Tray>::rnea(&state, &RIGID_BODY);
    let [core] = Core::<Tray>::rnea(&state, &RIGID_BODY);
    assert!((engine - core).abs() < 1e-12 * core.abs());
}

/// A tip pressed into a floor of some friction.
fn floor(body: usize) -> Contact<f64, 1> {
    let point = DVec3::new(0.1, 0.2, -0.3);
    Contact {
        points: [ContactPoint { body, point }],
        normal: DVec3::Z,
        height: 3.0,
        stiffness: 1e3,
        damping: 30.0,
        damping_depth: Width::f64(1e-3),
        friction: 0.8,
        slip_tolerance: 1e-3,
    }
}

#[test]
fn contact_friction_is_relative_to_the_moving_base() {
    let state = State::at([0.3_f64, 0.5, 0.7]);
    let still = Core::<Quill>::rnea(&state, &(Gravity::EARTH, floor(2)));
    let weight = Core::<Quill>::rnea(&state, &Gravity::EARTH);
    assert!(
        std::iter::zip(still, weight).all(|(a, b)| (a - b).abs() > 1.0),
        "{still:?} {weight:?}"
    );
    // Friction alone: a turning base would add centrifugal forces with `Coriolis`, which is not in
    // the scene.
    let velocity = Motion::new(DVec3::new(0.3, -0.2, 0.5), DVec3::new(5.0, 1.0, -2.0));
    let base = MovingBase { velocity, acceleration: Motion::ZERO };
    let scene = (Gravity::EARTH, floor(2), base);
    let near = |tau: [f64; 3]| std::iter::zip(tau, still).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(near(Core::<Quill>::rnea(&state, &scene)));
    assert!(near(Engine::<Quill>::rnea(&state, &scene)));
}

// So does a wrench on the base.
#[test]
fn a_wrench_on_a_missing_body_gives_nan() {
    fn torques<E: Effect<f64, 3, 3>>(scene: E) -> [f64; 6] {
        let state = State::at([0.3_f64, 0.5, 0.7]);
        let [a, b, c] = Core::<Quill>::rnea(&state, &scene);
        let [d, e, f] = Engine::<Quill>::rnea(&state, &scene);
        [a, b, c, d, e, f]
    }
    let wrench = Force::new(DVec3::X, DVec3::Y);
    for body in [3, 17, BASE] {
        for tau in [
            torques((Gravity::EARTH, BodyWrench { body, wrench })),
            torques((Gravity::EARTH, WorldWrench { body, wrench })),
            torques((Gravity::EARTH, floor(body))),
        ] {
            assert!(tau.iter().all(|x| x.is_nan()), "{tau:?}");
        }
    }
}

#[test]
fn the_jacobian_of_a_missing_body_is_nan() {
    use dynamics_core::algorithms::frame::LocalWorldAligned;
    let q = [0.3, 0.5, 0.7];
    for body in [3, 17] {
        let (_, by_crba) = crba_jacobian(&Quill::MODEL, &q, body, &RIGID_BODY);
        for column in jacobian(&Quill::MODEL, &q, body, LocalWorldAligned).iter().chain(&by_crba) {
            assert!(column.ang.is_nan() && column.lin.is_nan());
        }
    }
    assert_eq!(jacobian(&Quill::MODEL, &q, BASE, LocalWorldAligned), [Motion::ZERO; 3]);
}

#[test]
fn a_quaternion_of_any_length_is_an_attitude() {
    let ball: Model<f64, 1, 4, 3> = Model::new("ball", [link("ball", BASE, Joint::spherical())]);
    let unit = [0.1, -0.5, 0.7, 0.5];
    let weight = |q: [f64; 4]| rnea(&ball, &State::at(q), &Gravity::EARTH);
    let want = weight(unit);
    for length in [3.0, 1e-3, 0.9, 1.2, 1e6] {
        let found = weight(unit.map(|x| x * length));
        let off = std::iter::zip(found, want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-13, "{length}: {off:.1e}");
    }
    // Zero has no direction: no turn, as documented.
    assert_eq!(weight([0.0; 4]), weight([0.0, 0.0, 0.0, 1.0]));
    assert!(weight([f64::NAN, 0.0, 0.0, 1.0]).iter().any(|x| x.is_nan()));
}

#[test]
fn the_axes_of_a_universal_joint_are_made_orthogonal() {
    let joint = Joint::universal([1.0, 0.0, 9e-10], [0.0, 0.0, 1.0]);
    let cross: Model<f64, 1, 2, 2> = Model::new("cross", [link("cross", BASE, joint)]);
    let r: DMat3 = cross.links[0].to_joint_frame;
    assert!((r.transpose() * r).abs_diff_eq(DMat3::IDENTITY, 1e-15));
}

// The error does not blame the inertia of a joint alone.
#[test]
fn a_nan_configuration_is_reported_as_not_a_number() {
    let state = State::at([0.3, f64::NAN, 0.7]);
    let error = Core::<Quill>::forward_dynamics(&state, &[0.0; 3], &RIGID_BODY).unwrap_err();
    assert!(error.to_string().contains("is not a number"), "{error}");
}
