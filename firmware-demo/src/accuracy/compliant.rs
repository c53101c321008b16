//! Arms with elastic joints: inverse dynamics with the elasticity, or as if the joints were rigid.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::drivetrain::{ElasticJoints, ElasticReference, elastic_inverse_dynamics};
use dynamics_core::effects::{Armature, RIGID_BODY, Viscous};
use dynamics_core::model::{Robot, Static};
use dynamics_core::state::State;

use super::Inverse;
use super::key::Key;
use super::robots::Swung;

macro_rules! motors {
    ($($(#[$doc:meta])* $way:ident, trig: $trig:literal, model: $model:literal, form: $form:literal,
       |$course:ident| $input:ty = $given:expr, |$joints:ident, $now:ident| $tick:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $way<T, const N: usize>(ElasticJoints<f32, N>, PhantomData<T>);

        impl<T: Robot<N, N, N> + Swung<N>, const N: usize> Inverse<N> for $way<T, N> {
            const KEY: Key = Key { trig: $trig, model: $model, form: $form, ..Key::DEFAULT };
            type Input = $input;
            type Scalar = f32;

            fn start(_: &State<f32, N, N>) -> Self {
                Self(T::joints(), PhantomData)
            }
            fn input($course: &ElasticReference<f32, N, N>) -> $input {
                $given
            }
            #[inline(never)]
            fn tick(&mut self, $now: &$input) -> [f32; N] {
                let $joints = &self.0;
                $tick
            }
        }
    )*};
}
motors! {
    /// The motors' torques through springs.
    Compliant, trig: "table3x4", model: "compliant", form: "core", |course| ElasticReference<f32, N, N> = *course,
        |joints, course| elastic_inverse_dynamics(&Static::<T>::NEW, joints, course, &RIGID_BODY).map_or([f32::NAN; N], |motors| motors.torque);
    /// The motors' torques if the springs were rigid.
    Rigid, trig: "table3", model: "rigid", form: "engine", |course| State<f32, N, N> = course.state,
        |joints, state| Engine::<T>::rnea(state, &(RIGID_BODY, Armature(joints.rotor), Viscous(joints.friction)));
}
