//! The algorithms of a robot known at compile time, in their textbook form.

mod kinematics;
mod momentum;
mod operational;

use core::marker::PhantomData;

use crate::algorithms::{self, Cholesky, JointResult, NotPositiveDefinite, Prescribed};
use crate::algorithms::{Ltdl, MassMatrix};
use crate::effects::Effect;
use crate::model::{Robot, Static};
use crate::scalar::Real;
use crate::spatial::Motion;
use crate::state::{JointTrig, State};
use crate::trig::Kernel;

/// The textbook loops over the model of the robot `T`.
///
/// ```
/// use dynamics_core::{Core, effects::RIGID_BODY, robots::Ur5e, state::State};
/// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let tau = Core::<Ur5e>::rnea(&state, &RIGID_BODY);
/// let qdd = Core::<Ur5e>::aba(&state, &tau, &RIGID_BODY)?;
/// assert!(qdd.iter().all(|a| (a - 1.0).abs() < 1e-3));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Core<T>(PhantomData<T>);

impl<T> Core<T> {
    /// The sines and cosines of the configuration q, for every algorithm of a tick.
    pub fn posture<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
    ) -> JointTrig<R, Q>
    where
        T: Robot<B, Q, V>,
    {
        JointTrig::of(&Static::<T>::NEW, q)
    }

    /// τ = ID(q, q̇, q̈), see [`algorithms::rnea`].
    #[inline(never)]
    pub fn rnea<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea(&Static::<T>::NEW, state, effects)
    }

    /// As [`Core::rnea`], sines and cosines by the kernel K.
    #[inline(never)]
    pub fn rnea_by<K, R, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        K: Kernel<R>,
        R: Real,
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        let posture = JointTrig::by::<K, _, B, V>(&Static::<T>::NEW, &state.q);
        algorithms::rnea_at(&Static::<T>::NEW, &posture, state, effects)
    }

    /// As [`Core::rnea`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn rnea_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea_at(&Static::<T>::NEW, posture, state, effects)
    }

    /// q̈ = FD(q, q̇, τ), see [`algorithms::aba`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn aba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::aba(&Static::<T>::NEW, state, tau, effects)
    }

    /// As [`Core::aba`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::aba`].
    #[inline(never)]
    pub fn aba_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::aba_at(&Static::<T>::NEW, posture, state, tau, effects)
    }
    /// q̈ = FD(q, q̇, τ) by M and its factors, see [`algorithms::forward_dynamics`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn forward_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::forward_dynamics(&Static::<T>::NEW, state, tau, effects)
    }

    /// As [`Core::forward_dynamics`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::forward_dynamics`].
    #[inline(never)]
    pub fn forward_dynamics_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::forward_dynamics_at(&Static::<T>::NEW, posture, state, tau, effects)
    }

    /// Torques and accelerations, of each coordinate one given, see [`algorithms::hybrid_dynamics`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint whose torque is given but that moves no inertia.
    #[inline(never)]
    pub fn hybrid_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        given: &[Prescribed<R>; V],
        effects: &E,
    ) -> Result<JointResult<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::hybrid_dynamics(&Static::<T>::NEW, state, given, effects)
    }

    /// As [`Core::hybrid_dynamics`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::hybrid_dynamics`].
    #[inline(never)]
    pub fn hybrid_dynamics_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        given: &[Prescribed<R>; V],
        effects: &E,
    ) -> Result<JointResult<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::hybrid_dynamics_at(&Static::<T>::NEW, posture, state, given, effects)
    }

    /// M(q), see [`algorithms::crba`].
    #[inline(never)]
    pub fn crba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        effects: &E,
    ) -> MassMatrix<R, V>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::crba(&Static::<T>::NEW, q, effects)
    }

    /// As [`Core::crba`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn crba_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        effects: &E,
    ) -> MassMatrix<R, V>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::crba_at(&Static::<T>::NEW, posture, effects)
    }

    /// M(q) and the Jacobian of a body, see [`algorithms::crba_jacobian`].
    #[inline(never)]
    pub fn crba_jacobian<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        body: usize,
        effects: &E,
    ) -> (MassMatrix<R, V>, [Motion<R>; V])
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::crba_jacobian(&Static::<T>::NEW, q, body, effects)
    }

    /// As [`Core::crba_jacobian`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn crba_jacobian_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        body: usize,
        effects: &E,
    ) -> (MassMatrix<R, V>, [Motion<R>; V])
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::crba_jacobian_at(&Static::<T>::NEW, posture, body, effects)
    }

    /// M = Lᵀ D L, see [`algorithms::ltdl`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia, relative to its entry of M.
    #[inline(never)]
    pub fn ltdl<R: Real, const B: usize, const Q: usize, const V: usize>(
        m: &MassMatrix<R, V>,
    ) -> Result<Ltdl<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
    {
        algorithms::ltdl(&Static::<T>::NEW, m)
    }

    /// M = Lᵀ L, see [`algorithms::cholesky`].
    ///
    /// # Errors
    /// As [`Core::ltdl`].
    #[inline(never)]
    pub fn cholesky<R: Real, const B: usize, const Q: usize, const V: usize>(
        m: &MassMatrix<R, V>,
    ) -> Result<Cholesky<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
    {
        algorithms::cholesky(&Static::<T>::NEW, m)
    }

    /// x with M x = τ, see [`algorithms::solve`].
    #[inline(never)]
    pub fn solve<R: Real, const B: usize, const Q: usize, const V: usize>(
        factor: &Ltdl<R, V>,
        tau: &[R; V],
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::solve(&Static::<T>::NEW, factor, tau)
    }

    /// M⁻¹, see [`algorithms::inverse`].
    #[inline(never)]
    pub fn inverse<R: Real, const B: usize, const Q: usize, const V: usize>(
        factor: &Ltdl<R, V>,
    ) -> MassMatrix<R, V>
    where
        T: Robot<B, Q, V>,
    {
        algorithms::inverse(&Static::<T>::NEW, factor)
    }

    /// M = Lᵀ D L without M, see [`algorithms::spatial_operator_ltdl`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn spatial_operator_ltdl<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        effects: &E,
    ) -> Result<Ltdl<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::spatial_operator_ltdl(&Static::<T>::NEW, q, effects)
    }

    /// M⁻¹ without M, see [`algorithms::spatial_operator_inverse`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn spatial_operator_inverse<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        effects: &E,
    ) -> Result<MassMatrix<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::spatial_operator_inverse(&Static::<T>::NEW, q, effects)
    }
}
