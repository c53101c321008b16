//! The runs of a scene: a law on a plant.

use core::marker::PhantomData;

use dynamics_core::effects::Effect;
use dynamics_core::state::State;

use super::app::SimLoop;
use super::{Now, Scene, Told, Without};
use crate::control_loop::{Law, Telemetry};

/// How well the controller knows the plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Exactly.
    Exact,
    /// Its inertias are off by up to 3 %, its friction by up to 10 %.
    Mismatched,
}

impl Truth {
    /// As the log names it.
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
    /// Its own name.
    Of(&'static str),
    /// The scene's feed-forward without an effect of this name.
    Without(fn() -> &'static str),
}

/// What is called once a tick.
type Ticked<S, const B: usize, const Q: usize, const V: usize, const N: usize> = fn(
    &mut SimLoop<N>,
    &<S as Scene<B, Q, V, N>>::Reference,
    &<S as Scene<B, Q, V, N>>::Around,
)
    -> Telemetry<N>;

/// One run of the reference.
pub struct Run<S: Scene<B, Q, V, N>, const B: usize, const Q: usize, const V: usize, const N: usize>
{
    /// The plant.
    pub plant: Truth,
    /// The law.
    pub law: Name,
    /// The control loop under this law.
    pub tick: Ticked<S, B, Q, V, N>,
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Run<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    /// Of the law `L`.
    pub const fn of<L: Law<N, S::Around>>(plant: Truth, name: &'static str) -> Self {
        Self {
            plant,
            law: Name::Of(name),
            tick: SimLoop::<N>::tick::<L, S::Reference, S::Around>,
        }
    }

    /// Of the law `L`, which lacks an effect of this name, on the exact plant.
    pub const fn without<L: Law<N, S::Around>>(name: fn() -> &'static str) -> Self {
        Self {
            plant: Truth::Exact,
            law: Name::Without(name),
            tick: SimLoop::<N>::tick::<L, S::Reference, S::Around>,
        }
    }
}

/// Feed-forward by all of the scene's effects.
pub struct Full<S, const B: usize, const Q: usize, const V: usize>(PhantomData<S>);

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Law<N, S::Around>
    for Full<S, B, Q, V>
where
    S: Scene<B, Q, V, N>,
{
    const ACCELERATES: bool = <S::Effects as Effect<f32, B, V>>::ACCELERATIONS;

    #[inline(always)]
    fn feedforward(reference: &State<f32, N, N>, around: &S::Around) -> [f32; N] {
        if S::STEADY {
            return S::inverse(reference, around, &S::EFFECTS);
        }
        S::inverse(reference, around, &Now::<Self, _, N>::of(around))
    }
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Told<S::Around, B, V, N>
    for Full<S, B, Q, V>
where
    S: Scene<B, Q, V, N>,
{
    type Effects = S::Effects;

    #[inline(always)]
    fn told(around: &S::Around) -> S::Effects {
        let mut effects = S::EFFECTS;
        S::surround(&mut effects, around);
        effects
    }
}

/// The same without the I-th effect.
pub struct Less<S, const I: usize, const B: usize, const Q: usize, const V: usize>(PhantomData<S>);

impl<S, const I: usize, const B: usize, const Q: usize, const V: usize, const N: usize>
    Law<N, S::Around> for Less<S, I, B, Q, V>
where
    S: Scene<B, Q, V, N>,
    S::Effects: Without<S, I, B, Q, V, N>,
{
    const ACCELERATES: bool =
        <<S::Effects as Without<S, I, B, Q, V, N>>::Rest as Effect<f32, B, V>>::ACCELERATIONS;

    #[inline(always)]
    fn feedforward(reference: &State<f32, N, N>, around: &S::Around) -> [f32; N] {
        if S::STEADY {
            let rest = <S::Effects as Without<S, I, B, Q, V, N>>::REST;
            return S::inverse(reference, around, &rest);
        }
        S::inverse(reference, around, &Now::<Self, _, N>::of(around))
    }
}

impl<S, const I: usize, const B: usize, const Q: usize, const V: usize, const N: usize>
    Told<S::Around, B, V, N> for Less<S, I, B, Q, V>
where
    S: Scene<B, Q, V, N>,
    S::Effects: Without<S, I, B, Q, V, N>,
{
    type Effects = <S::Effects as Without<S, I, B, Q, V, N>>::Rest;

    #[inline(always)]
    fn told(around: &S::Around) -> Self::Effects {
        Full::<S, B, Q, V>::told(around).without()
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
