//! A coordinate whose acceleration is given, in the passes of [`aba`](super::aba()).
//!
//! Featherstone, RBDA (2008), section 9.2: it is not eliminated.

use super::rotors::with_rotor;
use crate::effects::{
    Declared, Effect, add_inertia, joint_state, joint_torque, load_friction, rotor_force,
};
use crate::model::LinkView;
use crate::scalar::Real;
use crate::spatial::{Force, MotionSubspace};
use crate::state::State;

/// The results of the inward pass for a coordinate: U, 1/D and u; for a prescribed motion, only U
/// and sᵀ pᴬ.
#[derive(Clone, Copy)]
pub(crate) struct JointFactor<R: Real> {
    pub(crate) u_a: Force<R>,
    pub(crate) d_inv: R,
    pub(crate) u: R,
}

/// Pass 2 of a coordinate with a prescribed motion, which stays part of the articulated body: pᴬ +
/// U q̈, U and sᵀ pᴬ.
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

/// Pass 3 of a coordinate with a prescribed motion: its torque, from the load Uᵀ a′ + sᵀ U q̈ + sᵀ
/// pᴬ of the articulated body.
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
