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

use super::tree_pass::{Passed, inward, recalled};
use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia, body_inertia, rotor_force};
use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::Xform;
use crate::spatial::inertia::CompositeInertia;
use crate::state::JointTrig;

/// The results of the outward pass for the inward one.
struct Body<'a, R: Real> {
    link: LinkView<'a, R>,
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
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    for i in 0..B {
        let Some(link) = robot.link(i) else {
            break;
        };
        let ic = body_inertia(effects, i, &link).into();
        let x = link.xform(turns);
        let _ = bodies.push(Body { link, x, ic });
    }

    let mut m = MassMatrix::ZERO;
    let mut pass = inward(&mut bodies);
    let mut passed = Passed::NONE;
    while let Some((body, inner)) = pass.next() {
        let link = recalled(robot, &body.link);
        let ic = passed.onto(&body.ic);
        let i = inner.len();
        if let Some(parent) = inner.get_mut(body.link.parent) {
            passed.add(&body.link, i, &mut parent.ic, ic.at_parent(&body.x));
        }
        for (k, joint) in link.coordinates().enumerate() {
            let mut f = ic.along(&link.subspace(turns, k));
            for (l, earlier) in link.coordinates().enumerate().take(k + 1) {
                m.set(joint, earlier, link.subspace(turns, l).dot(f));
            }
            if let Some(diagonal) = m.diagonal_mut(joint) {
                add_inertia(effects, joint, diagonal);
            }
            if E::GYROSCOPIC_ROTORS {
                f += rotor_force(effects, &body.link);
            }
            let mut child = &*body;
            while let Some(parent) = inner.get(child.link.parent) {
                f = child.x.transpose_mul(f);
                let link = recalled(robot, &parent.link);
                for (l, ancestor) in link.coordinates().enumerate() {
                    m.set(joint, ancestor, link.subspace(turns, l).dot(f));
                }
                child = parent;
            }
        }
    }
    m
}
