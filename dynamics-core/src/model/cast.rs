//! The cast of a model to another scalar, in a `const fn`.

use glam::{DMat3, DVec3, Mat3, Vec3};

use super::{EMPTY, Joint, Limits, Link, Model};
use crate::scalar::{Compensated, Fixed, PlainMat3, PlainVec3};
use crate::spatial::{SpatialInertia, Xform};

macro_rules! cast {
    ($(#[$doc:meta])* $name:ident: $r:ty, |$x:ident| $cast:expr, $vec:expr, $mat:expr) => {
        impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
            $(#[$doc])*
            pub const fn $name(&self) -> Model<$r, B, Q, V> {
                let mut links = [EMPTY.$name(); B];
                let mut i = 0;
                while i < B {
                    links[i] = self.links[i].$name();
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
            const fn $name(&self) -> Link<$r> {
                type R = $r;
                const fn number($x: f64) -> R {
                    $cast
                }
                const fn vector(v: DVec3) -> <R as crate::scalar::Real>::Vec3 {
                    $vec(number(v.x), number(v.y), number(v.z))
                }
                const fn matrix(m: &DMat3) -> <R as crate::scalar::Real>::Mat3 {
                    $mat(vector(m.x_axis), vector(m.y_axis), vector(m.z_axis))
                }
                Link {
                    name: self.name,
                    parent: self.parent,
                    joint: Joint {
                        kind: self.joint.kind,
                        axis: vector(self.joint.axis),
                        first_axis: vector(self.joint.first_axis),
                        pitch: number(self.joint.pitch),
                    },
                    frame: matrix(&self.frame),
                    placement: Xform {
                        rot: matrix(&self.placement.rot),
                        pos: vector(self.placement.pos),
                    },
                    inertia: SpatialInertia {
                        mass: number(self.inertia.mass),
                        moment: vector(self.inertia.moment),
                        inertia: matrix(&self.inertia.inertia),
                    },
                    q_at: self.q_at,
                    v_at: self.v_at,
                    limits: Limits {
                        lower: number(self.limits.lower),
                        upper: number(self.limits.upper),
                        velocity: number(self.limits.velocity),
                        torque: number(self.limits.torque),
                    },
                }
            }
        }
    };
}

cast!(
    /// The same robot in f32, each number rounded to nearest.
    to_f32: f32, |x| x as f32, Vec3::new, Mat3::from_cols
);
cast!(
    /// The same robot in pairs of f32.
    to_compensated: Compensated, |x| Compensated::new(x), plain_vector, plain_matrix
);
cast!(
    /// The same robot in fixed point; what is beyond ±2 (limits, most often) becomes the end of the range. In
    /// [`Model::in_units`] that suit, nothing else is.
    to_fixed: Fixed, |x| Fixed::new(x), plain_vector, plain_matrix
);

const fn plain_vector<R: Copy>(x: R, y: R, z: R) -> PlainVec3<R> {
    PlainVec3([x, y, z])
}

const fn plain_matrix<R: Copy>(x: PlainVec3<R>, y: PlainVec3<R>, z: PlainVec3<R>) -> PlainMat3<R> {
    PlainMat3([x, y, z])
}
