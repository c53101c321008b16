//! Forward dynamics: M q̈ = τ − C(q, q̇) by bias, M, its factors and their solution, or by
//! articulated bodies ([`Engine::aba`]) where the tree has more ancestors than that pays for.
//!
//! Featherstone, RBDA (2008), section 6.1.

use core::borrow::Borrow;
use core::hint::black_box;
use core::marker::PhantomData;

use super::call::{Call, joint_state};
use super::compile::{Compiled, CompiledRobot};
use super::ltdl::{decompose, substitute};
use super::{Engine, Index, only_if};
use crate::algorithms::MassMatrix;
use crate::algorithms::NotPositiveDefinite;
use crate::effects::{Bias, Declared, Effect, load_friction, transmitted};
use crate::model::Robot;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

/// The operations of M's column and of the solution for each ancestor of a joint, and those that
/// articulated bodies need for a joint beyond those of composite ones: counted on chains of 8 to 20
/// joints.
const OF_ANCESTOR: u32 = 15;
const OF_BODY: u32 = 130;

/// Whether M and its factors need more operations than articulated bodies. A joint with d
/// ancestors takes d (d + 1) of the factors.
const fn is_long(support: &[u64]) -> bool {
    let (mut factors, mut bodies, mut i) = (0, 0, 0);
    while i < support.len() {
        let d = support[i].count_ones() - 1;
        factors += d * (d + 1 + OF_ANCESTOR);
        bodies += OF_BODY;
        i += 1;
    }
    factors > bodies
}

/// A way from torques to accelerations.
type Accelerations<'a, R, T, E, const B: usize, const Q: usize, const V: usize> =
    fn(Call<'a, R, T, E, B, Q, V>, &State<R, Q, V>, &[R; V]) -> Result<[R; V], NotPositiveDefinite>;

impl<T, K> Engine<T, K> {
    /// The acceleration of each joint, q̈ = FD(q, q̇, τ), rad/s² or m/s², under the effects of the
    /// scene.
    ///
    /// By the inertia matrix and its factors, or on trees of long branches, such as a chain of
    /// twelve joints or a humanoid, by articulated bodies as [`Engine::aba`], unless rotors spin as
    /// bodies: the compiler counts the operations. `state.qdd` is not read. A scene without `Inertia` does not compile:
    ///
    /// ```compile_fail
    /// use dynamics_core::{Engine, effects::Gravity, robots::Ur5e, state::State};
    /// let _ = Engine::<Ur5e>::forward_dynamics(&State::at([0.0_f32; 6]), &[0.0; 6], &Gravity::EARTH);
    /// ```
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names the outermost joint that moves no inertia when its descendants
    /// are free (a massless last link without rotor inertia; a joint on the axis of another with no
    /// inertia between them), or whose inertia is NaN: its pivot does not exceed 16 roundings of
    /// the largest inertia that all its descendants, stretched out, could have about it.
    #[doc(alias = "FD")]
    #[inline(never)]
    pub fn forward_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let trig = state.configuration().trig_or(Self::trig_source());
        let call = Call {
            turns: &trig.borrow().coordinates,
            effects,
            robot: PhantomData::<CompiledRobot<T, B, Q, V>>,
        };
        // The way of the arms is called as it is: through a pointer it takes 2 % more cycles.
        if let Some(by_bodies) = const {
            only_if(
                is_long(CompiledRobot::<T, B, Q, V>::SUPPORT) && !E::GYROSCOPIC_ROTORS,
                Call::accelerations_by_bodies as Accelerations<'_, R, _, E, B, Q, V>,
            )
        } {
            by_bodies(call, state.state(), tau)
        } else {
            call.accelerations_by_factors(state.state(), tau)
        }
    }

    /// The torques that the gears transmit while their motors supply `tau`, N·m or N, as
    /// [`crate::algorithms::transmitted_torque`] computes them.
    ///
    /// ```
    /// use dynamics_core::{Engine, effects::{LoadFriction, Width}, robots::Ur5e, state::State};
    /// let gears = LoadFriction { driving: [0.25_f32; 6], backdriving: [0.2; 6], width: Width::new(0.01) };
    /// let moving = State { qd: [0.5; 6], ..State::at([0.0; 6]) };
    /// let [first, ..] = Engine::<Ur5e>::transmitted_torque(&moving, &[5.0; 6], &gears);
    /// assert!((first - 4.0).abs() < 1e-6); // 5 / 1.25
    /// ```
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn transmitted_torque<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        Call::<R, CompiledRobot<T, B, Q, V>, E, B, Q, V>::behind_gears(effects, state, tau)
    }

    /// The torques that the motors must supply where that of all else is `tau`, N·m or N, as
    /// [`crate::algorithms::motor_torque`] computes them.
    ///
    /// ```
    /// use dynamics_core::{Engine, effects::Viscous, robots::Ur5e, state::State};
    /// let moving = State { qd: [0.5_f32; 6], ..State::at([0.0; 6]) };
    /// assert_eq!(Engine::<Ur5e>::motor_torque(&moving, &[5.0; 6], &Viscous([2.0; 6])), [6.0; 6]);
    /// ```
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn motor_torque<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        let mut motors = *tau;
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                let at = joint_state::<R, CompiledRobot<T, B, Q, V>, Q, V, J>(state);
                effects.torque(J, at, &mut motors[J]);
                load_friction(effects, J, at, &mut motors[J]);
            }
        });
        motors
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The torques behind the gears while their motors supply `tau`.
    #[cfg_attr(optimised, inline(always))]
    fn behind_gears(effects: &E, state: &State<R, Q, V>, tau: &[R; V]) -> [R; V] {
        let mut rest = *tau;
        if const { E::LOAD_DEPENDENT } {
            for_each_joint!(J, {
                if Index::<J, V>::IS_BELOW {
                    let at = joint_state::<R, T, Q, V, J>(state);
                    rest[J] = transmitted(effects, J, at, rest[J]);
                }
            });
        }
        rest
    }

    /// C(q, q̇), the torque at q̈ = 0.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn bias(self, state: &State<R, Q, V>) -> [R; V] {
        let unaccelerated =
            Call { turns: self.turns, effects: &Bias(self.effects), robot: self.robot };
        unaccelerated.torques(self.turns, state)
    }

    /// τ − C(q, q̇), the torque that is left to accelerate.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn remaining(self, state: &State<R, Q, V>, tau: &[R; V]) -> [R; V] {
        const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
        let bias = self.bias(state);
        let mut rest = Self::behind_gears(self.effects, state, tau);
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                rest[J] -= bias[J];
            }
        });
        rest
    }

    #[cfg_attr(optimised, inline(always))]
    fn accelerations_by_factors(
        self,
        state: &State<R, Q, V>,
        tau: &[R; V],
    ) -> Result<[R; V], NotPositiveDefinite> {
        // The bias before M: as one block they would need more registers than there are. M and its
        // factors need fewer in one.
        let mut rest = self.remaining(state, tau);
        black_box(&mut rest);
        let mut m = MassMatrix::ZERO;
        self.mass_matrix::<true>(&mut m.rows);
        let noise = self.noise();
        let certain = self.certain();
        let d_inv = decompose::<R, T, V, false>(&mut m.rows, &noise, &certain)?;
        // A copy, since the array that the compiler cannot see through would stay in memory to the
        // end.
        let mut x = rest;
        substitute::<R, T, V, false>(&m.rows, &d_inv, &mut x);
        Ok(x)
    }
}
