//! The cast of a model to f32, in a `const fn`.

use glam::{DMat3, DVec3, Mat3, Vec3};

use super::{EMPTY, Joint, Limits, Link, Model};
use crate::spatial::{SpatialInertia, Xform};

impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
    /// The same robot in f32, each number rounded to nearest.
    pub const fn to_f32(&self) -> Model<f32, B, Q, V> {
        let mut links = [EMPTY.single(); B];
        let mut i = 0;
        while i < B {
            links[i] = self.links[i].single();
            i += 1;
        }
        Model {
            name: self.name,
            links,
            lambda: self.lambda,
            kinds: self.kinds,
        }
    }
}

impl Link<f64> {
    const fn single(&self) -> Link<f32> {
        Link {
            name: self.name,
            parent: self.parent,
            joint: Joint {
                kind: self.joint.kind,
                axis: single(self.joint.axis),
                first_axis: single(self.joint.first_axis),
                pitch: self.joint.pitch as f32,
            },
            frame: single_mat(&self.frame),
            placement: Xform {
                rot: single_mat(&self.placement.rot),
                pos: single(self.placement.pos),
            },
            inertia: SpatialInertia {
                mass: self.inertia.mass as f32,
                moment: single(self.inertia.moment),
                inertia: single_mat(&self.inertia.inertia),
            },
            q_at: self.q_at,
            v_at: self.v_at,
            limits: Limits {
                lower: self.limits.lower as f32,
                upper: self.limits.upper as f32,
                velocity: self.limits.velocity as f32,
                torque: self.limits.torque as f32,
            },
        }
    }
}

const fn single(v: DVec3) -> Vec3 {
    Vec3::new(v.x as f32, v.y as f32, v.z as f32)
}

const fn single_mat(m: &DMat3) -> Mat3 {
    Mat3::from_cols(single(m.x_axis), single(m.y_axis), single(m.z_axis))
}
