//! The distance of a pose from the desired one.

use crate::entry;
use dynamics_core::algorithms::Pose;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::Motion;

#[cfg(test)]
mod tests;

/// The motion from a pose to the desired one: [`quaternion_error`], rad, and the difference of the
/// origins, m, in base axes.
///
/// Its power with the directions of a task gives
/// [`TaskDeviation::position`](crate::law::TaskDeviation::position): see
/// [`CartesianImpedance`](crate::law::CartesianImpedance). 70 flops.
///
/// ```
/// use dynamics_core::algorithms::Pose;
/// use motion_control::law::pose_error;
/// use dynamics_core::glam::{DMat3, DVec3};
/// let goal = Pose::<f64> { rot: DMat3::from_rotation_x(0.2), pos: DVec3::Z };
/// let error = pose_error(&Pose::IDENTITY, &goal);
/// assert!((error.ang.x - 2.0 * 0.1_f64.sin()).abs() < 1e-15 && error.lin == DVec3::Z);
/// ```
#[inline(always)]
#[must_use]
pub fn pose_error<R: Real>(pose: &Pose<R>, wanted: &Pose<R>) -> Motion<R> {
    Motion::new(quaternion_error::<R>(&pose.rot, &wanted.rot), wanted.pos - pose.pos)
}

/// The shortest rotation from an attitude to the desired one as a vector: 2 sin(θ/2) along its
/// axis, in base coordinates.
///
/// It is twice the vector part of the unit quaternion whose scalar part is not negative: the
/// angle θ itself within θ³/24. Its length grows up to θ = π, where it is 2; there both directions
/// are equally short, and it is one of them. With equal stiffnesses its couple is that of the
/// potential 4 K (1 − cos(θ/2)).
///
/// # Cost
/// 67 flops, the same instructions for all data.
///
/// # Errors
/// None; a non-finite input gives a non-finite output.
///
/// # Source
/// Shepperd, "Quaternion from rotation matrix" (1978), which divides by the largest of the four
/// components; Caccavale, Natale, Siciliano & Villani, "Resolved-acceleration control of robot
/// manipulators: a critical review with experiments" (1998).
///
/// ```
/// use motion_control::law::{orientation_error, quaternion_error};
/// use dynamics_core::glam::{DMat3, DVec3};
/// let half_a_turn = DMat3::from_rotation_x(core::f64::consts::PI);
/// assert!((quaternion_error::<f64>(&DMat3::IDENTITY, &half_a_turn).length() - 2.0).abs() < 1e-15);
/// assert!(orientation_error::<f64>(&DMat3::IDENTITY, &half_a_turn).length() < 1e-15); // the sine vanishes
/// ```
#[doc(alias = "orientation error")]
#[inline(always)]
#[must_use]
pub fn quaternion_error<R: Real>(attitude: &R::Mat3, wanted: &R::Mat3) -> R::Vec3 {
    let [x, y, z] = (*wanted * attitude.transpose()).cols();
    let ([xx, yx, zx], [xy, yy, zy], [xz, yz, zz]) = (x.array(), y.array(), z.array());
    let one = R::ONE;
    // 4 p pᵀ of the quaternion p, by rows of x, y, z and w.
    let (wx, wy, wz) = (zy - yz, xz - zx, yx - xy);
    let (xy, yz, zx) = (xy + yx, yz + zy, zx + xz);
    let rows = [
        [one + xx - yy - zz, xy, zx, wx],
        [xy, one - xx + yy - zz, yz, wy],
        [zx, yz, one - xx - yy + zz, wz],
        [wx, wy, wz, one + xx + yy + zz],
    ];
    let (mut best, mut square) = (rows[0], rows[0][0]);
    for (k, row) in rows.into_iter().enumerate().skip(1) {
        let larger = entry(&row, k) > square;
        best = if larger { row } else { best };
        square = if larger { entry(&row, k) } else { square };
    }
    let scale = square.rsqrt();
    let scale = if best[3] < R::ZERO { -scale } else { scale };
    R::Vec3::new(best[0], best[1], best[2]) * scale
}
