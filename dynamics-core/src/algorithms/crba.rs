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
        } else {
            for (k, joint) in link.coordinates().take(const { D::KINDS.most_but_free() }).enumerate() {
                let f = ic.along(&link.subspace(turns, k));
                project!(m, joint, link, turns, f);
            }
        }
        for joint in link.coordinates() {
            let mut armature = entry!(m, joint, joint);
            add_inertia(effects, joint, &mut armature);
            set!(m, joint, joint, armature);
        }
        let Some(parent) = inner.get_mut(link.parent) else {
            continue;
        };
        passed.add(&link, i, &mut parent.ic, ic.at_parent(&body.x));
        for (k, joint) in link.coordinates().take(const { D::KINDS.most() }).enumerate() {
            let mut f = ic.along(&link.subspace(turns, k));
            if E::GYROSCOPIC_ROTORS {
                f += rotor_force(effects, &link);
            }
            let (mut x, mut at) = (&body.x, link.parent);
            while let (Some(parent), Some(link)) = (inner.get(at), robot.link(at)) {
                f = x.transpose_mul(f);
                project!(m, joint, link, turns, f);
                (x, at) = (&parent.x, link.parent);
            }
        }
    }
    m
}

macro_rules! set {
    ($m:ident, $i:expr, $j:expr, $value:expr) => {
        if $i < V && $j < V {
            $m.rows[$i][$j] = $value;
            $m.rows[$j][$i] = $value;
        }
    };
}
use set;
macro_rules! entry {
    ($m:ident, $i:expr, $j:expr) => {
        if $i < V && $j < V { $m.rows[$i][$j] } else { R::ZERO }
    };
}
use entry;

/// M_ij = S_iᵀ f
macro_rules! project {
    ($m:ident, $joint:ident, $link:ident, $turns:ident, $f:ident) => {
        if $link.kind() == JointKind::Free {
            let first = $link.idx_v().min(V.saturating_sub(6));
            if V >= 6 && $joint < V {
                for (l, value) in $f.components().into_iter().enumerate() {
                    $m.rows[$joint][first + l] = value;
                    $m.rows[first + l][$joint] = value;
                }
            }
        } else {
            for (l, i) in $link.coordinates().take(const { D::KINDS.most_but_free() }).enumerate() {
                let value = $link.subspace($turns, l).dot($f);
                set!($m, $joint, i, value);
            }
        }
    };
}
use project;
