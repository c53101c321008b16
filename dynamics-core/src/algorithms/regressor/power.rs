//! The power of the force on a body per unit of its inertial parameters.

use crate::model::LinkView;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Motion;

/// The motion of a body in its own frame, as the field of the accelerations of its points: a(r) =
/// point + U r.
pub(super) struct BodyPower<R: Real> {
    omega: R::Vec3,
    turning: R::Vec3,
    /// The acceleration of the body's point at the origin, less gravity.
    point: R::Vec3,
    /// U = \[ω̇\]× + \[ω\]×\[ω\]×.
    field: R::Mat3,
}

impl<R: Real> BodyPower<R> {
    /// From the spatial velocity and acceleration in the link's aligned frame. 90 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of(link: &LinkView<'_, R>, v: Motion<R>, a: Motion<R>) -> Self {
        let own = |x| link.to_joint_frame.transpose_mul(x);
        let (omega, turning) = (own(v.ang), own(a.ang));
        let point = own(a.lin + v.ang.cross(v.lin));
        let ([x, y, z], [dx, dy, dz]) = (omega.array(), turning.array());
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let (xy, xz, yz) = (x * y, x * z, y * z);
        let field = R::Mat3::from_cols(
            R::Vec3::new(-(yy + zz), xy + dz, xz - dy),
            R::Vec3::new(xy - dz, -(xx + zz), yz + dx),
            R::Vec3::new(xz + dy, yz - dx, -(xx + yy)),
        );
        Self { omega, turning, point, field }
    }

    /// sᵀ A: of f = m p + U h and n = h × p + Ī ω̇ + ω × Ī ω, RBDA (2.58), the power along the
    /// motion s = (w, u) per unit of m, h and Ī. 71 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn per_parameter(&self, s: Motion<R>) -> [R; 10] {
        let (w, omega) = (s.ang, self.omega);
        let [hx, hy, hz] = (self.field.transpose_mul(s.lin) + self.point.cross(w)).array();
        // w·Ī ω̇ + (w × ω)·Ī ω
        let ([wx, wy, wz], [tx, ty, tz]) = (w.array(), self.turning.array());
        let ([ux, uy, uz], [ox, oy, oz]) = (w.cross(omega).array(), omega.array());
        [
            s.lin.dot(self.point),
            hx,
            hy,
            hz,
            wx * tx + ux * ox,
            (wx * ty + wy * tx) + (ux * oy + uy * ox),
            wy * ty + uy * oy,
            (wx * tz + wz * tx) + (ux * oz + uz * ox),
            (wy * tz + wz * ty) + (uy * oz + uz * oy),
            wz * tz + uz * oz,
        ]
    }
}
