//! [`Core`]: the reference implementation of the algorithms, for a robot known at compile time.

mod regressor;
mod scene;

use core::marker::PhantomData;

use crate::algorithms::{
    self, AccelerationGradient, Frame, JointResult, Kinematics, Ltdl, MassMatrix,
};
use crate::algorithms::{
    MomentumAndCoriolis, MomentumAndDrift, NotPositiveDefinite, OsimInverse, Pose, Prescribed,
    TorqueGradient, TorquesAndWrenches,
};
use crate::effects::{Effect, Scene};
use crate::model::{BodyNumber, RobotModel, Static};
use crate::scalar::{Native, Real};
use crate::spatial::{Force, Motion};
use crate::state::{Configuration, JointTrig, RobotState};

/// The textbook algorithms for the robot `T`; sines and cosines by the kernel `K`.
///
/// Each function is that of [`crate::algorithms`] for [`Static<T, K>`](Static), compiled once and
/// never inlined; call those that are not listed here with `&Static::<T>::NEW`.
///
/// ```
/// use dynamics_core::{Core, algorithms, effects::RIGID_BODY, model::Static, robots::Ur5e, state::State};
/// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let tau = Core::<Ur5e>::rnea(&state, &RIGID_BODY);
/// let qdd = Core::<Ur5e>::aba(&state, &tau, &RIGID_BODY)?;
/// assert!(qdd.iter().all(|a| (a - 1.0).abs() < 1e-3));
/// assert!(algorithms::center_of_mass(&Static::<Ur5e>::NEW, &state, &()).mass > 16.0); // kg
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Core<T, K = Native>(PhantomData<(T, K)>);

