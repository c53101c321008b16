//! Forward dynamics: M q̈ = τ − C(q, q̇) by bias, M, its factors and their solution.
//!
//! Walker & Orin (1982), method 3; Featherstone, RBDA (2008), section 6.1. The articulated-body
//! algorithm gives the same without M.

use core::borrow::Borrow;

use super::{NotPositiveDefinite, crba, ltdl, rnea, solve};
use crate::effects::{Bias, Effect, Scene, all_transmitted};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState};

/// The acceleration of each joint, q̈ = FD(q, q̇, τ), rad/s² or m/s², by M and its factors.
///
/// [`aba`](super::aba()) gives the same without M. `state.qdd` is not read. In f32 the
/// accelerations of long chains and of light links with heavy loads lose digits:
/// [`forward_dynamics_with_error`](super::forward_dynamics_with_error()) says how many.
///
/// ```text
/// M(q) q̈ = τ − C(q, q̇)      C(q, q̇) = ID(q, q̇, 0)
/// ```
///
/// # Shape
/// V.
///
/// # Cost
/// The cost of [`rnea`](super::rnea()), [`crba`](super::crba()), [`ltdl`] and [`solve`]: O(V³) on a
/// chain, with a small factor.
///
/// # Source
/// Walker & Orin (1982), method 3.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::{aba, forward_dynamics}, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State::at([0.0_f64, -1.2, 1.5, 0.3, 0.0, 0.0]);
/// let by_matrix = forward_dynamics(&Ur5e::MODEL, &state, &[0.0; 6], &RIGID_BODY)?;
/// let by_bodies = aba(&Ur5e::MODEL, &state, &[0.0; 6], &RIGID_BODY)?;
/// assert!(by_matrix.iter().zip(by_bodies).all(|(a, b)| (a - b).abs() < 1e-9));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`ltdl`].
#[doc(alias = "forward_dynamics_crba")]
#[doc(alias = "FDcrb")]
#[cfg_attr(optimised, inline(always))]
pub fn forward_dynamics<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
    let bias = rnea(robot, trig.with(state), &Bias(effects));
    let mut rest = all_transmitted(robot, state, effects, tau);
    for (rest, bias) in rest.iter_mut().zip(bias) {
        *rest -= bias;
    }
    let factors = ltdl(robot, &crba(robot, trig, effects))?;
    Ok(solve(robot, &factors, &rest))
}
