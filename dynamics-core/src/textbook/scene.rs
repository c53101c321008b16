//! Scenes that are checked at the line of the user's.

use crate::effects::{Effect, of_core};
use crate::model::{RobotModel, Static};

use super::Core;

/// [`Core::scene_f32`] and [`Core::scene_f64`].
macro_rules! scene {
    ($(#[$doc:meta])* $name:ident $r:ty) => {
        $(#[$doc])*
        #[track_caller]
        #[must_use]
        pub const fn $name<E, const B: usize, const Q: usize, const V: usize>(effects: E) -> E
        where
            Static<T, K>: RobotModel<$r, B, Q, V>,
            E: Effect<$r, B, V>,
        {
            of_core::<$r, E, B, V>();
            // Evaluates the robot, whose own errors stand at its lines.
            let _ = Static::<T, K>::KINDS;
            effects
        }
    };
}

impl<T, K> Core<T, K> {
    scene! {
        /// The same `effects`, checked as a scene of this robot in f32 at the line of the caller,
        /// as by [`Engine::scene_f32`](crate::Engine::scene_f32), for the textbook algorithms.
        ///
        /// ```
        /// use dynamics_core::{Core, effects::{Gravity, GyroscopicRotors}, robots::Ur5e};
        /// const ROTORS: GyroscopicRotors<f32, 6> = GyroscopicRotors { inertia: [1e-4; 6], ratio: [5.0; 6] };
        /// const SCENE: (Gravity, GyroscopicRotors<f32, 6>) = Core::<Ur5e>::scene_f32((Gravity::EARTH, ROTORS));
        /// # assert_eq!(SCENE.1, ROTORS);
        /// ```
        ///
        /// # Panics
        /// If the scene is one that the textbook algorithms do not take: a compile error in a
        /// `const` item.
        scene_f32 f32
    }

    scene! {
        /// The same `effects`, checked as a scene of this robot in f64: see [`Core::scene_f32`].
        ///
        /// ```
        /// use dynamics_core::{Core, effects::{Gravity, Viscous}, robots::Ur5e};
        /// const SCENE: (Gravity, Viscous<f64, 6>) = Core::<Ur5e>::scene_f64((Gravity::EARTH, Viscous([0.5; 6])));
        /// # assert_eq!(SCENE.1, Viscous([0.5; 6]));
        /// ```
        ///
        /// # Panics
        /// As [`Core::scene_f32`].
        scene_f64 f64
    }
}
