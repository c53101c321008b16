//! The cast of a model to another scalar, in a `const fn`.

use glam::{DMat3, DVec3, Mat3, Vec3};

use super::{EMPTY, Joint, JointLimits, Link, Model};
use crate::scalar::{Compensated, Fixed, PlainMat3, PlainVec3, Real};
use crate::spatial::{SpatialInertia, Xform};

macro_rules! cast {
    ($(#[$doc:meta])* $name:ident: $r:ty, |$x:ident| $cast:expr, $vec:expr, $mat:expr) => {
        impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
            $(#[$doc])*
            pub const fn $name(&self) -> Model<$r, B, Q, V> {
                type R = $r;
                const fn number($x: f64) -> R {
                    $cast
                }
                const fn vector(v: DVec3) -> <R as Real>::Vec3 {
                    $vec(number(v.x), number(v.y), number(v.z))
                }
                const fn matrix(m: &DMat3) -> <R as Real>::Mat3 {
                    $mat(vector(m.x_axis), vector(m.y_axis), vector(m.z_axis))
                }
                const fn cast(link: &Link<f64>) -> Link<R> {
                    Link {
                        name: link.name,
                        parent: link.parent,
                        joint: Joint {
                            kind: link.joint.kind,
                            axis: vector(link.joint.axis),
                            first_axis: vector(link.joint.first_axis),
                            pitch: number(link.joint.pitch),
                        },
                        frame: matrix(&link.frame),
                        placement: Xform {
                            rot: matrix(&link.placement.rot),
                            pos: vector(link.placement.pos),
                        },
                        inertia: SpatialInertia {
                            mass: number(link.inertia.mass),
                            first_moment: vector(link.inertia.first_moment),
                            inertia: matrix(&link.inertia.inertia),
                        },
                        idx_q: link.idx_q,
                        idx_v: link.idx_v,
                        limits: JointLimits {
                            lower: number(link.limits.lower),
                            upper: number(link.limits.upper),
                            velocity: number(link.limits.velocity),
                            torque: number(link.limits.torque),
                        },
                    }
                }
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
