//! Rotors that spin as bodies, [`crate::effects::GyroscopicRotors`]: their terms in the RNEA.
//!
//! A rotor of ratio ρ is mounted on the parent's side of its joint and spins by ρ q̇ about the
//! joint's axis z. Its angular momentum exceeds that which the parent's inertia includes by ρ I q̇
//! z.

use crate::effects::{Declared, Effect, gyroscopic, rotor_force};
use crate::model::LinkView;
use crate::scalar::Real;
use crate::spatial::{Force, Motion};
use crate::state::{State, entry};

/// The couple that the rotor of a joint exerts on the parent link, in the body's frame, and the
/// torque at the rotor due to the parent's acceleration, ρ I z·α_λ.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotor<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    a_parent: Motion<R>,
    v_i: Motion<R>,
    state: &State<R, Q, V>,
) -> (R::Vec3, R)
where
    E: Effect<R, B, V>,
{
    let rate = |used, rates| {
        if used { entry(rates, link.idx_v()) } else { R::ZERO }
    };
    let qd = rate(E::VELOCITY_PRODUCTS, &state.qd);
    let qdd = rate(E::ACCELERATIONS, &state.qdd);
    let couple = gyroscopic(effects, link, v_i.ang, qd, qdd);
    (couple, a_parent.dot(rotor_force(effects, link)))
}

/// U, and the force of the rotor's spin: mounted on the parent's side of the joint, it rotates with
/// the joint's q̈.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn with_rotor<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    u_a: Force<R>,
) -> Force<R>
where
    E: Effect<R, B, V>,
{
    if E::GYROSCOPIC_ROTORS { u_a + rotor_force(effects, link) } else { u_a }
}
