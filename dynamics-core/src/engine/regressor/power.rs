//! The power of the force on a body per unit of its inertial parameters, in the body's own frame.

use crate::engine::acceleration_field::AccelerationField;
use crate::engine::compile::BodyPlacement;
use crate::engine::folding::{Folded, Mat3, Vec3};
use crate::engine::joint_rates::Twist;
use crate::scalar::Real;

/// The motion of a body, as the field of the accelerations of its points: a(r) = point + U r.
pub(super) struct BodyPower<R> {
    rot: Mat3<R>,
    pos: Vec3<R>,
    length: Folded<R>,
    omega: Vec3<R>,
    alpha: Vec3<R>,
    /// The acceleration of the origin, less gravity, m/s².
    point: Vec3<R>,
    u: Mat3<R>,
}

impl<R: Real> BodyPower<R> {
    /// The motion of the body at `place` on a joint whose field is `field`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of(
        field: &AccelerationField<R>,
        place: &'static BodyPlacement,
        length: f64,
    ) -> Self {
        let (rot, pos) = (Mat3::constant(&place.rot), Vec3::constant(place.pos));
        let length = Folded::constant(length);
        let [x, y, z] = rot.0;
        let (x, y, z) = (field.u.mul(x), field.u.mul(y), field.u.mul(z));
        let point = field.a + field.u.mul(pos);
        Self {
            omega: rot.transpose_mul(field.omega_products),
            alpha: rot.transpose_mul(field.alpha),
            point: rot.transpose_mul(point).scale(length),
            u: Mat3([rot.transpose_mul(x), rot.transpose_mul(y), rot.transpose_mul(z)]),
            rot,
            pos,
            length,
        }
    }

    /// sᵀ A: of f = m p + U h and n = h × p + Ī α + ω × Ī ω, RBDA (2.58), the power along the
    /// motion s of the joint's frame per unit of m, h and Ī.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn per_parameter(&self, s: &Twist<R>) -> [R; 10] {
        let w = self.rot.transpose_mul(s.ang);
        let along = self.rot.transpose_mul(s.lin + s.ang.cross(self.pos));
        let along = along.scale(self.length);
        let [hx, hy, hz] = (self.u.transpose_mul(along) + self.point.cross(w)).0;
        // w·Ī α + (w × ω)·Ī ω
        let ([wx, wy, wz], [tx, ty, tz]) = (w.0, self.alpha.0);
        let ([ux, uy, uz], [ox, oy, oz]) = (w.cross(self.omega).0, self.omega.0);
        [
            along.dot(self.point).get(),
            hx.get(),
            hy.get(),
            hz.get(),
            (wx * tx + ux * ox).get(),
            ((wx * ty + wy * tx) + (ux * oy + uy * ox)).get(),
            (wy * ty + uy * oy).get(),
            ((wx * tz + wz * tx) + (ux * oz + uz * ox)).get(),
            ((wy * tz + wz * ty) + (uy * oz + uz * oy)).get(),
            (wz * tz + uz * oz).get(),
        ]
    }
}
