//! Hybrid dynamics: the torque of some coordinates is given, and the acceleration of the others.
//!
//! Featherstone, RBDA (2008), section 9.2: the articulated-body algorithm, in which a coordinate
//! with a prescribed motion is not eliminated. Inverse and forward dynamics are its special cases.

use core::borrow::Borrow;

use super::aba::aba;
use super::{JointResult, NotPositiveDefinite, Prescribed};
use crate::effects::{Effect, Scene};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, entry};

/// Torques and accelerations of all coordinates; for each coordinate one of the two is given.
///
/// `state.qdd` is not read.
///
/// # Shape
/// V and V.
///
/// # Cost
/// O(B), at most that of [`aba`](super::aba()).
///
/// # Source
/// Featherstone, RBDA (2008), section 9.2.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{Prescribed::*, hybrid_dynamics};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State::at([0.0_f64, -1.2, 1.5, 0.3, 0.0, 0.0]);
/// // The base is held; the other joints are let go.
/// let given = [Acceleration(0.0), Torque(0.0), Torque(0.0), Torque(0.0), Torque(0.0), Torque(0.0)];
/// let response = hybrid_dynamics(&Ur5e::MODEL, &state, &given, &RIGID_BODY)?;
/// assert!(response.qdd[0] == 0.0 && response.tau[1] == 0.0 && response.qdd[1] > 5.0);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names a coordinate with a given torque that moves no inertia, as
/// [`aba`](super::aba()) does.
#[doc(alias = "HD")]
#[cfg_attr(optimised, inline(always))]
pub fn hybrid_dynamics<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    given: &[Prescribed<R>; V],
    effects: &E,
) -> Result<JointResult<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    aba(robot, trig, state, effects, |joint| entry(given, joint))
}
