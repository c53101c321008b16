//! Ways that compute in every tick.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::effects::Effect;
use dynamics_core::scalar::{Native, Real};
use dynamics_core::state::{IncrementalTrig, State};
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

/// With the kernel K, a call into another crate, before it.
#[derive(Debug)]
pub struct After<K, M, F, const B: usize>(PhantomData<(K, M, F)>);

/// With sines and cosines carried from tick to tick.
#[derive(Debug)]
pub struct Following<M, F, const B: usize, const N: usize>(
    IncrementalTrig<f32, N>,
    PhantomData<(M, F)>,
);

inverse! {
    [R: Real + Named, K: Kernel<R> + Named, M: Modelled<B, N, Scene: Effect<R, B, N>>, F: Form<M::Robot, R, M::Scene, B, N>,
     const B: usize] By<R, K, M, F, B>,
        Key {
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
        },
        { fn address() -> usize { F::address::<K>() } },
        State<R, N, N> = |at| {
            let State { q, qd, qdd } = *at;
            let [q, qd, qdd] = [q, qd, qdd].map(|xs| xs.map(|x| R::from_f64(f64::from(x))));
            State { q, qd, qdd }
        }, R,
        |_| Self(PhantomData), #[inline(always)] |self, state| F::rnea::<K, _>(state, &M::SCENE);
    [K: Kernel<f32> + Named, M: Modelled<B, N>, F: Form<M::Robot, f32, M::Scene, B, N>, const B: usize] After<K, M, F, B>,
        Key { trig: K::NAME, model: M::NAME, form: F::NAME, ..Key::DEFAULT }, {},
        State<f32, N, N> = |at| *at, f32,
        |_| Self(PhantomData), #[inline(never)] |self, state| {
            let trig = Engine::<M::Robot, K>::joint_trig(&state.q);
            F::rnea::<Native, _>(trig.with(state), &M::SCENE)
        };
    [M: Modelled<B, N>, F: Form<M::Robot, f32, M::Scene, B, N>, const B: usize] Following<M, F, B, N>,
        Key { trig: "incremental", model: M::NAME, form: F::NAME, ..Key::DEFAULT }, { const MEMORY: bool = true; },
        State<f32, N, N> = |at| *at, f32,
        |first| Self(IncrementalTrig::at(first.q), PhantomData), #[inline(never)] |self, state| {
            F::rnea::<Native, _>(self.0.follow(&state.q).with(state), &M::SCENE)
        };
}
