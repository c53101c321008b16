//! The derivatives of inverse and of forward dynamics.

use dynamics_core::algorithms::{self, TorqueGradient};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use super::factors::put_inverse;
use super::*;
use crate::scene::Differentiable;

/// ∂ID/∂q and ∂ID/∂q̇.
#[inline(never)]
fn gradient<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    parts: &Parts<R, V>,
) -> TorqueGradient<R, V>
where
    D: RobotModel<R, B, Q, V>,
{
    algorithms::rnea_derivatives(robot, state, &Differentiable::<R, V, true>(parts))
}

algorithm! {
    /// ∂τ/∂q and ∂τ/∂q̇ of q, q̇ and q̈.
    RneaDerivatives, machine, |this, robot, counts, scene, row| {
        let by = gradient(robot, &state(row, counts, 3), parts_of(scene));
        put_rows(row, 0, &by.dq[..counts.v], counts.v);
        put_rows(row, 1, &by.dqd[..counts.v], counts.v);
    }
}

algorithm! {
    /// ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ of q, q̇ and τ: −M⁻¹ ∂ID/∂q, −M⁻¹ ∂ID/∂q̇ and M⁻¹.
    ForwardDynamicsDerivatives, factored, |this, robot, counts, scene, row| {
        let (mut state, tau) = (state(row, counts, 2), filled::<R, V>(row, 2, counts.v));
        let parts = parts_of(scene);
        let bias = bias::<R, D, B, Q, V, C, X>(robot, &state, (parts, false));
        let factors = factors::<R, D, B, Q, V, X>(robot, &state.q, parts, counts)?;
        let rest = std::array::from_fn(|i| tau[i] - bias[i]);
        state.qdd = algorithms::solve(robot, &factors, &rest);
        let by = gradient(robot, &state, parts);
        for (output, rows) in [by.dq, by.dqd].iter().enumerate() {
            for j in 0..counts.v {
                let column = algorithms::solve(robot, &factors, &rows.map(|row| -row[j]));
                for (i, &x) in column.iter().enumerate().take(counts.v) {
                    row.put(output, i * counts.v + j, x);
                }
            }
        }
        put_inverse(robot, &factors, (row, 2), counts);
    }
}
