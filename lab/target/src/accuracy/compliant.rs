//! Arms with elastic joints: inverse dynamics with the elasticity, or as if the joints were rigid.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::drivetrain::{ElasticJoints, ElasticReference, elastic_inverse_dynamics};
use dynamics_core::effects::{Armature, RIGID_BODY, Viscous};
use dynamics_core::model::Static;
use dynamics_core::state::State;

use super::Inverse;
use super::key::Key;
use super::robots::Swung;

/// The motors' torques through springs.
#[derive(Debug)]
pub struct Compliant<T, const N: usize>(ElasticJoints<f32, N>, PhantomData<T>);

/// The motors' torques if the springs were rigid.
#[derive(Debug)]
pub struct Rigid<T, const N: usize>(ElasticJoints<f32, N>, PhantomData<T>);

inverse! {
    [T: Swung<N>] Compliant<T, N>, Key { trig: "table3x4", model: "compliant", form: "core", ..Key::DEFAULT }, {},
        ElasticReference<f32, N, N> = |course| *course, f32,
        |_| Self(T::joints(), PhantomData), #[inline(never)] |self, course| {
            let motors = elastic_inverse_dynamics(&Static::<T>::NEW, &self.0, course, &RIGID_BODY);
            motors.map_or([f32::NAN; N], |motors| motors.torque)
        };
    [T: Swung<N>] Rigid<T, N>, Key { model: "rigid", ..Key::DEFAULT }, {},
        State<f32, N, N> = |course| course.state, f32,
        |_| Self(T::joints(), PhantomData), #[inline(never)] |self, state| {
            let motors = (RIGID_BODY, Armature(self.0.rotor), Viscous(self.0.friction));
            Engine::<T>::rnea(state, &motors)
        };
}
