//! The two forms of the library, under one name.

use dynamics_core::effects::Effect;
use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::{RobotState, State};
use dynamics_core::trig::Kernel;
use dynamics_core::{Core, Engine};

/// The library's [`Engine`] or [`Core`] of the robot T, in the scalar R, under the effects E.
pub trait Form<T, R: Real, E, const B: usize, const N: usize> {
    /// On the axis `form`.
    const NAME: &'static str;
    /// The name of its own kernel in f32.
    const TRIG: &'static str;

    /// The address of ID(q, q̇, q̈) by a kernel.
    fn address<K: Kernel<R>>() -> usize;
    /// ID(q, q̇, q̈) by a kernel.
    fn rnea<K: Kernel<R>, S: RobotState<R, N, N>>(state: S, effects: &E) -> [R; N];
}

macro_rules! form {
    ($form:ident, $name:literal, $trig:literal) => {
        impl<T, R, E, const B: usize, const N: usize> Form<T, R, E, B, N> for $form<T>
        where
            T: Robot<B, N, N>,
            R: Real,
            E: Effect<R, B, N>,
        {
            const NAME: &'static str = $name;
            const TRIG: &'static str = $trig;

            fn address<K: Kernel<R>>() -> usize {
                $form::<T, K>::rnea as fn(&'static State<R, N, N>, &E) -> [R; N] as usize
            }
            #[inline(always)]
            fn rnea<K: Kernel<R>, S: RobotState<R, N, N>>(state: S, effects: &E) -> [R; N] {
                $form::<T, K>::rnea(state, effects)
            }
        }
    };
}
form!(Engine, "engine", "table3");
form!(Core, "core", "table3x4");
