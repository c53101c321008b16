//! ∂FD/∂q, ∂FD/∂q̇ and ∂FD/∂τ = M⁻¹, by the derivatives of inverse dynamics and the factors of M.
//!
//! Carpentier & Mansard, "Analytical derivatives of rigid body dynamics algorithms" (2018),
//! equations (9) and (10): ID(q, q̇, FD(q, q̇, τ)) = τ, differentiated.

use core::borrow::Borrow;

use super::{TorqueGradient, rnea_derivatives};
use crate::algorithms::{Ltdl, NotPositiveDefinite, crba, ltdl, rnea, solve};
use crate::effects::{Bias, Effect};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};

/// The derivatives of forward dynamics at a state and torque, by rows of q̈.
#[derive(Clone, Debug)]
pub struct AccelerationGradient<R, const V: usize> {
    /// q̈ itself, rad/s² or m/s².
    pub qdd: [R; V],
    /// ∂q̈/∂q, 1/s² between revolute joints.
    pub dq: [[R; V]; V],
    /// ∂q̈/∂q̇, 1/s between revolute joints.
    pub dqd: [[R; V]; V],
    /// The factors of M; ∂q̈/∂τ is M⁻¹, whose columns [`solve`] gives.
    pub factors: Ltdl<R, V>,
}

/// ∂q̈/∂q and ∂q̈/∂q̇ of forward dynamics q̈ = FD(q, q̇, τ), and the factors of M for ∂q̈/∂τ = M⁻¹.
///
/// ```text
/// ∂FD/∂q = −M⁻¹ ∂ID/∂q      ∂FD/∂q̇ = −M⁻¹ ∂ID/∂q̇      at q̈ = FD(q, q̇, τ)
/// ```
///
/// The derivative with respect to q is along
/// [`integrate`](crate::state::manifold::integrate()), and the effects are those of
/// [`rnea_derivatives`]. `state.qdd` is not read.
///
/// # Shape
/// V × V each, not symmetric.
///
/// # Cost
/// The cost of [`rnea_derivatives`], of [`crba`](crate::algorithms::crba()) and its factors, and 4 V³
/// flops on a chain.
///
/// # Source
/// Carpentier & Mansard (2018).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{aba, forward_dynamics_derivatives};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let mut state = State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]);
/// let by = forward_dynamics_derivatives(&Ur5e::MODEL, &state, &[0.0; 6], &RIGID_BODY)?;
/// state.q[1] += 1e-6;
/// let after = aba(&Ur5e::MODEL, &state, &[0.0; 6], &RIGID_BODY)?;
/// for (row, (a, b)) in by.dq.iter().zip(after.iter().zip(by.qdd)) {
///     assert!(((a - b) / 1e-6 - row[1]).abs() < 1e-2);
/// }
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`ltdl`].
#[doc(alias = "computeABADerivatives")]
#[doc(alias = "forward dynamics derivatives")]
#[cfg_attr(optimised, inline(always))]
pub fn forward_dynamics_derivatives<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<AccelerationGradient<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let bias = rnea(robot, trig.with(state), &Bias(effects));
    let factors = ltdl(robot, &crba(robot, trig, effects))?;
    let mut rest = *tau;
    for (rest, bias) in rest.iter_mut().zip(bias) {
        *rest -= bias;
    }
    let qdd = solve(robot, &factors, &rest);
    let by = rnea_derivatives(robot, trig.with(&State { qdd, ..*state }), effects);
    Ok(AccelerationGradient::solved(qdd, &by, factors, |factors, tau| solve(robot, factors, tau)))
}

impl<R: Real, const V: usize> AccelerationGradient<R, V> {
    /// −M⁻¹ ∂ID, column by column.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn solved(
        qdd: [R; V],
        by: &TorqueGradient<R, V>,
        factors: Ltdl<R, V>,
        solve: impl Fn(&Ltdl<R, V>, &[R; V]) -> [R; V],
    ) -> Self {
        let [dq, dqd] = [&by.dq, &by.dqd].map(|by| {
            let mut columns = transposed(by);
            for column in &mut columns {
                *column = solve(&factors, &column.map(|x| -x));
            }
            transposed(&columns)
        });
        Self { qdd, dq, dqd, factors }
    }
}

fn transposed<R: Real, const V: usize>(rows: &[[R; V]; V]) -> [[R; V]; V] {
    let mut columns = [[R::ZERO; V]; V];
    for (i, row) in rows.iter().enumerate() {
        for (column, &value) in columns.iter_mut().zip(row) {
            if let Some(entry) = column.get_mut(i) {
                *entry = value;
            }
        }
    }
    columns
}
