//! A tuple of effects less one of them, and the runs that show what each is worth.

use core::any::type_name;

use dynamics_core::effects::Effect;

use super::{Less, Run, Scene};

/// The effects of the scene S without the I-th.
pub trait Without<S, const I: usize, const B: usize, const Q: usize, const V: usize, const N: usize>
{
    /// The others.
    type Rest: Effect<f32, B, V>;
    /// The others at the start.
    const REST: Self::Rest;

    /// The others, in their order.
    fn without(self) -> Self::Rest;
}

/// An effect that a scene names.
#[derive(Clone, Copy, Debug)]
pub struct Named {
    /// Its type in words.
    pub name: fn() -> &'static str,
    /// What its value takes where it is kept in RAM, as in the plant, bytes.
    pub bytes: usize,
}

/// The effects of a scene, and the runs of its laws that each lack one of them.
pub trait Effects<S, const B: usize, const Q: usize, const V: usize, const N: usize>:
    Effect<f32, B, V>
where
    S: Scene<B, Q, V, N>,
{
    /// In their order.
    const NAMED: &'static [Named];
    /// Feed-forward without each, in their order.
    const LESS: &'static [Run<S, B, Q, V, N>];
}

/// The name of a type without its path and parameters.
pub fn name<T>() -> &'static str {
    let path = type_name::<T>();
    let path = path.split('<').next().unwrap_or(path);
    path.rsplit("::").next().unwrap_or(path)
}

/// [`Effects`] and [`Without`] for one length.
macro_rules! tuple {
    ($($i:literal $t:ident),*) => {
        tuple!([$($t)*] [] $($i $t,)*);

        impl<S, $($t,)* const B: usize, const Q: usize, const V: usize, const N: usize>
            Effects<S, B, Q, V, N> for ($($t,)*)
        where
            S: Scene<B, Q, V, N, Effects = Self>,
            $($t: Effect<f32, B, V> + Copy,)*
        {
            const NAMED: &'static [Named] = &[$(
                Named { name: name::<$t>, bytes: size_of::<$t>() },
            )*];
            const LESS: &'static [Run<S, B, Q, V, N>] =
                &[$(Run::without::<Less<S, $i, B, Q, V>>(name::<$t>),)*];
        }
    };
    ([$($all:ident)*] [$($before:ident)*] $i:literal $t:ident, $($j:literal $u:ident,)*) => {
        less!([$($all)*] $i [$($before)* $($u)*]);
        tuple!([$($all)*] [$($before)* $t] $($j $u,)*);
    };
    ([$($all:ident)*] [$($before:ident)*]) => {};
}

/// One impl of [`Without`].
macro_rules! less {
    ([$($all:ident)*] $i:literal [$($rest:ident)*]) => {
        #[allow(
            non_snake_case,
            unused_variables,
            reason = "a type parameter names the value of its type too"
        )]
        impl<S, $($all,)* const B: usize, const Q: usize, const V: usize, const N: usize>
            Without<S, $i, B, Q, V, N> for ($($all,)*)
        where
            S: Scene<B, Q, V, N, Effects = Self>,
            $($all: Effect<f32, B, V> + Copy,)*
        {
            type Rest = ($($rest,)*);
            const REST: Self::Rest = {
                let ($($all,)*) = S::EFFECTS;
                ($($rest,)*)
            };

            #[inline(always)]
            fn without(self) -> Self::Rest {
                let ($($all,)*) = self;
                ($($rest,)*)
            }
        }
    };
}

tuple!(0 A, 1 C);
tuple!(0 A, 1 C, 2 D);
tuple!(0 A, 1 C, 2 D, 3 E);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F, 5 G);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F, 5 G, 6 H);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F, 5 G, 6 H, 7 I);
