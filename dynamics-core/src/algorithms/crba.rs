//! The joint-space inertia matrix: the composite-rigid-body algorithm in link coordinates.
//!
//! Walker & Orin (1982); Featherstone & Orin (2000), section 3.3; RBDA (2008), table 6.2:
//!
//! ```text
//! Iᶜ_i = I_i + Σ_{λ(j)=i} ʲX_iᵀ Iᶜ_j ʲX_i      M_ij = M_ji = S_iᵀ ʲX_iᵀ Iᶜ_j S_j
//! ```
//!
//! Composite inertias are accumulated from the tips to the base; column j of M is the force of a unit
//! acceleration of joint j on its composite body, projected on every joint between it and the base.

use heapless::Vec;

use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia, body_inertia, rotor_force};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::spatial::Xform;
use crate::spatial::inertia::CompositeInertia;
use crate::state::JointTrig;

/// The transform ⁱX_λ(i) of a body, and Iᶜ of it and of those of its descendants that were visited.
#[derive(Clone, Copy)]
struct Body<R: Real> {
    x: Xform<R>,
    ic: CompositeInertia<R>,
}

/// M by the two passes.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn crba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let (x, ic) = (link.xform(turns), body_inertia(effects, i, &link).into());
        let _ = bodies.push(Body { x, ic });
    }
    let mut m = MassMatrix::ZERO;
    for link in robot.links().rev() {
        let Some(Body { x, ic }) = bodies.pop() else {
            break;
        };
        if let Some(parent) = bodies.get_mut(link.parent) {
            parent.ic += ic.at_parent(&x);
        }
        for (k, j) in link.coordinates().enumerate() {
            let mut f = ic.along(&link.subspace(turns, k));
            for (l, i) in link.coordinates().enumerate().take(k + 1) {
                m.set(i, j, link.subspace(turns, l).dot(f));
            }
            if let Some(diagonal) = m.diagonal_mut(j) {
                add_inertia(effects, j, diagonal);
            }
            if E::GYROSCOPIC_ROTORS {
                f += rotor_force(effects, &link);
            }
            let (mut x, mut at) = (x, link.parent);
            while let (Some(parent), Some(ancestor)) = (bodies.get(at), robot.link(at)) {
                f = x.transpose_mul(f);
                for (l, i) in ancestor.coordinates().enumerate() {
                    m.set(i, j, ancestor.subspace(turns, l).dot(f));
                }
                (x, at) = (parent.x, ancestor.parent);
            }
        }
    }
    m
}
