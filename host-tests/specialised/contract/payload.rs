//! A payload acts on the body that it names, whatever is listed last.

use super::*;
use dynamics_core::algorithms::{crba, frame, rnea};
use dynamics_core::effects::{Effect, Payload, RIGID_BODY, hook};
use dynamics_core::model::{BodyInertia, OnBody};
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::{Core, Engine, MassMatrix};
use glam::DMat3;

fn cup<const BODY: usize>() -> Payload<f64, BODY> {
    Payload::from_inertia(BodyInertia {
        mass: 0.7,
        com: [0.02, -0.05, 0.1],
        inertia: [0.003, 0.0002, 0.0, 0.004, -0.0001, 0.002],
    })
}

fn plate<const BODY: usize>() -> Payload<f64, BODY> {
    Payload::from_inertia(BodyInertia {
        mass: 1.9,
        com: [-0.04, 0.03, 0.2],
        inertia: [0.02, 0.001, 0.002, 0.03, 0.0, 0.025],
    })
}

/// The robot's description with these loads as part of its bodies.
fn carrying(loads: &[(usize, SpatialInertia<f64>)]) -> Model<f64, 6, 3, 3> {
    let mut model = TwoHands::MODEL;
    for &(body, load) in loads {
        let link = &mut model.links[body];
        let frame: DMat3 = link.to_joint_frame;
        let turned = SpatialInertia {
            mass: load.mass,
            first_moment: frame * load.first_moment,
            rotational: frame * load.rotational * frame.transpose(),
        };
        link.inertia = link.inertia + turned;
    }
    model
}

/// Inverse dynamics of core and engine, against the description that has the loads in it.
#[track_caller]
fn acts_as<E: Effect<f64, 6, 3>>(scene: &E, loads: &[(usize, SpatialInertia<f64>)]) {
    let tau = rnea(&carrying(loads), &MOVING, &RIGID_BODY);
    close(&Core::<TwoHands>::rnea(&MOVING, scene), &tau, 2e-15);
    close(&Engine::<TwoHands>::rnea(&MOVING, scene), &tau, 2e-15);
}

// The frame that is listed last carries none.
#[test]
fn each_hand_carries_its_own_payload() {
    let (cup, plate) = (cup::<LEFT>(), plate::<RIGHT>());
    acts_as(&(RIGID_BODY, cup, plate), &[(LEFT, cup.0), (RIGHT, plate.0)]);
    let empty = Core::<TwoHands>::rnea(&MOVING, &RIGID_BODY);
    let laden = Core::<TwoHands>::rnea(&MOVING, &(RIGID_BODY, cup));
    assert!((laden[1] - empty[1]).abs() > 1.0);

    // M and forward dynamics have them too.
    let (scene, loads) = ((RIGID_BODY, cup, plate), [(LEFT, cup.0), (RIGHT, plate.0)]);
    let m = crba(&carrying(&loads), &MOVING.q, &RIGID_BODY);
    let core = Core::<TwoHands>::crba(&MOVING.q, &scene);
    let engine = Engine::<TwoHands>::crba(&MOVING.q, &scene);
    for i in 0..3 {
        let row = |m: &MassMatrix<f64, 3>| [0, 1, 2].map(|j| m.get(i, j));
        close(&row(&core), &row(&m), 2e-15);
        close(&row(&engine), &row(&m), 2e-15);
    }
    let tau = Core::<TwoHands>::rnea(&MOVING, &scene);
    let core = Core::<TwoHands>::aba(&MOVING, &tau, &scene).expect("M is positive");
    let engine = Engine::<TwoHands>::aba(&MOVING, &tau, &scene).expect("M is positive");
    close(&core, &MOVING.qdd, 2e-14);
    close(&engine, &MOVING.qdd, 2e-14);
}

#[test]
fn payloads_of_the_same_body_add_up() {
    let (cup, plate) = (cup::<LEFT>(), plate::<LEFT>());
    acts_as(&(cup, RIGID_BODY, plate), &[(LEFT, cup.0 + plate.0)]);
}

/// Ice of the same kind on every body.
struct Ice(SpatialInertia<f64>);

impl<const V: usize> Effect<f64, 6, V> for Ice {
    const ADDED_INERTIA: hook::Inertia<Self, f64, 6> =
        hook::Inertia::on([true, true, false, true, false, false], |ice, body, inertia| {
            *inertia = *inertia + ice.0;
            inertia.mass += body as f64;
        });
}

#[test]
fn a_users_effect_loads_only_the_bodies_it_names() {
    let ice = cup::<0>().0;
    let mut loads = [(0, ice), (1, ice), (3, ice)];
    for (body, ice) in &mut loads {
        ice.mass += *body as f64;
    }
    acts_as(&(RIGID_BODY, Ice(ice)), &loads);
}

/// The engine's Jacobian of one body, against the core's.
#[track_caller]
fn jacobian<const BODY: usize>() {
    let engine = Engine::<TwoHands>::jacobian(&MOVING.q, OnBody::<BODY>, frame::LocalWorldAligned);
    let core = Core::<TwoHands>::jacobian(&MOVING.q, BODY, frame::LocalWorldAligned);
    let flat = |j: [dynamics_core::spatial::Motion<f64>; 3]| {
        j.map(|s| [s.ang.to_array(), s.lin.to_array()]).as_flattened().as_flattened().to_vec()
    };
    close(&flat(engine), &flat(core), 4e-15);
}

#[test]
fn the_engines_jacobian_is_that_of_any_body() {
    jacobian::<0>();
    jacobian::<LEFT>();
    jacobian::<3>();
    jacobian::<RIGHT>();
    jacobian::<FRAME>();
}

#[test]
#[should_panic(expected = "no body of the robot has the name `middle hand`")]
fn a_name_that_no_body_has_is_refused() {
    TwoHands::MODEL.body("middle hand");
}

#[test]
#[should_panic(expected = "several bodies of the robot have the name `twin`")]
fn a_name_that_several_bodies_have_is_refused() {
    let twin = |parent| Body::new("twin", parent, Joint::fixed());
    Model::<f64, 2, 0, 0>::new("twins", [twin(BASE), twin(0)]).body("twin");
}
