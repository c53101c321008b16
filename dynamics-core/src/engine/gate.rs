//! The check while compiling that the engine takes a robot and a scene.

use core::marker::PhantomData;

use super::Engine;
use crate::effects::{Effect, Scene, are_of, meaning};
use crate::model::Robot;
use crate::scalar::Real;

/// A scene of the robot `T`, for the engine, evaluated once for all of its algorithms.
pub(super) struct EngineScene<T, R, E, const B: usize, const Q: usize, const V: usize>(
    PhantomData<(T, R, E)>,
);

impl<T, R: Real, E, const B: usize, const Q: usize, const V: usize> EngineScene<T, R, E, B, Q, V>
where
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    /// Public functions evaluate it in their own bodies, so that the compiler names the line that
    /// calls them.
    pub(super) const TAKEN: () = {
        let () = Scene::<R, E, B, V>::MEANING;
        taken::<T, R, E, B, Q, V>();
    };
}

/// A robot and a scene that the engine takes.
#[track_caller]
const fn taken<T, R: Real, E, const B: usize, const Q: usize, const V: usize>()
where
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    meaning::<R, E, B, V>();
    are_of::<R, E, B, V>(T::MODEL.name);
    assert!(V <= 64, "the engine takes up to 64 velocity coordinates; use `Core`");
}

/// [`Engine::scene_f32`] and [`Engine::scene_f64`].
macro_rules! scene {
    ($(#[$doc:meta])* $name:ident $r:ty) => {
        $(#[$doc])*
        #[track_caller]
        #[must_use]
        pub const fn $name<E, const B: usize, const Q: usize, const V: usize>(
            effects: E,
        ) -> E
        where
            T: Robot<B, Q, V>,
            E: Effect<$r, B, V>,
        {
            taken::<T, $r, E, B, Q, V>();
            effects
        }
    };
}

impl<T, K> Engine<T, K> {
    scene! {
        /// The same `effects`, checked as a scene of this robot in f32 at the line of the caller.
        ///
        /// The compiler checks a scene wherever an algorithm takes it, but only in a full build,
        /// and with a message from inside the library. The value of a `const` item is evaluated by
        /// `cargo check` and rust-analyzer, too, and its errors stand at its line. No machine code:
        /// the value is the one that is given.
        ///
        /// ```
        /// use dynamics_core::effects::{Coriolis, Gravity, Inertia, Viscous};
        /// use dynamics_core::{Engine, robots::Ur5e, state::State};
        /// type Effects = (Gravity, Inertia, Coriolis, Viscous<f32, 6>);
        /// const EFFECTS: Effects = Engine::<Ur5e>::scene_f32((Gravity::EARTH, Inertia, Coriolis, Viscous([0.5; 6])));
        /// let tau = Engine::<Ur5e>::rnea(&State::at([0.3_f32; 6]), &EFFECTS);
        /// # assert!(tau[1].is_finite());
        /// ```
        ///
        /// An effect twice, of which a scene contains [at most one](crate::effects::Once):
        ///
        /// ```compile_fail,E0080
        /// use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};
        /// use dynamics_core::{Engine, robots::Ur5e};
        /// const TWICE: ((Gravity, Inertia, Coriolis), Coriolis) = Engine::<Ur5e>::scene_f32((RIGID_BODY, Coriolis));
        /// // error: the scene contains Coriolis twice, which changes nothing: leave one out (RIGID_BODY contains it)
        /// ```
        ///
        /// # Panics
        /// If the scene or the robot is one that the engine does not take: a compile error in a
        /// `const` item.
        scene_f32 f32
    }

    scene! {
        /// The same `effects`, checked as a scene of this robot in f64: see [`Engine::scene_f32`].
        ///
        /// ```
        /// use dynamics_core::{Engine, effects::{Gravity, Viscous}, robots::Ur5e};
        /// const SCENE: (Gravity, Viscous<f64, 6>) = Engine::<Ur5e>::scene_f64((Gravity::EARTH, Viscous([0.5; 6])));
        /// # assert_eq!(SCENE.1, Viscous([0.5; 6]));
        /// ```
        ///
        /// # Panics
        /// As [`Engine::scene_f32`].
        scene_f64 f64
    }
}
