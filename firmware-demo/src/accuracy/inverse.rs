//! Ways that compute in every tick.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::effects::Effect;
use dynamics_core::scalar::{Native, Real};
use dynamics_core::state::{Carried, State};
use dynamics_core::trig::Kernel;

use super::Inverse;
use super::form::Form;
use super::key::{Key, Named};
use super::model::Modelled;

/// By the form F in the scalar R, with the kernel K inside.
#[derive(Debug)]
pub struct By<R, K, M, F, const B: usize>(PhantomData<(R, K, M, F)>);

/// As the library ships it, in the scalar R, with its own sines and cosines.
pub type In<R, M, F, const B: usize> = By<R, Native, M, F, B>;

impl<R, K, M, F, const B: usize, const N: usize> Inverse<N> for By<R, K, M, F, B>
where
    R: Real + Named,
    K: Kernel<R> + Named,
    M: Modelled<B, N>,
    M::Scene: Effect<R, B, N>,
    F: Form<M::Robot, R, M::Scene, B, N>,
{
    const KEY: Key = Key {
        arith: R::NAME,
        trig: match (K::NAME.is_empty(), size_of::<R>() == 4) {
            (true, true) => F::TRIG,
            // In other numbers than f32 there is but one kernel.
            (true, false) => Key::DEFAULT.trig,
            _ => K::NAME,
        },
        model: M::NAME,
        form: F::NAME,
        ..Key::DEFAULT
    };
    type Input = State<R, N, N>;
    type Scalar = R;

    fn start(_: &State<f32, N, N>) -> Self {
        Self(PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        let State { q, qd, qdd } = course.state;
        let [q, qd, qdd] = [q, qd, qdd].map(|xs| xs.map(|x| R::from_f64(f64::from(x))));
        State { q, qd, qdd }
    }
    #[inline(always)]
    fn tick(&mut self, state: &Self::Input) -> [R; N] {
        F::rnea::<K, _>(state, &M::SCENE)
    }
    fn address() -> usize {
        F::address::<K>()
    }
}

/// Ways of the model M by the form F that are no call of the form alone, K being the kernel of those that have one: the
/// name of their sines, what they remember, and a tick.
macro_rules! ways {
    ($($(#[$doc:meta])* $way:ident <$($k:ident)?>, $trig:expr, $memory:literal,
       $state:ty = |$first:pat_param| $start:expr, |$self:ident, $now:ident| $tick:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $way<$($k,)? M, F, const B: usize, const N: usize>($state, PhantomData<($($k,)? M, F)>);

        impl<$($k: Kernel<f32> + Named,)? M, F, const B: usize, const N: usize> Inverse<N> for $way<$($k,)? M, F, B, N>
        where
            M: Modelled<B, N>,
            F: Form<M::Robot, f32, M::Scene, B, N>,
        {
            const KEY: Key = Key { trig: $trig, model: M::NAME, form: F::NAME, ..Key::DEFAULT };
            const MEMORY: bool = $memory;
            type Input = State<f32, N, N>;
            type Scalar = f32;

            fn start($first: &State<f32, N, N>) -> Self {
                Self($start, PhantomData)
            }
            fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
                course.state
            }
            #[inline(never)]
            fn tick(&mut $self, $now: &Self::Input) -> [f32; N] {
                $tick
            }
        }
    )*};
}
ways! {
    /// With the kernel K, a call into another crate, before it.
    After<K>, K::NAME, false, () = |_| (), |self, state| {
        let trig = Engine::<M::Robot, K>::joint_trig(&state.q);
        F::rnea::<Native, _>(trig.with(state), &M::SCENE)
    };
    /// With sines and cosines carried from tick to tick.
    Following<>, "incremental", true, Carried<f32, N> = |first| Carried::at(first.q), |self, state| {
        F::rnea::<Native, _>(self.0.follow(&state.q).with(state), &M::SCENE)
    };
}
