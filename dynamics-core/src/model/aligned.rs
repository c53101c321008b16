//! A body of the description in its aligned frame, in which the joint's axis is z.

use glam::{DMat3, DVec3};

use super::{BASE, Body, Link};
use crate::math::const_eval::{add, dot, mul, mul_vec, scale, transpose, vec3};
use crate::spatial::{SpatialInertia, Xform};

/// The body in its aligned frame, after those of `links` before it; its coordinates are not set.
pub(super) const fn aligned<const B: usize>(body: &Body, links: &[Link<f64>; B]) -> Link<f64> {
    let joint = body.joint.normalised();
    let frame = joint.frame();
    let parent =
        if body.parent == BASE { DMat3::IDENTITY } else { links[body.parent].to_joint_frame };
    let rot = mul(&mul(&frame, &transpose(&body.rotation)), &transpose(&parent));
    let pos = mul_vec(&parent, vec3(body.position));
    let inertia = at_origin(body);
    Link {
        name: body.name,
        parent: body.parent,
        joint,
        to_joint_frame: frame,
        placement: Xform { rot, pos },
        inertia: SpatialInertia {
            mass: inertia.mass,
            first_moment: mul_vec(&frame, inertia.first_moment),
            rotational: mul(&mul(&frame, &inertia.rotational), &transpose(&frame)),
        },
        idx_q: BASE,
        idx_v: BASE,
        limits: body.limits,
    }
}

/// Whether the numbers computed from a description are finite: numbers of 10¹⁵⁴ have squares that
/// are not.
pub(super) const fn is_finite(link: &Link<f64>) -> bool {
    // x·0 is 0 for finite x and NaN otherwise; a sum of such products is 0 or NaN.
    let (inertia, none) = (&link.inertia.rotational, DVec3::ZERO);
    let sum = dot(link.placement.pos, none)
        + dot(link.inertia.first_moment, none)
        + dot(inertia.x_axis, none)
        + dot(inertia.y_axis, none)
        + dot(inertia.z_axis, none);
    sum == 0.0
}

/// The parallel-axis theorem, RBDA (2.63): Ī_O = Ī_C + m (c·c 1 − c cᵀ).
const fn at_origin(body: &Body) -> SpatialInertia<f64> {
    let (c, [xx, xy, xz, yy, yz, zz]) = (vec3(body.com), body.inertia);
    let cc = dot(c, c);
    SpatialInertia {
        mass: body.mass,
        first_moment: scale(c, body.mass),
        rotational: DMat3::from_cols(
            add(DVec3::new(xx, xy, xz), parallel(body.mass, DVec3::X, c, cc)),
            add(DVec3::new(xy, yy, yz), parallel(body.mass, DVec3::Y, c, cc)),
            add(DVec3::new(xz, yz, zz), parallel(body.mass, DVec3::Z, c, cc)),
        ),
    }
}

/// m (c·c e − c (c·e)), a column of the parallel-axis term.
const fn parallel(mass: f64, e: DVec3, c: DVec3, cc: f64) -> DVec3 {
    scale(add(scale(e, cc), scale(c, -dot(c, e))), mass)
}
