//! Operational space: press a tool down with 20 N while its horizontal position is held.
//!
//! `cargo run -p motion-control --example operational_space`

use dynamics_core::algorithms::{
    Conditioning, Damping, NotPositiveDefinite, frame, operational_space,
};
use dynamics_core::effects::{Coriolis, Gravity, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::{Core, robots::Ur5e, state::State};
use motion_control::law::{TaskCommand, TaskFrame, hybrid_motion_force};

const HAND: usize = 5; // the last of the UR5e's six bodies

/// The torques of a tick: motion along x and y, a force along z, and the joints' remaining motion
/// damped, N·m.
fn control(arm: &State<f32, 6, 6>) -> Result<[f32; 6], NotPositiveDefinite> {
    let directions = TaskFrame::BASE.place(); // x, y and z of the hand's origin, in the base's axes
    // Near a singular configuration the inertia of the task is damped; it is finite in every
    // configuration.
    let damping = Damping::relative(1e-3);
    let (arm_model, hand) = (&Ur5e::MODEL_F32, (HAND, frame::LocalWorldAligned));
    let task = operational_space(arm_model, &arm.q, hand, &directions, &RIGID_BODY, damping)?;
    assert_eq!(task.conditioning, Conditioning::Regular);

    let still = TaskCommand::Motion { acceleration: 0.0 };
    let press = TaskCommand::Force { force: -20.0, acceleration: 0.0 };
    let drift = Core::<Ur5e>::bias_acceleration(arm, HAND, frame::LocalWorldAligned); // J̇ q̇
    let drift = directions.map(|direction| drift.dot(direction));
    let bias = Core::<Ur5e>::rnea(arm, &(Gravity::EARTH, Coriolis));
    let mut tau = hybrid_motion_force(&task, &[still, still, press], &drift, &bias);

    // Damping of the joints that does not disturb the task.
    let rest = task.null_space_torque(&arm.qd.map(|qd| -2.0 * qd));
    for (tau, rest) in tau.iter_mut().zip(rest) {
        *tau += rest;
    }
    Ok(tau)
}

fn main() -> Result<(), NotPositiveDefinite> {
    println!("elbow, rad | torques for 20 N downwards, N·m");
    for elbow in [0.9_f32, 1.2, 1.5, 1.8] {
        let arm = State::at([0.0, -1.2, elbow, 0.3, 0.7, 0.0]);
        let tau = control(&arm)?;
        println!("{elbow:10.1} | {tau:7.2?}");

        // Without gravity's share, the torques push with 20 N downwards: τ = g + Jᵀ F.
        let gravity = Core::<Ur5e>::rnea(&arm, &Gravity::EARTH);
        let jacobian = Core::<Ur5e>::jacobian(&arm.q, HAND, frame::LocalWorldAligned);
        for (joint, column) in jacobian.iter().enumerate() {
            assert!((tau[joint] - gravity[joint] + 20.0 * column.lin.z).abs() < 1e-3);
        }
    }
    Ok(())
}
