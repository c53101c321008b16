//! Hybrid dynamics: the torque of some coordinates is given, and the acceleration of the others.
//!
//! Featherstone, RBDA (2008), section 9.2: the articulated-body algorithm, in which a coordinate with a prescribed
//! motion is not eliminated. Inverse and forward dynamics are its special cases.

use core::borrow::Borrow;

use super::aba::{JointFactor, sweep};
use super::rotors::with_rotor;
use super::{JointResult, NotPositiveDefinite, Prescribed};
use crate::effects::{
    Declared, Effect, Scene, add_inertia, joint_state, joint_torque, load_friction, rotor_force,
};
use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::{Force, MotionSubspace};
use crate::state::{Configuration, RobotState, State, entry};

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
/// [`NotPositiveDefinite`] names a coordinate with a given torque that moves no inertia, as [`aba`](super::aba()) does.
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
    const {
        assert!(
            E::ACCELERATIONS,
            "forward dynamics needs `Inertia` in the scene"
        )
    };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    sweep(robot, trig, state, effects, |joint| entry(given, joint))
}

/// Pass 2 of a coordinate with a prescribed motion, which stays part of the articulated body: pᴬ + U q̈, U and sᵀ pᴬ.
#[cfg_attr(optimised, inline(always))]
pub(super) fn prescribed_factor<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    s: MotionSubspace<R>,
    u_a: Force<R>,
    qdd: R,
    pa: &mut Force<R>,
) -> JointFactor<R>
where
    E: Effect<R, B, V>,
{
    let (d_inv, u) = (R::ZERO, s.dot(*pa));
    let u_a = with_rotor(effects, link, u_a);
    *pa += u_a * qdd;
    JointFactor { u_a, d_inv, u }
}

/// Pass 3 of a coordinate with a prescribed motion: its torque, from the load Uᵀ a′ + sᵀ U q̈ + sᵀ pᴬ of the articulated body.
#[cfg_attr(optimised, inline(always))]
pub(super) fn prescribed_torque<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    state: &State<R, Q, V>,
    joint: usize,
    s: MotionSubspace<R>,
    load: R,
    qdd: R,
) -> R
where
    E: Effect<R, B, V>,
{
    let (mut tau, mut armature) = (load, R::ZERO);
    if E::GYROSCOPIC_ROTORS {
        tau -= s.dot(rotor_force(effects, link)) * qdd;
    }
    add_inertia(effects, joint, &mut armature);
    tau += armature * qdd + joint_torque(effects, link, state, joint);
    load_friction(effects, joint, joint_state(link, state, joint), &mut tau);
    tau
}
