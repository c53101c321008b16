//! The runs of a scene: a law on a plant.

use core::marker::PhantomData;

use dynamics_core::effects::Effect;
use dynamics_core::state::State;

use joint_drivers::{Law, Telemetry};

use super::app::{SimLoop, marked_tick};
use super::{Current, CurrentWithout, Scene, Without};

/// The accuracy of the controller's model of the plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlantModel {
    Exact,
    /// Its inertias are off by up to 3 %, its friction by up to 10 %.
    Mismatched,
}

impl PlantModel {
    /// Its name in the log.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Mismatched => "mismatched",
        }
    }
}

/// A law, as the log names it.
#[derive(Clone, Copy, Debug)]
pub enum Name {
    Of(&'static str),
    /// The scene's feed-forward without an effect of this name.
    Without(fn() -> &'static str),
}

/// The function that is called once a tick.
type Ticked<S, const B: usize, const Q: usize, const V: usize, const N: usize> = fn(
    &mut SimLoop<N>,
    &<S as Scene<B, Q, V, N>>::Reference,
    &<S as Scene<B, Q, V, N>>::Environment,
)
    -> Telemetry<N>;

/// One run of the reference.
pub struct Run<S: Scene<B, Q, V, N>, const B: usize, const Q: usize, const V: usize, const N: usize>
{
    pub plant: PlantModel,
    pub law: Name,
    /// The control loop under this law.
    pub tick: Ticked<S, B, Q, V, N>,
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Run<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    pub const fn of<L: Law<N, S::Environment>>(plant: PlantModel, name: &'static str) -> Self {
        Self { plant, law: Name::Of(name), tick: marked_tick::<L, S::Reference, S::Environment, N> }
    }

    /// A run of the law `L`, which lacks an effect of this name, on the exact plant.
    pub const fn without<L: Law<N, S::Environment>>(name: fn() -> &'static str) -> Self {
        Self {
            plant: PlantModel::Exact,
            law: Name::Without(name),
            tick: marked_tick::<L, S::Reference, S::Environment, N>,
        }
    }
}

/// Feed-forward by all of the scene's effects.
pub struct Full<S, const B: usize, const Q: usize, const V: usize>(PhantomData<S>);

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Law<N, S::Environment>
    for Full<S, B, Q, V>
where
    S: Scene<B, Q, V, N>,
{
    const ACCELERATES: bool = <S::Effects as Effect<f32, B, V>>::ACCELERATIONS;

    #[inline(always)]
    fn feedforward(reference: &State<f32, N, N>, environment: &S::Environment) -> [f32; N] {
        if S::CONSTANT_EFFECTS {
            return S::inverse(reference, environment, &S::EFFECTS);
        }
        S::inverse(reference, environment, &Current::<S, B, Q, V, N>(environment))
    }
}

/// The same without the I-th effect.
pub struct Less<S, const I: usize, const B: usize, const Q: usize, const V: usize>(PhantomData<S>);

impl<S, const I: usize, const B: usize, const Q: usize, const V: usize, const N: usize>
    Law<N, S::Environment> for Less<S, I, B, Q, V>
where
    S: Scene<B, Q, V, N>,
    Without<S::Effects, I>: Effect<f32, B, V>,
{
    const ACCELERATES: bool = <Without<S::Effects, I> as Effect<f32, B, V>>::ACCELERATIONS;

    #[inline(always)]
    fn feedforward(reference: &State<f32, N, N>, environment: &S::Environment) -> [f32; N] {
        if S::CONSTANT_EFFECTS {
            let effects = const { Without::<_, I>(S::EFFECTS) };
            return S::inverse(reference, environment, &effects);
        }
        S::inverse(reference, environment, &CurrentWithout::<S, I, B, Q, V, N>(environment))
    }
}

/// No feed-forward at all.
#[derive(Clone, Copy, Debug)]
pub struct PdOnly;

impl<const N: usize, X> Law<N, X> for PdOnly {
    const ACCELERATES: bool = false;

    fn feedforward(_: &State<f32, N, N>, _: &X) -> [f32; N] {
        [0.0; N]
    }
}
