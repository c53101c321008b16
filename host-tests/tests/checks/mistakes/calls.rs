//! Impossible scenes written in the call itself: the compiler finds them where it compiles the algorithm for them.

use dynamics_core::algorithms;
use dynamics_core::effects::*;
use dynamics_core::model::{ArmModel, Calibrated};
use dynamics_core::robots::{Iiwa14, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

pub fn engine(at: &State<f32, 6, 6>) {
    let _ = Engine::<Ur5e>::rnea(at, &(RIGID_BODY, Gravity::MOON)); //~ several fields of gravity
    let _ = Engine::<Ur5e>::crba(&at.q, &(Armature([0.1_f32; 6]), Armature([0.1_f32; 6]))); //~ contains Armature twice
    let _ = Engine::<Ur5e>::aba(at, &[0.0; 6], &(RIGID_BODY, Inertia)); //~ contains Inertia twice
    let _ = Engine::<Ur5e>::forward_dynamics(at, &[0.0; 6], &(RIGID_BODY, Coriolis)); //~ contains Coriolis twice
    let _ = Engine::<Ur5e>::momentum_and_drift(at, &(Payload::<f32, 9>::default(), RIGID_BODY)); //~ a payload is on body 9 of a robot of 6 bodies
}

pub fn core(at: &State<f32, 6, 6>, model: &ArmModel<f32, 6>) {
    let _ = Core::<Ur5e>::rnea(at, &(Viscous([0.1_f32; 6]), Viscous([0.2_f32; 6]))); //~ contains Viscous twice
    let _ = Core::<Ur5e>::crba(&at.q, &(RIGID_BODY, Payload::<f32, 7>::default())); //~ a payload is on body 7 of a robot of 6 bodies
    let _ = algorithms::rnea(model, at, &(RIGID_BODY, Payload::<f32, 8>::default())); //~ a payload is on body 8 of a robot of 6 bodies
}

pub fn base_parameters(at: &State<f64, 7, 7>, other: Calibrated<Iiwa14, f64, 7, 7, 7>) {
    let Ok(base) = Engine::<Iiwa14>::base_parameters(&other, &()) else { return };
    let _ = Engine::<Panda>::rnea(at, &(RIGID_BODY, base)); //~ the base parameters are those of another robot
    let _ = Core::<Iiwa14>::rnea(at, &(RIGID_BODY, base)); //~ base parameters are the engine's
}

/// The hook is forgotten.
pub struct Drag;
impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {}

pub fn forgotten(at: &State<f32, 6, 6>) {
    Effect::<f32, 6, 6>::torque(&Drag, 0, JointState::new(0.0, 0.0), &mut 0.0); //~ this effect has neither a hook among the constants of `Effect` nor the function `torque`
    let _ = Core::<Ur5e>::rnea(at, &Drag);
}
