//! Ways that compute in every tick.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::scalar::Native;
use dynamics_core::state::{IncrementalTrig, State};

use super::Inverse;
use super::form::Form;
use super::kernels::Named;
use super::key::Key;
use super::model::Modelled;

/// Ways of the model M by the form F, K being the kernel of those that have one: the name of their sines, what they
/// remember, and a tick, which is a call of the function at `address`, or one by itself.
macro_rules! ways {
    ($($(#[$doc:meta])* $way:ident <$($k:ident)?>, $trig:expr, $state:ty = |$first:pat_param| $start:expr,
       #[inline($inline:ident)] |$self:ident, $now:ident| $tick:expr
       $(, address: $address:expr)? $(, memory: $memory:literal)?;)*) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $way<$($k,)? M, F, const B: usize, const N: usize>($state, PhantomData<($($k,)? M, F)>);

        impl<$($k: Named,)? M: Modelled<B, N>, F: Form<M::Robot>, const B: usize, const N: usize>
            Inverse<N> for $way<$($k,)? M, F, B, N>
        {
            const KEY: Key = Key { trig: $trig, model: M::NAME, form: F::NAME, ..Key::DEFAULT };
            $(const MEMORY: bool = $memory;)?
            type Input = State<f32, N, N>;
            type Scalar = f32;

            fn start($first: &State<f32, N, N>) -> Self {
                Self($start, PhantomData)
            }
            fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
                course.state
            }
            #[inline($inline)]
            fn tick(&mut $self, $now: &Self::Input) -> [f32; N] {
                $tick
            }
            $(fn address() -> usize {
                $address
            })?
        }
    )*};
}
ways! {
    /// As the library ships it, in f32.
    Shipped<>, F::TRIG, () = |_| (), #[inline(always)] |self, state| F::rnea::<Native, _, _, _, _, _>(state, &M::SCENE),
        address: F::address::<Native, f32, M::Scene, B, N>();
    /// With the kernel K inside.
    By<K>, K::NAME, () = |_| (), #[inline(always)] |self, state| F::rnea::<K, _, _, _, _, _>(state, &M::SCENE),
        address: F::address::<K, f32, M::Scene, B, N>();
    /// With the kernel K, a call into another crate, before it.
    After<K>, K::NAME, () = |_| (), #[inline(never)] |self, state| {
        let trig = Engine::<M::Robot, K>::joint_trig(&state.q);
        F::rnea::<Native, _, _, _, _, _>(trig.with(state), &M::SCENE)
    };
    /// With sines and cosines carried from tick to tick.
    Following<>, "incremental", IncrementalTrig<f32, N> = |first| IncrementalTrig::at(first.q), #[inline(never)] |self, state| {
        F::rnea::<Native, _, _, _, _, _>(self.0.follow(&state.q).with(state), &M::SCENE)
    }, memory: true;
}
