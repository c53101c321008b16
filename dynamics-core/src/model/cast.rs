//! The cast of a model to another scalar, in a `const fn`.

use super::{Link, Model};
use crate::scalar::Real;

/// The body of a `const fn` that casts `$model`, a `Model<f64, B, Q, V>`, to the scalar `$r`: traits have no `const fn`,
/// so the reports' own scalars expand it too.
#[doc(hidden)]
#[macro_export]
macro_rules! cast_model {
    ($model:expr, $b:ident, $r:ty, |$x:ident| $cast:expr, $vec:expr, $mat:expr) => {{
        use $crate::glam::{DMat3, DVec3};
        use $crate::model::{EMPTY, Joint, JointLimits, Link};
        use $crate::scalar::Real;
        use $crate::spatial::{SpatialInertia, Xform};
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
                to_joint_frame: matrix(&link.to_joint_frame),
                placement: Xform {
                    rot: matrix(&link.placement.rot),
                    pos: vector(link.placement.pos),
                },
                inertia: SpatialInertia {
                    mass: number(link.inertia.mass),
                    first_moment: vector(link.inertia.first_moment),
                    rotational: matrix(&link.inertia.rotational),
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
        let mut links = [cast(&EMPTY); $b];
        let mut i = 0;
        while i < $b {
            links[i] = cast(&$model.links[i]);
            i += 1;
        }
        $model.with_links(links)
    }};
}

impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
    /// The same robot in f32, each number rounded to nearest.
    pub const fn to_f32(&self) -> Model<f32, B, Q, V> {
        cast_model!(
            self,
            B,
            f32,
            |x| x as f32,
            glam::Vec3::new,
            glam::Mat3::from_cols
        )
    }

    /// The same tree of joints with the numbers of these links.
    #[doc(hidden)]
    pub const fn with_links<R: Real>(&self, links: [Link<R>; B]) -> Model<R, B, Q, V> {
        Model {
            name: self.name,
            links,
            lambda: self.lambda,
            kinds: self.kinds,
        }
    }
}
