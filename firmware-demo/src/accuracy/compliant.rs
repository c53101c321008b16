//! Arms whose joints give way: told so, or taken for rigid.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::drivetrain::{ElasticJoints, ElasticReference, elastic_inverse_dynamics};
use dynamics_core::effects::{Armature, RIGID_BODY, Viscous};
use dynamics_core::model::{Robot, Static};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

use super::Inverse;
use super::key::Key;

/// An arm's joints.
pub trait Joints<const N: usize> {
    /// Stiffness, N·m/rad, reflected inertia of the rotor, kg·m², and friction, N·m·s/rad.
    const JOINTS: [[f64; N]; 3];

    /// The same in a scalar.
    fn joints<R: Real>() -> ElasticJoints<R, N> {
        let [stiffness, rotor, friction] = Self::JOINTS.map(|numbers| numbers.map(R::from_f64));
        ElasticJoints {
            stiffness,
            rotor,
            friction,
        }
    }
}

/// The motors' torques through springs.
#[derive(Debug)]
pub struct Compliant<T, const N: usize>(ElasticJoints<f32, N>, PhantomData<T>);

/// The motors' torques if the springs were rigid.
#[derive(Debug)]
pub struct Rigid<T, const N: usize>(Armature<f32, N>, Viscous<f32, N>, PhantomData<T>);

impl<T: Robot<N, N, N> + Joints<N>, const N: usize> Inverse<N> for Compliant<T, N> {
    const KEY: Key = Key {
        trig: "table3x4",
        model: "compliant",
        form: "core",
        ..Key::DEFAULT
    };
    type Input = ElasticReference<f32, N, N>;
    type Output = [f32; N];

    fn start(_: &State<f32, N, N>) -> Self {
        Self(T::joints(), PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        *course
    }
    #[inline(never)]
    fn tick(&mut self, course: &Self::Input) -> [f32; N] {
        match elastic_inverse_dynamics(&Static::<T>::NEW, &self.0, course, &RIGID_BODY) {
            Ok(told) => told.torque,
            Err(_) => [f32::NAN; N],
        }
    }
    fn torque(output: &[f32; N]) -> [f64; N] {
        output.map(f64::from)
    }
    fn address() -> usize {
        Self::tick as fn(&mut Self, &Self::Input) -> Self::Output as usize
    }
}

impl<T: Robot<N, N, N> + Joints<N>, const N: usize> Inverse<N> for Rigid<T, N> {
    const KEY: Key = Key {
        model: "rigid",
        ..Key::DEFAULT
    };
    type Input = State<f32, N, N>;
    type Output = [f32; N];

    fn start(_: &State<f32, N, N>) -> Self {
        let joints = T::joints();
        Self(
            Armature(joints.rotor),
            Viscous(joints.friction),
            PhantomData,
        )
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        course.state
    }
    #[inline(never)]
    fn tick(&mut self, state: &Self::Input) -> [f32; N] {
        Engine::<T>::rnea(state, &(RIGID_BODY, self.0, self.1))
    }
    fn torque(output: &[f32; N]) -> [f64; N] {
        output.map(f64::from)
    }
    fn address() -> usize {
        Self::tick as fn(&mut Self, &Self::Input) -> Self::Output as usize
    }
}
