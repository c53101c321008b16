//! The runs of a scene: a law on a plant.

use core::marker::PhantomData;

use dynamics_core::effects::Effect;
use dynamics_core::state::State;

use joint_drivers::{Law, Telemetry};

use super::app::{SimLoop, marked_tick};
use super::{Current, CurrentWithout, Less, PlantModel, Scene, Without};

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
    pub law: &'static str,
    pub less: Less,
    /// The control loop under this law.
    pub tick: Ticked<S, B, Q, V, N>,
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Run<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    pub const fn of<L: Law<N, S::Environment>>(plant: PlantModel, law: &'static str) -> Self {
        let tick = marked_tick::<L, S::Reference, S::Environment, N>;
        Self { plant, law, less: Less::NOTHING, tick }
    }

    /// A run of the whole law without the I-th effect, on the exact plant.
    pub const fn without<const I: usize>() -> Self
    where
        Without<S::Effects, I>: Effect<f32, B, V>,
    {
        let run = Self::of::<FullWithout<S, I, B, Q, V>>(PlantModel::Exact, "");
        Self { less: Less(I as u8), ..run }
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
pub struct FullWithout<S, const I: usize, const B: usize, const Q: usize, const V: usize>(
    PhantomData<S>,
);

impl<S, const I: usize, const B: usize, const Q: usize, const V: usize, const N: usize>
    Law<N, S::Environment> for FullWithout<S, I, B, Q, V>
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
