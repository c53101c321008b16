//! The inertia of each body alone along its coordinate: what the pivot of its joint is at least,
//! whatever the descendants do.
//!
//! The pivot of forward dynamics is the inertia that a joint moves while its descendants are free
//! (RBDA (2008), section 7.1). They add to that of the body, if no direction of theirs has a
//! negative inertia.

use glam::{DMat3, DVec3};

use super::tree::{Joint, JointMotion};
use crate::math::const_eval::{add, dot, scale};
use crate::model::Link;
use crate::spatial::SpatialInertia;

/// Writes it to each joint, whose inertia is that of its body still; zero if some body of the robot
/// could take away from it.
pub(super) const fn inertia_alone<const V: usize>(joints: &mut [Joint; V], links: &[Link<f64>]) {
    let mut i = 0;
    while i < links.len() {
        if !only_adds(&links[i].inertia) {
            return;
        }
        i += 1;
    }
    i = 0;
    while i < V {
        let joint = &mut joints[i];
        joint.alone = match joint.motion {
            JointMotion::Turn => joint.second.x_axis.x + joint.second.y_axis.y,
            JointMotion::Slide => joint.mass,
            _ => 0.0,
        };
        i += 1;
    }
}

/// Whether a body has a positive mass and positive moments about its centre of mass, or no inertia.
const fn only_adds(body: &SpatialInertia<f64>) -> bool {
    let (m, h) = (body.mass, body.first_moment);
    // m times the moments about the centre of mass: m Ī − (h·h) 1 + h hᵀ.
    let hh = dot(h, h);
    let x = add(scale(body.rotational.x_axis, m), scale(h, h.x));
    let y = add(scale(body.rotational.y_axis, m), scale(h, h.y));
    let z = add(scale(body.rotational.z_axis, m), scale(h, h.z));
    let (xx, yy, zz) = (x.x - hh, y.y - hh, z.z - hh);
    // Sylvester's criterion.
    let plane = xx * yy - x.y * x.y;
    let det = zz * plane + x.z * (x.y * y.z - yy * x.z) - y.z * (xx * y.z - x.y * x.z);
    (m > 0.0 && xx > 0.0 && plane > 0.0 && det > 0.0) || is_nothing(body)
}

const fn is_nothing(body: &SpatialInertia<f64>) -> bool {
    let DMat3 { x_axis, y_axis, z_axis } = body.rotational;
    body.mass == 0.0
        && is_zero(body.first_moment)
        && is_zero(x_axis)
        && is_zero(y_axis)
        && is_zero(z_axis)
}

const fn is_zero(v: DVec3) -> bool {
    v.x == 0.0 && v.y == 0.0 && v.z == 0.0
}
