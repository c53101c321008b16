//! A payload that is known only at run time: the load of a gripper, on the body that the type
//! names.
//!
//! `cargo run -p dynamics-core --example payload`

use dynamics_core::effects::{InvalidPayload, Payload, RIGID_BODY};
use dynamics_core::model::{BodyInertia, Problem, Robot};
use dynamics_core::{Engine, robots::Ur5e, state::State};

/// Its mass, centre of mass and inertia are in the wrist's frame. A name that no body has does not
/// compile.
type OnWrist = Payload<f32, { Ur5e::MODEL.body("wrist_3") }>;

fn main() -> Result<(), InvalidPayload> {
    // Numbers from outside are checked: if they are not physical, the error names the body.
    let load = |mass| {
        let (com, inertia) = ([0.0, 0.0, 0.1], [0.0; 6]);
        OnWrist::try_new(BodyInertia { mass, com, inertia }, 1e-6)
    };
    let problem = |mass| load(mass).map_err(|error| error.problem);
    assert_eq!(problem(-1.0), Err(Problem::Mass(-1.0)));
    assert_eq!(problem(f32::NAN), Err(Problem::NotFinite));

    // The gripper is always present, and the load is added to it; a load without mass has no
    // effect.
    let gripper = OnWrist::from_inertia(BodyInertia {
        mass: 0.9,
        com: [0.0, 0.0, 0.06],
        inertia: [1e-3, 0.0, 0.0, 1e-3, 0.0, 5e-4],
    });
    let arm = State { qdd: [0.5; 6], ..State::at([0.0_f32, -0.8, 0.9, 0.1, 0.2, 0.3]) };
    let bare = Engine::<Ur5e>::rnea(&arm, &(RIGID_BODY, gripper));
    println!("load, kg | shoulder  elbow, N·m");
    let mut last = bare[1];
    for mass in [0.0, 0.5, 2.0, 5.0] {
        let tau = Engine::<Ur5e>::rnea(&arm, &(RIGID_BODY, gripper, load(mass)?));
        println!("{mass:8.1} | {:8.2} {:6.2}", tau[1], tau[2]);
        assert!(mass > 0.0 || (tau[1] - bare[1]).abs() < 1e-4);
        assert!(mass == 0.0 || tau[1].abs() > last.abs() + 1.0);
        last = tau[1];
    }
    Ok(())
}