impl<T, K> Core<T, K> {
    /// The sines and cosines of the configuration q, for every algorithm of a tick.
    #[must_use]
    pub fn joint_trig<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
    ) -> JointTrig<R, Q>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
    {
        JointTrig::new(&Static::<T, K>::NEW, q)
    }

    /// τ = ID(q, q̇, q̈): the torque of each motor, see [`algorithms::rnea()`].
    #[inline(never)]
    pub fn rnea<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::rnea(&Static::<T, K>::NEW, state, effects)
    }

    /// The torque of each motor and the wrench in the joint of each body, see
    /// [`algorithms::rnea_and_wrenches`].
    #[inline(never)]
    pub fn rnea_and_wrenches<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> TorquesAndWrenches<R, V, B>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea_and_wrenches(&Static::<T, K>::NEW, state, effects)
    }

    /// q̈ = FD(q, q̇, τ): the acceleration of each joint, see [`algorithms::aba()`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn aba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::aba(&Static::<T, K>::NEW, state, tau, effects)
    }

    /// q̈ = FD(q, q̇, τ) by M and its factors, see [`algorithms::forward_dynamics`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn forward_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::forward_dynamics(&Static::<T, K>::NEW, state, tau, effects)
    }

    /// ∂τ/∂q and ∂τ/∂q̇ of inverse dynamics, see [`algorithms::rnea_derivatives()`].
    #[inline(never)]
    #[must_use]
    pub fn rnea_derivatives<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> TorqueGradient<R, V>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea_derivatives(&Static::<T, K>::NEW, state, effects)
    }

    /// (∂τ/∂q) δq + (∂τ/∂q̇) δq̇ without the matrices, see [`algorithms::rnea_along`].
    #[inline(never)]
    #[must_use]
    pub fn rnea_along<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        dq: &[R; V],
        dqd: &[R; V],
        effects: &E,
    ) -> [R; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea_along(&Static::<T, K>::NEW, state, dq, dqd, effects)
    }

    /// xᵀ ∂τ/∂q and xᵀ ∂τ/∂q̇ without the matrices, see [`algorithms::rnea_transposed`].
    #[inline(never)]
    #[must_use]
    pub fn rnea_transposed<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        x: &[R; V],
        effects: &E,
    ) -> [[R; V]; 2]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea_transposed(&Static::<T, K>::NEW, state, x, effects)
    }

    /// ∂q̈/∂q and ∂q̈/∂q̇ of forward dynamics, and the factors of M, see
    /// [`algorithms::forward_dynamics_derivatives`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn forward_dynamics_derivatives<
        R: Real,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        state: impl RobotState<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<AccelerationGradient<R, V>, NotPositiveDefinite>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::forward_dynamics_derivatives(&Static::<T, K>::NEW, state, tau, effects)
    }

    /// Torques and accelerations, one of them given for each joint, see
    /// [`algorithms::hybrid_dynamics`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint of given torque that moves no inertia.
    #[inline(never)]
    pub fn hybrid_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        given: &[Prescribed<R>; V],
        effects: &E,
    ) -> Result<JointResult<R, V>, NotPositiveDefinite>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::hybrid_dynamics(&Static::<T, K>::NEW, state, given, effects)
    }

    /// M(q): the joint-space inertia matrix, see [`algorithms::crba()`].
    #[inline(never)]
    pub fn crba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        effects: &E,
    ) -> MassMatrix<R, V>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::crba(&Static::<T, K>::NEW, q, effects)
    }

    /// The factors of M = Lᵀ D L, see [`algorithms::ltdl`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn ltdl<R: Real, const B: usize, const Q: usize, const V: usize>(
        m: &MassMatrix<R, V>,
    ) -> Result<Ltdl<R, V>, NotPositiveDefinite>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
    {
        algorithms::ltdl(&Static::<T, K>::NEW, m)
    }

    /// x with M x = τ, see [`algorithms::solve`].
    #[inline(never)]
    pub fn solve<R: Real, const B: usize, const Q: usize, const V: usize>(
        factor: &Ltdl<R, V>,
        tau: &[R; V],
    ) -> [R; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
    {
        algorithms::solve(&Static::<T, K>::NEW, factor, tau)
    }

    /// The pose of every body's own frame, see [`algorithms::poses`].
    #[inline(never)]
    pub fn poses<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
    ) -> [Pose<R>; B]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
    {
        algorithms::poses(&Static::<T, K>::NEW, q)
    }

    /// Pose, velocity and acceleration of every body, see [`algorithms::kinematics()`].
    #[inline(never)]
    pub fn kinematics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> Kinematics<R, B>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::kinematics(&Static::<T, K>::NEW, state, effects)
    }

    /// J of a body with v = J q̇, by columns, see [`algorithms::jacobian`].
    #[inline(never)]
    pub fn jacobian<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        body: impl BodyNumber,
        frame: F,
    ) -> [Motion<R>; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
    {
        algorithms::jacobian(&Static::<T, K>::NEW, q, body.number(), frame)
    }

    /// J̇ q̇ of a body, see [`algorithms::bias_acceleration`].
    #[inline(never)]
    pub fn bias_acceleration<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        body: impl BodyNumber,
        frame: F,
    ) -> Motion<R>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
    {
        algorithms::bias_acceleration(&Static::<T, K>::NEW, state, body.number(), frame)
    }

    /// Λ⁻¹ of a body, see [`algorithms::osim_inverse`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn osim_inverse<R: Real, E, F: Frame, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        body: impl BodyNumber,
        frame: F,
        effects: &E,
    ) -> Result<OsimInverse<R>, NotPositiveDefinite>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::osim_inverse(&Static::<T, K>::NEW, q, body.number(), frame, effects)
    }

    /// q̇ with the base's rates for which the momentum of all bodies is h, see
    /// [`algorithms::base_velocity_from_momentum`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names the first coordinate of bodies without mass or inertia.
    #[inline(never)]
    pub fn base_velocity_from_momentum<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        h: Force<R>,
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::base_velocity_from_momentum(&Static::<T, K>::NEW, state, h, effects)
    }

    /// p = M q̇ and Cᵀ q̇, see [`algorithms::momentum_and_coriolis`].
    #[inline(never)]
    pub fn momentum_and_coriolis<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> MomentumAndCoriolis<R, V>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::momentum_and_coriolis(&Static::<T, K>::NEW, state, effects)
    }

    /// p = M q̇ and β = Cᵀ q̇ − g − F, see [`algorithms::momentum_and_drift`].
    #[inline(never)]
    pub fn momentum_and_drift<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> MomentumAndDrift<R, V>
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::momentum_and_drift(&Static::<T, K>::NEW, state, effects)
    }

    /// C(q, q̇), see [`algorithms::coriolis_matrix`].
    #[inline(never)]
    pub fn coriolis_matrix<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> [[R; V]; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::coriolis_matrix(&Static::<T, K>::NEW, state, effects)
    }

    /// M q̈_r + C(q, q̇) q̇_r + g + F, see [`algorithms::rnea_two_velocities`].
    #[inline(never)]
    pub fn rnea_two_velocities<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        qd_r: &[R; V],
        effects: &E,
    ) -> [R; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::rnea_two_velocities(&Static::<T, K>::NEW, state, qd_r, effects)
    }

    /// The kinetic energy T, J, see [`algorithms::kinetic_energy`].
    #[inline(never)]
    pub fn kinetic_energy<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> R
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::kinetic_energy(&Static::<T, K>::NEW, state, effects)
    }

    /// The potential energy U, J, see [`algorithms::potential_energy`].
    #[inline(never)]
    pub fn potential_energy<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        effects: &E,
    ) -> R
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::potential_energy(&Static::<T, K>::NEW, q, effects)
    }
}
