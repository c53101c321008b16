//! A calibrated model: identified masses and inertias, from flash, in place of those of the data
//! sheet.
//!
//! `cargo run -p dynamics-core --example calibrated_model`

use dynamics_core::Core;
use dynamics_core::algorithms::rnea;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{BodyInertia, Calibrated, ModelError, Problem, Robot};
use dynamics_core::{robots::Ur5e, state::State};

const UPPER_ARM: usize = Ur5e::MODEL.body("upper_arm");

/// The arm with identified inertias, in the frames of the description (those of a URDF); built
/// once, at start.
///
/// The feature `serde` reads `BodyInertia` from flash.
fn calibrated(upper_arm: BodyInertia<f32>) -> Result<Calibrated<Ur5e, f32, 6, 6, 6>, ModelError> {
    let mut arm = Calibrated::nominal();
    // The moments of inertia may violate the triangle inequality by the rounding of f32.
    arm.set_inertia(UPPER_ARM, upper_arm, 1e-6)?;
    Ok(arm)
}

fn main() -> Result<(), ModelError> {
    let nominal = Calibrated::<Ur5e, f32, 6, 6, 6>::nominal();
    let described = nominal.inertia(UPPER_ARM).expect("a body of the robot");
    let state = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);

    println!("added to the upper arm, kg | shoulder, N·m");
    let mut last = 0.0;
    for added in [0.0, 0.2, 0.4] {
        let mass = described.mass + added;
        let arm = calibrated(BodyInertia { mass, ..described })?;
        // In every tick: the textbook algorithm. The engine's numbers are constants of the machine
        // code.
        let tau = rnea(&arm, &state, &RIGID_BODY);
        println!("{added:26.1} | {:8.3}", tau[1]);
        assert!(tau[1].abs() > last);
        last = tau[1].abs();
        let plain = Core::<Ur5e>::rnea(&state, &RIGID_BODY);
        assert!(added > 0.0 || (tau[1] - plain[1]).abs() < 1e-4);
    }

    // An inertia that is not physical is rejected, and the error names the body.
    let damaged = BodyInertia { mass: f32::NAN, ..described };
    let error = calibrated(damaged).expect_err("no mass");
    println!("{error}");
    assert_eq!(error.body, "upper_arm");
    assert!(matches!(error.problem, Problem::Mass(_) | Problem::NotFinite));
    Ok(())
}
