//! The two forms of the library, under one name.

use dynamics_core::effects::Effect;
use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::{JointTrig, State};
use dynamics_core::trig::Kernel;
use dynamics_core::{Core, Engine};

/// The library's [`Engine`] or [`Core`].
pub trait Form<T> {
    /// On the axis `form`.
    const NAME: &'static str;
    /// The name of its own kernel in f32.
    const TRIG: &'static str;

    /// ID(q, q̇, q̈) as the library ships it.
    fn rnea<R: Real, E: Effect<R, B, N>, const B: usize, const N: usize>()
    -> fn(&State<R, N, N>, &E) -> [R; N]
    where
        T: Robot<B, N, N>;
    /// The same by a kernel.
    fn rnea_by<K: Kernel<f32>, E: Effect<f32, B, N>, const B: usize, const N: usize>()
    -> fn(&State<f32, N, N>, &E) -> [f32; N]
    where
        T: Robot<B, N, N>;
    /// The same with sines and cosines at hand.
    fn rnea_at<E: Effect<f32, B, N>, const B: usize, const N: usize>()
    -> fn(&JointTrig<f32, N>, &State<f32, N, N>, &E) -> [f32; N]
    where
        T: Robot<B, N, N>;
}

macro_rules! form {
    ($form:ident, $name:literal, $trig:literal) => {
        impl<T> Form<T> for $form<T> {
            const NAME: &'static str = $name;
            const TRIG: &'static str = $trig;

            #[inline(always)]
            fn rnea<R: Real, E: Effect<R, B, N>, const B: usize, const N: usize>()
            -> fn(&State<R, N, N>, &E) -> [R; N]
            where
                T: Robot<B, N, N>,
            {
                Self::rnea
            }

            #[inline(always)]
            fn rnea_by<K: Kernel<f32>, E: Effect<f32, B, N>, const B: usize, const N: usize>()
            -> fn(&State<f32, N, N>, &E) -> [f32; N]
            where
                T: Robot<B, N, N>,
            {
                Self::rnea_by::<K, f32, E, B, N, N>
            }

            #[inline(always)]
            fn rnea_at<E: Effect<f32, B, N>, const B: usize, const N: usize>()
            -> fn(&JointTrig<f32, N>, &State<f32, N, N>, &E) -> [f32; N]
            where
                T: Robot<B, N, N>,
            {
                Self::rnea_at
            }
        }
    };
}
form!(Engine, "engine", "table3");
form!(Core, "core", "table3x4");
