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
//! A free joint's S is the unit matrix: its block of M is Iᶜ itself, and the projection on it the
//! whole force.

use core::hint::black_box;

use heapless::Vec;

use super::tree_pass::{Passed, inward};
use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia, body_inertia, rotor_force};
use crate::model::{JointKind, RobotModel};
use crate::scalar::{Real, Vector};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{Force, Xform};
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

    // Nothing borrows it, so that the compiler builds it where the caller wants it, without a copy.
    // The compiler does not know this zero, or it would call `memclr`, which takes three cycles a
    // word on a Cortex-M.
    let zero = black_box(R::ZERO);
    let mut m = MassMatrix { rows: [[zero; V]; V] };
    macro_rules! set {
        ($i:expr, $j:expr, $entry:expr) => {
            if $i < V && $j < V {
                let entry = $entry;
                m.rows[$i][$j] = entry;
                m.rows[$j][$i] = entry;
            }
        };
    }
    // M_ij = M_ji = S_iᵀ f
    macro_rules! project {
        ($link:expr, $joint:expr, $f:expr) => {
            let f: Force<R> = $f;
            match $link.kind() {
                JointKind::Fixed => {}
                JointKind::Free if V >= 6 => {
                    // The bound by which the compiler knows that all six are within M.
                    let first = $link.idx_v().min(V - 6);
                    for (l, entry) in f.components().into_iter().enumerate() {
                        set!($joint, first + l, entry);
                    }
                }
                JointKind::Revolute | JointKind::Continuous => {
                    set!($joint, $link.idx_v(), f.ang.array()[2]);
                }
                _ => {
                    for (l, i) in $link.coordinates().enumerate() {
                        set!($joint, i, $link.unit_subspace(turns, l).dot(f));
                    }
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
            for (joint, column) in link.coordinates().zip(ic.columns()) {
                project!(link, joint, column);
            }
        } else if link.has_several() {
            for (k, joint) in link.coordinates().enumerate() {
                project!(link, joint, ic.along(&link.unit_subspace(turns, k)));
            }
        } else if let Some(joint) = link.coordinates().next() {
            project!(link, joint, ic.along(&link.unit_subspace(turns, 0)));
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
        macro_rules! project_inward {
            ($joint:expr, $f:expr) => {
                let mut f = $f;
                if E::GYROSCOPIC_ROTORS {
                    f += rotor_force(effects, &link);
                }
                let (mut x, mut at) = (&body.x, link.parent);
                while let (Some(parent), Some(link)) = (inner.get(at), robot.link(at)) {
                    f = x.transpose_mul(f);
                    project!(link, $joint, f);
                    (x, at) = (&parent.x, link.parent);
                }
            };
        }
        if link.has_several() {
            for (k, joint) in link.coordinates().enumerate() {
                project_inward!(joint, ic.along(&link.unit_subspace(turns, k)));
            }
        } else if let Some(joint) = link.coordinates().next()
            && joint < V
        {
            // The bound is checked once here, in place of once for each entry.
            project_inward!(joint, ic.along(&link.unit_subspace(turns, 0)));
        }
    }
    m
}
