//! The accelerations of the points of a body: of the one at r from the origin a + U r.
//!
//! U = α× + ω× ω×, the tensor of Balafoutis, Patel & Misra (1988). If the spatial acceleration
//! of a body is (α, ȧ), a is ȧ + ω × v; the velocity v of the origin does not occur in its
//! recursion nor in the force of the body, so that it is not computed.

use super::{Force, Motion, SpatialInertia, Xform};
use crate::scalar::{Matrix, Real, Vector};

/// The accelerations of the points of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AccelerationField<R: Real> {
    /// Its angular acceleration α, rad/s².
    ang: R::Vec3,
    /// a, the acceleration of its origin, m/s².
    origin: R::Vec3,
    /// U, 1/s².
    gradient: R::Mat3,
}

impl<R: Real> AccelerationField<R> {
    /// The field of the angular velocity ω, the angular acceleration α and the acceleration a of
    /// the origin. 15 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn new(w: R::Vec3, at_origin: Motion<R>) -> Self {
        let ([wx, wy, wz], [x, y, z]) = (w.array(), at_origin.ang.array());
        let (xx, yy, zz) = (wx * wx, wy * wy, wz * wz);
        let (xy, xz, yz) = (wx * wy, wx * wz, wy * wz);
        Self {
            ang: at_origin.ang,
            origin: at_origin.lin,
            gradient: R::Mat3::from_cols(
                R::Vec3::new(-(yy + zz), xy + z, xz - y),
                R::Vec3::new(xy - z, -(xx + zz), yz + x),
                R::Vec3::new(xz + y, yz - x, -(xx + yy)),
            ),
        }
    }

    /// α, and the acceleration of the origin of a frame that is fixed in the body, in its axes. 48
    /// flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn moved(&self, x: &Xform<R>) -> Motion<R> {
        Motion::new(x.rot * self.ang, x.rot * self.plus_gradient(self.origin, x.pos))
    }

    /// a + U r. 18 flops.
    #[cfg_attr(optimised, inline(always))]
    fn plus_gradient(&self, a: R::Vec3, r: R::Vec3) -> R::Vec3 {
        let ([ux, uy, uz], [x, y, z]) = (self.gradient.cols(), r.array());
        a + uz * z + uy * y + ux * x
    }
}

impl<R: Real> SpatialInertia<R> {
    /// The couple about z of [`Self::force_in`] alone, of a body whose axis z stands still, so that
    /// ω and α lie along it. 5 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn couple_about_z(&self, a: Motion<R>) -> Force<R> {
        let [_, _, _, _, _, zz] = self.upper();
        let ([hx, hy, _], [ax, ay, _]) = (self.first_moment.array(), a.lin.array());
        let [_, _, alpha] = a.ang.array();
        let couple = alpha * zz + hx * ay - hy * ax;
        Force::new(R::Vec3::new(R::ZERO, R::ZERO, couple), R::Vec3::ZERO)
    }

    /// I a + v ×* I v of a body that moves with a field: m a + U h, and ∫ r × U r dm + h × a. 66
    /// flops beyond the products of ω.
    ///
    /// Among 867 orders of these sums 14 keep every hard case within its bounds; this one runs from
    /// left to right.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn force_in(&self, field: &AccelerationField<R>, w: R::Vec3) -> Force<R> {
        let [xx, xy, xz, yy, yz, zz] = self.upper();
        let ([wx, wy, wz], [x, y, z]) = (w.array(), field.ang.array());
        let (w_xx, w_yy, w_zz) = (wx * wx, wy * wy, wz * wz);
        let (w_xy, w_xz, w_yz) = (wx * wy, wx * wz, wy * wz);
        let ([hx, hy, hz], [ax, ay, az]) = (self.first_moment.array(), field.origin.array());
        let [[_, u_yx, u_zx], [u_xy, _, u_zy], [u_xz, u_yz, _]] =
            field.gradient.cols().map(Vector::array);
        let couple = R::Vec3::new(
            x * xx + w_yz * (zz - yy) + u_yx * xz - u_zx * xy + (w_yy - w_zz) * yz + hy * az
                - hz * ay,
            y * yy + w_xz * (xx - zz) + u_zy * xy - u_xy * yz + (w_zz - w_xx) * xz + hz * ax
                - hx * az,
            z * zz + w_xy * (yy - xx) + u_xz * yz - u_yz * xz + (w_xx - w_yy) * xy + hx * ay
                - hy * ax,
        );
        let force = field.plus_gradient(field.origin * self.mass, self.first_moment);
        Force::new(couple, force)
    }
}

#[cfg(test)]
mod tests {
    use super::AccelerationField;
    use crate::spatial::{Motion, SpatialInertia};
    use glam::DVec3;

    #[test]
    fn the_force_in_a_field_is_that_of_the_spatial_acceleration() {
        let inertia = SpatialInertia::from_parameters([
            2.0, 0.3, -0.4, 0.5, 0.31, 0.02, 0.29, -0.03, 0.04, 0.27,
        ]);
        let v = Motion::<f64>::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.3, 0.7, -1.1));
        let a = Motion::<f64>::new(DVec3::new(-3.0, 0.4, 2.5), DVec3::new(9.0, -0.2, 4.0));
        let at_origin = Motion::new(a.ang, a.lin + v.ang.cross(v.lin));
        let (got, want): (super::Force<f64>, _) = (
            inertia.force_in(&AccelerationField::new(v.ang, at_origin), v.ang),
            inertia.force(a, v),
        );
        assert!((got.ang - want.ang).length() < 1e-14 && (got.lin - want.lin).length() < 1e-14);
    }

    #[test]
    fn the_couple_about_a_standing_axis_is_that_of_the_field() {
        let inertia = SpatialInertia::from_parameters([
            2.0, 0.3, -0.4, 0.5, 0.31, 0.02, 0.29, -0.03, 0.04, 0.27,
        ]);
        let (w, alpha) = (DVec3::Z * 1.7, DVec3::Z * -3.0);
        let a = Motion::<f64>::new(alpha, DVec3::new(9.0, -0.2, 4.0));
        let want: super::Force<f64> = inertia.force_in(&AccelerationField::new(w, a), w);
        assert_eq!(inertia.couple_about_z(a).ang.z, want.ang.z);
    }
}
