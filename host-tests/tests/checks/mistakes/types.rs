//! Sizes, scalars and traits that do not fit.

use dynamics_core::effects::{Effect, JointState, RIGID_BODY, Viscous};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::scalar::Real;
use dynamics_core::{Core, Engine, robots::Ur5e, state::State};

pub struct TwoBodies;
impl Robot<2, 2, 2> for TwoBodies {
    const MODEL: ArmModel<f64, 2> = Model::new(
        "two",
        [Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0]))], //~ expected an array with a size of 2
    );
}

pub struct OtherSize;
impl Robot<2, 2, 2> for OtherSize {
    const MODEL: ArmModel<f64, 3> = Model::new( //~ expected `2`, found `3`
        "three",
        [Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])); 3],
    );
}

pub struct Nobody;
pub struct NoEffect;
pub struct WrongHook;
impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for WrongHook {
    fn torque(&self, _: usize, _: JointState<R>, _: R) {} //~ method `torque` has an incompatible type for trait
}

pub fn calls(at: &State<f32, 6, 6>, short: &State<f32, 5, 5>, model: &ArmModel<f32, 6>) {
    let _ = Engine::<Ur5e>::rnea(short, &RIGID_BODY); //~ `&State<f32, 5, 5>` is not a state of 6 positions and 6 velocities in `_`
    let _ = Engine::<Ur5e>::rnea(at, &(RIGID_BODY, Viscous([0.5_f32; 5]))); //~ is not an effect on a robot of 6 bodies and 6 joints in `f32`
    let _ = Engine::<Ur5e>::rnea(at, &(RIGID_BODY, NoEffect)); //~ `NoEffect` is not an effect on a robot of 6 bodies and 6 joints in `f32`
    let _ = Engine::<Ur5e>::rnea(at, &(RIGID_BODY, Viscous([0.5_f64; 6]))); //~ is not an effect on a robot of 6 bodies and 6 joints in `f32`
    let _: [f64; 6] = Engine::<Ur5e>::rnea(at, &RIGID_BODY); //~ expected `f64`, found `f32`
    let _ = Engine::<Nobody>::rnea(at, &RIGID_BODY); //~ or write that from a URDF or MJCF: `cargo xtask import robot.urdf --out robot.rs`
    let _ = Core::<Nobody>::rnea(at, &RIGID_BODY); //~ describe it by `impl Robot<B, Q, V> for Nobody`
    let _ = Engine::<Ur5e>::rnea(model, at); //~ `algorithms::rnea(&model, &state, &effects)`
    let _ = Engine::<Ur5e>::rnea(model, at); //~ is not an effect on a robot of 6 bodies and 6 joints in `_`
}
