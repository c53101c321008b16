//! A scene's effects less one of them, and the runs that show what each is worth.

use core::any::type_name;

use dynamics_core::delegate_effect;
use dynamics_core::effects::Effect;

use super::{Run, Scene, Term};

/// The effects of a tuple without the I-th.
#[derive(Clone, Copy, Debug)]
pub struct Without<T, const I: usize>(pub T);

/// The effect at the place `AT` of a tuple whose I-th is left out.
#[derive(Debug)]
struct Element<'a, E, const AT: usize, const I: usize>(&'a E);

delegate_effect! {
    if I != AT,
    impl[E: Effect<f32, B, V>, const B: usize, const V: usize, const AT: usize, const I: usize]
    Effect<f32, B, V> for Element<'_, E, AT, I>,
    |this| { E => *this.0 }
}

/// The effects of a law as they are in an environment, made anew for each hook: a tuple in memory
/// would hide from the compiler what of it is constant, and cost its copying.
#[derive(Debug)]
pub struct Current<'a, S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    pub &'a S::Environment,
)
where
    S: Scene<B, Q, V, N>;

delegate_effect! {
    impl[S: Scene<B, Q, V, N>, const B: usize, const Q: usize, const V: usize, const N: usize]
    Effect<f32, B, V> for Current<'_, S, B, Q, V, N>,
    |this| { S::Effects => S::current(this.0) }
}

/// [`Current`] without the I-th effect.
#[derive(Debug)]
pub struct CurrentWithout<
    'a,
    S,
    const I: usize,
    const B: usize,
    const Q: usize,
    const V: usize,
    const N: usize,
>(pub &'a S::Environment)
where
    S: Scene<B, Q, V, N>;

delegate_effect! {
    impl[S: Scene<B, Q, V, N>, const I: usize, const B: usize, const Q: usize, const V: usize, const N: usize]
    Effect<f32, B, V> for CurrentWithout<'_, S, I, B, Q, V, N>
    where [Without<S::Effects, I>: Effect<f32, B, V>],
    |this| { Without<S::Effects, I> => Without::<_, I>(S::current(this.0)) }
}

/// The effects of a scene, and the runs of its laws that each lack one of them.
pub trait Effects<S, const B: usize, const Q: usize, const V: usize, const N: usize>:
    Effect<f32, B, V>
where
    S: Scene<B, Q, V, N>,
{
    const TERMS: &'static [Term];
    /// Feed-forward without each, in their order.
    const ABLATIONS: &'static [Run<S, B, Q, V, N>];
}

/// The name of a type without its path and parameters.
pub fn name<T>() -> &'static str {
    let path = type_name::<T>();
    let path = path.split('<').next().unwrap_or(path);
    path.rsplit(':').next().unwrap_or(path)
}

/// [`Effects`] and [`Without`] for one length.
macro_rules! tuple {
    ($($i:tt $t:ident),*) => {
        delegate_effect! {
            impl[$($t: Effect<f32, B, V>,)* const I: usize, const B: usize, const V: usize]
            Effect<f32, B, V> for Without<($($t,)*), I>,
            |this| { $(Element<'_, $t, $i, I> => Element::<_, $i, I>(&(this.0).$i)),* }
        }

        impl<S, $($t,)* const B: usize, const Q: usize, const V: usize, const N: usize>
            Effects<S, B, Q, V, N> for ($($t,)*)
        where
            S: Scene<B, Q, V, N, Effects = Self>,
            $($t: Effect<f32, B, V>,)*
        {
            const TERMS: &'static [Term] = &[$(
                Term { name: name::<$t>, bytes: size_of::<$t>() },
            )*];
            const ABLATIONS: &'static [Run<S, B, Q, V, N>] =
                &[$(Run::without::<$i>(),)*];
        }
    };
}

tuple!(0 A, 1 C);
tuple!(0 A, 1 C, 2 D);
tuple!(0 A, 1 C, 2 D, 3 E);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F, 5 G);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F, 5 G, 6 H);
tuple!(0 A, 1 C, 2 D, 3 E, 4 F, 5 G, 6 H, 7 J);
