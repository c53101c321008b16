//! Regrouping to base parameters: Khalil & Dombre, *Modeling, Identification and Control of Robots*
//! (2002), chapter 9.
//!
//! A rotation about z does not move what lies on z, so that mass m, h_z and Σ_zz of a link go to
//! its parent as a thin rod; Σ = ∫ r rᵀ dm is the second moment. Behind a prismatic joint the whole
//! Σ goes there. τ and M are unchanged; the regrouped internal forces are not the physical ones.
//!
//! Joints of several degrees of freedom, all exactly: of a universal and of a cylindrical joint
//! each step regroups as a joint of its own, over the massless body between them. A screw and a
//! planar joint move the body's origin along or across z, so that only Σ_zz goes to the parent. A
//! spherical joint keeps its centre in the parent, which receives the mass there; h and Σ stay. A
//! free joint passes nothing.
//!
//! The end of a link that bends turns with respect to the link, so that a joint on it passes
//! nothing but a mass at its very end: that is displaced as the end is.

use glam::{DMat3, DVec3};

use super::tree::{Joint, JointMotion, OnEnd};
use crate::math::const_eval::{add, mul, scale, transpose};
use crate::model::BASE;

/// From the last joint to the first, moves the parameters to the parent on which the joint's motion
/// does not depend. For bodies that bend, `ends` has the ends, on which masses are left.
pub(super) const fn regroup<const V: usize>(
    joints: &mut [Joint; V],
    ends: &[Option<DVec3>; V],
    on_ends: &mut [OnEnd; V],
) {
    let mut i = V;
    while i > 0 {
        i -= 1;
        let child = joints[i];
        if i + 1 < child.first + child.count {
            // The body is behind the last coordinate.
            continue;
        }
        // The coordinate that moves the body.
        let by = joints[child.first];
        let end = if by.parent == BASE { None } else { ends[by.parent] };
        let passed = match end {
            None => passed(&mut joints[i], by.motion),
            Some(_) => passed_to_end(&mut joints[i], &by),
        };
        joints[i].second_moment_only = joints[i].second;
        if by.parent != BASE {
            let parent = &mut joints[by.parent];
            let (mut p, h) = (by.pos, scale(by.rot.z_axis, passed.rod));
            if let Some(end) = end {
                p = end;
                on_ends[by.parent].mass += passed.mass;
            }
            let second = mul(&mul(&by.rot, &passed.spread), &transpose(&by.rot));
            let second = mat_add(&second, &mat_add(&outer(p, h), &outer(h, p)));
            let whole = mat_add(&second, &outer(p, scale(p, passed.mass)));
            parent.second = mat_add(&parent.second, &whole);
            parent.moment = add(parent.moment, add(scale(p, passed.mass), h));
            parent.mass += passed.mass;
        } else if matches!(by.motion, JointMotion::Turn | JointMotion::Screw | JointMotion::Planar)
        {
            // A base at rest leaves one rotation, about z, which depends on Σ_xx + Σ_yy alone.
            let sum = child.second.x_axis.x + child.second.y_axis.y;
            let x = DVec3::new(sum, 0.0, 0.0);
            joints[i].second = DMat3::from_cols(x, DVec3::ZERO, DVec3::ZERO);
        }
    }
}

/// The parameters that a parent receives at the joint's origin: a mass, the first moment of a rod
/// along z, and a second moment.
pub(super) struct Transfer {
    pub(super) mass: f64,
    pub(super) rod: f64,
    pub(super) spread: DMat3,
}

impl Transfer {
    const NOTHING: Self = Self { mass: 0.0, rod: 0.0, spread: DMat3::ZERO };
}

/// Takes from a body what the joint that moves it passes to the end of a parent that bends.
const fn passed_to_end(body: &mut Joint, by: &Joint) -> Transfer {
    let mut passed = Transfer::NOTHING;
    let turns = matches!(by.motion, JointMotion::Turn | JointMotion::Spherical);
    if turns && by.pos.x == 0.0 && by.pos.y == 0.0 && by.pos.z == 0.0 {
        passed.mass = body.mass;
        body.mass = 0.0;
    }
    passed
}

/// Takes from a body what its joint passes to the parent.
pub(super) const fn passed(body: &mut Joint, motion: JointMotion) -> Transfer {
    let mut passed = Transfer::NOTHING;
    if matches!(motion, JointMotion::Slide) {
        passed.spread = body.second;
        body.second = DMat3::ZERO;
    }
    if matches!(motion, JointMotion::Turn | JointMotion::Spherical) {
        passed.mass = body.mass;
        body.mass = 0.0;
    }
    if matches!(motion, JointMotion::Turn) {
        passed.rod = body.moment.z;
        body.moment.z = 0.0;
    }
    if matches!(motion, JointMotion::Turn | JointMotion::Screw | JointMotion::Planar) {
        passed.spread.z_axis.z = body.second.z_axis.z;
        body.second.z_axis.z = 0.0;
    }
    passed
}

/// Σ = ½ tr(Ī) 1 − Ī.
pub(super) const fn second_moment(inertia: &DMat3) -> DMat3 {
    let half = 0.5 * (inertia.x_axis.x + inertia.y_axis.y + inertia.z_axis.z);
    DMat3::from_cols(
        add(scale(DVec3::X, half), scale(inertia.x_axis, -1.0)),
        add(scale(DVec3::Y, half), scale(inertia.y_axis, -1.0)),
        add(scale(DVec3::Z, half), scale(inertia.z_axis, -1.0)),
    )
}

/// a bᵀ.
pub(crate) const fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(scale(a, b.x), scale(a, b.y), scale(a, b.z))
}

pub(crate) const fn mat_add(a: &DMat3, b: &DMat3) -> DMat3 {
    DMat3::from_cols(add(a.x_axis, b.x_axis), add(a.y_axis, b.y_axis), add(a.z_axis, b.z_axis))
}
