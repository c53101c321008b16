//! Regrouping to base parameters: Khalil & Dombre, *Modeling, Identification and Control of Robots* (2002), chapter 9.
//!
//! A rotation about z does not move what lies on z, so that mass m, h_z and Σ_zz of a link go to its parent as a thin rod;
//! Σ = ∫ r rᵀ dm is the second moment. Behind a prismatic joint the whole Σ goes there. τ and M are unchanged; the
//! regrouped internal forces are not the physical ones.

use glam::{DMat3, DVec3};

use super::tree::Joint;
use crate::math::const_eval::{add, mul, scale, transpose};
use crate::model::BASE;

/// From the last joint to the first, moves the parameters to the parent on which the joint's motion does not depend.
pub(super) const fn regroup<const V: usize>(joints: &mut [Joint; V]) {
    let mut i = V;
    while i > 0 {
        i -= 1;
        let child = joints[i];
        let (mut mass, mut rod_h, mut spread) = (0.0, 0.0, child.second);
        if child.prismatic {
            joints[i].second = DMat3::ZERO;
        } else {
            (mass, rod_h) = (child.mass, child.moment.z);
            let zz = child.second.z_axis.z;
            spread = DMat3::from_cols(DVec3::ZERO, DVec3::ZERO, DVec3::new(0.0, 0.0, zz));
            joints[i].mass = 0.0;
            joints[i].moment = DVec3::new(child.moment.x, child.moment.y, 0.0);
            let (x, y, z) = (
                child.second.x_axis,
                child.second.y_axis,
                child.second.z_axis,
            );
            joints[i].second = DMat3::from_cols(x, y, DVec3::new(z.x, z.y, 0.0));
        }
        joints[i].second_moment_only = joints[i].second;
        if child.parent != BASE {
            let parent = &mut joints[child.parent];
            let (p, h) = (child.pos, scale(child.rot.z_axis, rod_h));
            let second = mul(&mul(&child.rot, &spread), &transpose(&child.rot));
            let second = mat_add(&second, &mat_add(&outer(p, h), &outer(h, p)));
            parent.second = mat_add(&parent.second, &mat_add(&second, &outer(p, scale(p, mass))));
            parent.moment = add(parent.moment, add(scale(p, mass), h));
            parent.mass += mass;
        } else if !child.prismatic {
            // A base at rest leaves one rotation, about z, which depends on Σ_xx + Σ_yy alone.
            let sum = child.second.x_axis.x + child.second.y_axis.y;
            let x = DVec3::new(sum, 0.0, 0.0);
            joints[i].second = DMat3::from_cols(x, DVec3::ZERO, DVec3::ZERO);
        }
    }
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

pub(super) const fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(scale(a, b.x), scale(a, b.y), scale(a, b.z))
}

pub(super) const fn mat_add(a: &DMat3, b: &DMat3) -> DMat3 {
    DMat3::from_cols(
        add(a.x_axis, b.x_axis),
        add(a.y_axis, b.y_axis),
        add(a.z_axis, b.z_axis),
    )
}
