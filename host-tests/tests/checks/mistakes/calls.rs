//! Impossible scenes written in the call itself: the compiler finds them where it compiles the
//! algorithm for them.

use dynamics_core::algorithms;
use dynamics_core::effects::*;
use dynamics_core::flexible::{Beam, Bending, BendingRobot, FlexibleLink, Modes, Shape};
use dynamics_core::model::{ArmModel, BASE, Body, Calibrated, Joint, Model, Robot};
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

const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]);
const fn rod(joint: Joint<f64>) -> Body {
    Body::new("rod", BASE, joint).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia())
}
const ROD: Body = rod(Joint::revolute([0.0, 1.0, 0.0]));
const fn bends(body: usize) -> FlexibleLink {
    match BEAM.link(body, &[Shape::BendZ(1)]) { Ok(link) => link, Err(_) => panic!() }
}

pub struct Comb;
impl Robot<64, 64, 64> for Comb {
    const MODEL: ArmModel<f64, 64> = Model::new("comb", [ROD; 64]);
}
impl BendingRobot<64, 64, 64, 1> for Comb {
    const MODES: Modes<f64, 1> = Modes::new(&Self::MODEL, &[bends(0)]);
}

pub struct Mast;
impl Robot<2, 1, 1> for Mast {
    const MODEL: Model<f64, 2, 1, 1> = Model::new("mast", [ROD, rod(Joint::fixed())]);
}
impl BendingRobot<2, 1, 1, 1> for Mast {
    const MODES: Modes<f64, 1> = Modes::new(&Self::MODEL, &[bends(1)]);
}

pub fn bent(comb: &State<f32, 64, 64>, mast: &State<f32, 1, 1>) {
    let _ = Bending::<Engine<Comb>>::rnea(comb, mast, &RIGID_BODY); //~ robot `comb`: the engine takes up to 64 joints and modes; use `Core`
    let _ = Bending::<Engine<Mast>>::rnea(mast, mast, &RIGID_BODY); //~ robot `mast`, body `rod`: a body on a fixed joint bends, which the engine does not take beside modes
    let _ = Bending::<Core<Mast>>::rnea(mast, mast, &RIGID_BODY);
}

/// The hook is forgotten.
pub struct Drag;
impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {}

pub fn forgotten(at: &State<f32, 6, 6>) {
    Effect::<f32, 6, 6>::torque(&Drag, 0, JointState::new(0.0, 0.0), &mut 0.0); //~ this effect has neither a hook among the constants of `Effect` nor the function `torque`
    let _ = Core::<Ur5e>::rnea(at, &Drag);
}

type Gears = LoadFriction<f64, 6>;
type Rotors = GyroscopicRotors<f64, 6>;
pub fn derivatives(at: &State<f64, 6, 6>, gears: Gears, rotors: Rotors) {
    let _ = algorithms::rnea_derivatives(&Ur5e::MODEL, at, &(RIGID_BODY, Drag)); //~ an effect of the scene has no derivatives
    let _ = algorithms::rnea_derivatives(&Ur5e::MODEL, at, &(RIGID_BODY, gears)); //~ the derivatives of rotors that spin as bodies
    let _ = algorithms::rnea_derivatives(&Ur5e::MODEL, at, &(RIGID_BODY, Frozen(rotors))); //~ the derivatives of rotors that spin as bodies
    let _ = Engine::<Ur5e>::rnea_derivatives(at, &(RIGID_BODY, Frozen(gears))); //~ the derivatives of rotors that spin as bodies
    let _ = algorithms::rnea_along(&Ur5e::MODEL, at, &[0.0; 6], &[0.0; 6], &(RIGID_BODY, Elasticity)); //~ the derivatives of rotors that spin as bodies
    let _ = algorithms::rnea_transposed(&Ur5e::MODEL, at, &[0.0; 6], &(RIGID_BODY, Frozen(Elasticity))); //~ the derivatives of rotors that spin as bodies
}
