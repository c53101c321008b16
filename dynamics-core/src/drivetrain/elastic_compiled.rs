//! Inverse dynamics with compliant joints for a robot known at compile time: by the textbook and by
//! the engine.

use super::elastic_inverse_dynamics::{command, scene_taken};
use super::{ElasticCommand, ElasticJoints, ElasticReference};
use crate::effects::Effect;
use crate::model::{Robot, RobotModel, Static};
use crate::scalar::Real;
use crate::state::entry;
use crate::trig::Kernel;
use crate::{Core, Engine};

/// Every joint has one degree of freedom, or is fixed.
const fn has_transmissions<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>() {
    let (links, mut i) = (&T::MODEL.links, 0);
    while i < B {
        assert!(
            links[i].joint.kind.coordinates().1 <= 1,
            "a joint has several degrees of freedom: no transmission of it is known"
        );
        i += 1;
    }
}

impl<T, K> Core<T, K> {
    /// Torques τ_m, angles θ and rates θ̇ of the motors for a motion of the links, see
    /// [`elastic_inverse_dynamics`](super::elastic_inverse_dynamics()).
    ///
    /// A robot with a joint of several degrees of freedom does not compile.
    #[inline(never)]
    #[must_use]
    pub fn elastic_inverse_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        joints: &ElasticJoints<R, V>,
        reference: &ElasticReference<R, Q, V>,
        effects: &E,
    ) -> ElasticCommand<R, V>
    where
        T: Robot<B, Q, V>,
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { has_transmissions::<T, B, Q, V>() };
        command(&Static::<T, K>::NEW, joints, reference, effects)
    }
}

impl<T, K> Engine<T, K> {
    /// Torques τ_m, angles θ and rates θ̇ of the motors for a motion of the links, N·m or N, rad or
    /// m, rad/s or m/s, as [`elastic_inverse_dynamics`](super::elastic_inverse_dynamics()) computes
    /// them.
    ///
    /// Effects as there, angles as in [`Engine::rnea`].
    ///
    /// # Cost
    /// About five times that of [`Engine::rnea`]: in `docs/scenes.md` in the repository the
    /// dynamics of `flexible_joint`. The same instructions for all data.
    ///
    /// # Errors
    /// None: a robot with a joint of several degrees of freedom does not compile.
    ///
    /// # Source
    /// Buondonno & De Luca (2015), over base parameters; Spong (1987), equations (12), (13).
    ///
    /// ```
    /// use dynamics_core::drivetrain::{ElasticJoints, ElasticReference};
    /// use dynamics_core::{Core, Engine, effects::RIGID_BODY, robots::Ur5e, state::State};
    /// let joints = ElasticJoints { stiffness: [1e4_f64; 6], rotor: [1.0; 6], friction: [5.0; 6] };
    /// let state = State { q: [0.3; 6], qd: [0.5; 6], qdd: [1.0; 6] };
    /// let swing = ElasticReference { state, jerk: [10.0; 6], snap: [-50.0; 6] };
    /// let (a, b) = (
    ///     Core::<Ur5e>::elastic_inverse_dynamics(&joints, &swing, &RIGID_BODY),
    ///     Engine::<Ur5e>::elastic_inverse_dynamics(&joints, &swing, &RIGID_BODY),
    /// );
    /// assert!((0..6).all(|i| (a.torque[i] - b.torque[i]).abs() < 1e-11));
    /// ```
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::drivetrain::{ElasticJoints, ElasticReference};
    /// use dynamics_core::{Engine, effects::RIGID_BODY, robots::A1Free, state::State};
    /// let joints = ElasticJoints { stiffness: [1e4_f32; 18], rotor: [1.0; 18], friction: [5.0; 18] };
    /// let state = State { q: [0.0; 19], qd: [0.0; 18], qdd: [0.0; 18] };
    /// let reference = ElasticReference { state, jerk: [0.0; 18], snap: [0.0; 18] };
    /// let _ = Engine::<A1Free>::elastic_inverse_dynamics(&joints, &reference, &RIGID_BODY);
    /// // error: a joint has several degrees of freedom: no transmission of it is known
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn elastic_inverse_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        joints: &ElasticJoints<R, V>,
        reference: &ElasticReference<R, Q, V>,
        effects: &E,
    ) -> ElasticCommand<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const {
            has_transmissions::<T, B, Q, V>();
            scene_taken::<R, E, B, V>();
        };
        let ElasticReference { state, jerk, snap } = reference;
        let rates = Self::torque_rates(state, jerk, snap, effects);
        let mut command = ElasticCommand::ZERO;
        for (i, tau) in rates.into_iter().enumerate() {
            command.set(i, joints, entry(&state.q, i), reference, tau);
        }
        command
    }
}
