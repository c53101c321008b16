//! The cast of a model to f32.

use glam::{DMat3, DVec3, Mat3, Vec3};

use super::{EMPTY, Joint, JointLimits, Link, Model};
use crate::spatial::{SpatialInertia, Xform};

impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
    /// The same robot in f32, each number rounded to nearest.
    pub const fn to_f32(&self) -> Model<f32, B, Q, V> {
        let mut links = [cast(&EMPTY); B];
        let mut i = 0;
        while i < B {
            links[i] = cast(&self.links[i]);
            i += 1;
        }
        Model {
            name: self.name,
            links,
            lambda: self.lambda,
            kinds: self.kinds,
            chain: self.chain,
            // Bodies are looked up while compiling, in f64: firmware carries no names of links.
        }
    }
}

const fn vector(v: DVec3) -> Vec3 {
    Vec3::new(v.x as f32, v.y as f32, v.z as f32)
}

const fn matrix(m: &DMat3) -> Mat3 {
    Mat3::from_cols(vector(m.x_axis), vector(m.y_axis), vector(m.z_axis))
}

const fn cast(link: &Link<f64>) -> Link<f32> {
    Link {
        name: link.name,
        parent: link.parent,
        joint: Joint {
            kind: link.joint.kind,
            axis: vector(link.joint.axis),
            first_axis: vector(link.joint.first_axis),
            pitch: link.joint.pitch as f32,
        },
        to_joint_frame: matrix(&link.to_joint_frame),
        placement: Xform { rot: matrix(&link.placement.rot), pos: vector(link.placement.pos) },
        inertia: SpatialInertia {
            mass: link.inertia.mass as f32,
            first_moment: vector(link.inertia.first_moment),
            rotational: matrix(&link.inertia.rotational),
        },
        idx_q: link.idx_q,
        idx_v: link.idx_v,
        limits: JointLimits {
            lower: link.limits.lower as f32,
            upper: link.limits.upper as f32,
            velocity: link.limits.velocity as f32,
            torque: link.limits.torque as f32,
        },
    }
}
