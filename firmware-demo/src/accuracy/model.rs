//! What is computed: all of the rigid-body equation, or less.

use core::marker::PhantomData;

use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;

/// A robot as it is computed, and the effects that are.
pub trait Modelled<const B: usize, const N: usize> {
    /// On the axis `model`.
    const NAME: &'static str;
    /// The robot, or what it is taken for.
    type Robot: Robot<B, N, N>;
    /// The effects.
    type Scene: Effect<f32, B, N> + Effect<f64, B, N>;
    /// Their numbers.
    const SCENE: Self::Scene;
}

macro_rules! modelled {
    ($($(#[$doc:meta])* $model:ident = $name:literal: $scene:ty = $value:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $model<T>(PhantomData<T>);

        impl<T: Robot<B, N, N>, const B: usize, const N: usize> Modelled<B, N> for $model<T> {
            const NAME: &'static str = $name;
            type Robot = T;
            type Scene = $scene;
            const SCENE: $scene = $value;
        }
    )*};
}
modelled! {
    /// M q̈ + C q̇ + g.
    Full = "full": (Gravity, Inertia, Coriolis) = RIGID_BODY;
    /// M q̈ + g.
    NoCoriolis = "no_coriolis": (Gravity, Inertia) = (Gravity::EARTH, Inertia);
    /// g.
    GravityOnly = "gravity": (Gravity,) = (Gravity::EARTH,);
}
