//! Ways that compute in every tick.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::scalar::Native;
use dynamics_core::state::Carried;
use dynamics_core::state::State;

use super::Inverse;
use super::form::Form;
use super::kernels::Named;
use super::key::Key;
use super::model::Modelled;

/// As the library ships it, in f32.
#[derive(Debug)]
pub struct Shipped<M, F, const B: usize>(PhantomData<(M, F)>);

/// With the kernel K inside.
#[derive(Debug)]
pub struct By<K, M, F, const B: usize>(PhantomData<(K, M, F)>);

/// With the kernel K, a call into another crate, before it.
#[derive(Debug)]
pub struct After<K, M, F, const B: usize>(PhantomData<(K, M, F)>);

/// With sines and cosines carried from tick to tick.
#[derive(Debug)]
pub struct Following<M, F, const B: usize, const N: usize>(Carried<f32, N>, PhantomData<(M, F)>);

/// Torques as they are compared.
fn widened<const N: usize>(torque: &[f32; N]) -> [f64; N] {
    torque.map(f64::from)
}

impl<M, F, const B: usize, const N: usize> Inverse<N> for Shipped<M, F, B>
where
    M: Modelled<B, N>,
    F: Form<M::Robot>,
{
    const KEY: Key = Key {
        trig: F::TRIG,
        model: M::NAME,
        form: F::NAME,
        ..Key::DEFAULT
    };
    type Input = State<f32, N, N>;
    type Output = [f32; N];

    fn start(_: &State<f32, N, N>) -> Self {
        Self(PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        course.state
    }
    #[inline(always)]
    fn tick(&mut self, state: &Self::Input) -> [f32; N] {
        F::rnea::<Native, _, _, _, _, _>(state, &M::SCENE)
    }
    fn torque(output: &[f32; N]) -> [f64; N] {
        widened(output)
    }
    fn address() -> usize {
        F::address::<Native, f32, M::Scene, B, N>()
    }
}

impl<K, M, F, const B: usize, const N: usize> Inverse<N> for By<K, M, F, B>
where
    K: Named,
    M: Modelled<B, N>,
    F: Form<M::Robot>,
{
    const KEY: Key = Key {
        trig: K::NAME,
        ..Shipped::<M, F, B>::KEY
    };
    type Input = State<f32, N, N>;
    type Output = [f32; N];

    fn start(_: &State<f32, N, N>) -> Self {
        Self(PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        course.state
    }
    #[inline(always)]
    fn tick(&mut self, state: &Self::Input) -> [f32; N] {
        F::rnea::<K, _, _, _, _, _>(state, &M::SCENE)
    }
    fn torque(output: &[f32; N]) -> [f64; N] {
        widened(output)
    }
    fn address() -> usize {
        F::address::<K, f32, M::Scene, B, N>()
    }
}

impl<K, M, F, const B: usize, const N: usize> Inverse<N> for After<K, M, F, B>
where
    K: Named,
    M: Modelled<B, N>,
    F: Form<M::Robot>,
{
    const KEY: Key = By::<K, M, F, B>::KEY;
    type Input = State<f32, N, N>;
    type Output = [f32; N];

    fn start(_: &State<f32, N, N>) -> Self {
        Self(PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        course.state
    }
    #[inline(never)]
    fn tick(&mut self, state: &Self::Input) -> [f32; N] {
        let trig = Engine::<M::Robot, K>::joint_trig(&state.q);
        F::rnea::<Native, _, _, _, _, _>(trig.with(state), &M::SCENE)
    }
    fn torque(output: &[f32; N]) -> [f64; N] {
        widened(output)
    }
    fn address() -> usize {
        Self::tick as fn(&mut Self, &Self::Input) -> Self::Output as usize
    }
}

impl<M, F, const B: usize, const N: usize> Inverse<N> for Following<M, F, B, N>
where
    M: Modelled<B, N>,
    F: Form<M::Robot>,
{
    const KEY: Key = Key {
        trig: "incremental",
        ..Shipped::<M, F, B>::KEY
    };
    const MEMORY: bool = true;
    type Input = State<f32, N, N>;
    type Output = [f32; N];

    fn start(first: &State<f32, N, N>) -> Self {
        Self(Carried::at(first.q), PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        course.state
    }
    #[inline(never)]
    fn tick(&mut self, state: &Self::Input) -> [f32; N] {
        F::rnea::<Native, _, _, _, _, _>(self.0.follow(&state.q).with(state), &M::SCENE)
    }
    fn torque(output: &[f32; N]) -> [f64; N] {
        widened(output)
    }
    fn address() -> usize {
        Self::tick as fn(&mut Self, &Self::Input) -> Self::Output as usize
    }
}
