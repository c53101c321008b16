//! The generalised momentum and its drift, what a momentum observer has of the model.

use core::borrow::Borrow;

use super::{MomentumAndCoriolis, momentum_and_coriolis};
use crate::algorithms::rnea;
use crate::effects::{Effect, Resting};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState};

/// The generalised momentum and the part of its rate that neither drives nor contacts cause.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumAndDrift<R: Real, const V: usize> {
    /// The generalised momentum p = M q̇, N·m·s at a revolute joint, N·s at a prismatic one.
    pub p: [R; V],
    /// The drift β = Cᵀ q̇ − g − F, N·m or N.
    pub beta: [R; V],
}

/// The generalised momentum p = M q̇ and its drift β = Cᵀ q̇ − g − F, in joint coordinates, N·m·s
/// and N·m.
///
/// Both arguments of `motion_control::estimate::MomentumObserver::update`, of the whole scene:
///
/// ```text
/// ṗ = τ + β + τ_ext      β = Cᵀ q̇ − g(q) − F(q, q̇)
/// ```
///
/// M and Cᵀ q̇ are those of [`momentum_and_coriolis`], with or without
/// [`Inertia`](crate::effects::Inertia) and [`Coriolis`](crate::effects::Coriolis) in the scene. g
/// has the wrenches of the environment beside gravity, F the torques of friction, springs and other
/// effects at joints. Friction in proportion to the load is no part of β, since a contact loads the
/// gears, too: [`transmitted_torque`](crate::algorithms::transmitted_torque()) takes it from τ.
///
/// # Shape
/// V and V.
///
/// # Cost
/// Those of [`momentum_and_coriolis`] and of [`rnea`](crate::algorithms::rnea()) under gravity
/// alone; less by [`Engine`](crate::Engine), which computes both in one pass.
///
/// # Source
/// De Luca & Mattone (2003); Haddadin, De Luca & Albu-Schäffer, "Robot collisions: a survey"
/// (2017), (43).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{MomentumAndDrift, momentum_and_coriolis, momentum_and_drift, rnea};
/// use dynamics_core::effects::{Gravity, RIGID_BODY, Viscous};
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [0.5, -1.0, 2.0, 0.3, 0.0, 1.0], ..State::at([0.3_f64; 6]) };
/// let friction = Viscous([8.0; 6]);
/// let MomentumAndDrift { p, beta } = momentum_and_drift(&Ur5e::MODEL, &state, &(RIGID_BODY, friction));
/// let parts = momentum_and_coriolis(&Ur5e::MODEL, &state, &());
/// let held = rnea(&Ur5e::MODEL, &state, &(Gravity::EARTH, friction));
/// assert_eq!(p, parts.p);
/// assert!((0..6).all(|i| (beta[i] - (parts.ct_qd[i] - held[i])).abs() < 1e-14));
/// ```
#[doc(alias = "momentum observer")]
#[doc(alias = "generalized momentum")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn momentum_and_drift<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> MomentumAndDrift<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let at = trig.borrow().with(state.state());
    let MomentumAndCoriolis { p, ct_qd: mut beta } = momentum_and_coriolis(robot, at, effects);
    let held = rnea(robot, at, &Resting(effects));
    for (beta, held) in beta.iter_mut().zip(held) {
        *beta -= held;
    }
    MomentumAndDrift { p, beta }
}
