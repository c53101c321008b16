//! ∂FD/∂q and ∂FD/∂q̇ by the derivatives of inverse dynamics and the factors of M.
//!
//! Carpentier & Mansard, "Analytical derivatives of rigid body dynamics algorithms" (2018),
//! equations (9) and (10).

use core::borrow::Borrow;

use super::Engine;
use crate::algorithms::{AccelerationGradient, NotPositiveDefinite};
use crate::effects::{Bias, Effect};
use crate::model::Robot;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// ∂q̈/∂q and ∂q̈/∂q̇ of forward dynamics q̈ = FD(q, q̇, τ), 1/s² and 1/s between revolute
    /// joints, with q̈ itself and the factors of M for ∂q̈/∂τ = M⁻¹.
    ///
    /// The same as
    /// [`forward_dynamics_derivatives`](crate::algorithms::forward_dynamics_derivatives()).
    /// `state.qdd` is not read.
    ///
    /// # Shape
    /// Two of V × V.
    ///
    /// # Cost
    /// That of [`Engine::rnea`], [`Engine::rnea_derivatives`] and [`Engine::crba`], the factors, and
    /// 2 V + 1 times [`Engine::solve`].
    ///
    /// # Errors
    /// As [`Engine::ltdl`].
    ///
    /// # Source
    /// Carpentier & Mansard (2018), (9) and (10).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, algorithms, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5; 6], ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]) };
    /// let by = Engine::<Ur5e>::forward_dynamics_derivatives(&state, &[0.0; 6], &RIGID_BODY)?;
    /// let same = algorithms::forward_dynamics_derivatives(&Ur5e::MODEL, &state, &[0.0; 6], &RIGID_BODY)?;
    /// assert!((by.dq[1][2] - same.dq[1][2]).abs() < 1e-9);
    /// # Ok::<(), algorithms::NotPositiveDefinite>(())
    /// ```
    #[doc(alias = "computeABADerivatives")]
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
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
        let trig = state.configuration().trig_or(Self::trig_source());
        let (trig, state) = (trig.borrow(), state.state());
        let bias = Self::rnea(trig.with(state), &Bias(effects));
        let factors = Self::ltdl(&Self::crba(trig, effects))?;
        let qdd = Self::solve(&factors, &core::array::from_fn(|i| tau[i] - bias[i]));
        let by = Self::rnea_derivatives(trig.with(&State { qdd, ..*state }), effects);
        Ok(AccelerationGradient::solved(qdd, &by, factors, Self::solve))
    }
}
