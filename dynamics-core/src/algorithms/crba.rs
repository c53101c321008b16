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

use super::tree_pass::{Passed, inward};
use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia, body_inertia, rotor_force};
use crate::model::{JointKind, RobotModel};
use crate::scalar::Real;
use crate::spatial::Xform;
use crate::spatial::inertia::CompositeInertia;
use crate::state::JointTrig;

/// The results of the outward pass for the inward one.
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
        let ic = body_inertia(effects, i, &link).into();
        let x = link.xform(turns);
        let _ = bodies.push(Body { x, ic });
    }

    // Without a reference to it, the compiler builds M where the caller wants it.
    let mut m = MassMatrix::ZERO;
    // M_ij = M_ji = S_iᵀ f for the coordinates i of a link.
    macro_rules! project {
        ($joint:expr, $link:expr, $f:expr) => {
            if $link.kind() == JointKind::Free {
                let first = $link.idx_v().min(V.saturating_sub(6));
                if V >= 6 && $joint < V {
                    for (l, entry) in $f.components().into_iter().enumerate() {
                        m.rows[$joint][first + l] = entry;
                        m.rows[first + l][$joint] = entry;
                    }
                }
            } else if $link.has_several() {
                for (l, i) in $link.coordinates().enumerate() {
                    if $joint < V && i < V {
                        let entry = $link.subspace(turns, l).dot($f);
                        m.rows[$joint][i] = entry;
                        m.rows[i][$joint] = entry;
                    }
                }
            } else if let Some(i) = $link.coordinates().next() {
                if $joint < V && i < V {
                    let entry = $link.subspace(turns, 0).dot($f);
                    m.rows[$joint][i] = entry;
                    m.rows[i][$joint] = entry;
                }
            }
        };
    }
    let mut pass = inward(&mut bodies);
    let mut passed = Passed::NONE;
    while let Some((body, inner)) = pass.next() {
        let i = inner.len();
        let Some(link) = robot.link(i) else {
            break;
        };
        let ic = passed.onto(&body.ic);
        // M_ii = S_iᵀ Iᶜ_i S_i
        if link.kind() == JointKind::Free {
            let first = link.idx_v().min(V.saturating_sub(6));
            if V >= 6 {
                for (k, column) in ic.columns().into_iter().enumerate() {
                    for (l, value) in column.components().into_iter().enumerate() {
                        m.rows[first + k][first + l] = value;
                    }
                }
            }
        } else if link.has_several() {
            for (k, joint) in link.coordinates().enumerate() {
                project!(joint, link, ic.along(&link.subspace(turns, k)));
            }
        } else if let Some(joint) = link.coordinates().next() {
            project!(joint, link, ic.along(&link.subspace(turns, 0)));
        }
        for joint in link.coordinates() {
            if joint < V {
                let mut diagonal = m.rows[joint][joint];
                add_inertia(effects, joint, &mut diagonal);
                m.rows[joint][joint] = diagonal;
            }
        }
        let Some(parent) = inner.get_mut(link.parent) else {
            continue;
        };
        passed.add(&link, i, &mut parent.ic, ic.at_parent(&body.x));
        macro_rules! ancestors {
            ($joint:expr, $f:expr) => {
                let mut f = $f;
                if E::GYROSCOPIC_ROTORS {
                    f += rotor_force(effects, &link);
                }
                let (mut x, mut at) = (&body.x, link.parent);
                while let (Some(parent), Some(link)) = (inner.get(at), robot.link(at)) {
                    f = x.transpose_mul(f);
                    project!($joint, link, f);
                    (x, at) = (&parent.x, link.parent);
                }
            };
        }
        if link.has_several() {
            for (k, joint) in link.coordinates().enumerate() {
                ancestors!(joint, ic.along(&link.subspace(turns, k)));
            }
        } else if let Some(joint) = link.coordinates().next() {
            ancestors!(joint, ic.along(&link.subspace(turns, 0)));
        }
    }
    m
}
