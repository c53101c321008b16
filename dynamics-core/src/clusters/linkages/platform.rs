//! The platform of a [`Stewart`]: its motion from independent coordinates, and these from its pose, twist and
//! acceleration.

use super::Stewart;
use super::zero::of_unit;
use crate::algorithms::Pose;
use crate::clusters::ClusterProblem;
use crate::model::JointCoordinate;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Motion;
use crate::state::State;

/// The platform's position, attitude and rates, which all legs share.
pub(super) struct Platform<R: Real> {
    pub(super) position: R::Vec3,
    attitude: [R::Vec3; 3],
    /// sin and cos of yaw: the axis of pitch is (−sin, cos, 0), that of yaw z.
    yaw: [R; 2],
    /// The axis of roll.
    roll: R::Vec3,
    /// ω̇ at ÿ = 0.
    alpha: R::Vec3,
    /// r̈ at ÿ = 0 of a vector r that is fixed to the platform, as a matrix: ω̇ × r + ω × (ω × r).
    pub(super) centripetal: R::Mat3,
}

impl<R: Real> Platform<R> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of([x, y, z, yaw, pitch, roll]: &[JointCoordinate<R>; 6], yd: &[R; 6]) -> Self {
        let ahead = R::Vec3::new(yaw.cos * pitch.cos, yaw.sin * pitch.cos, -pitch.sin);
        let left = R::Vec3::new(-yaw.sin, yaw.cos, R::ZERO);
        // ẑ of the platform before it rolls.
        let above = R::Vec3::new(yaw.cos * pitch.sin, yaw.sin * pitch.sin, pitch.cos);
        let attitude = [
            ahead,
            left * roll.cos + above * roll.sin,
            above * roll.cos - left * roll.sin,
        ];
        let yaw_pitch = R::Vec3::new(-(yaw.sin * yd[4]), yaw.cos * yd[4], yd[3]);
        // z × pitch axis = −(cos, sin, 0)
        let turn = yd[3] * yd[4];
        let of_pitch = R::Vec3::new(-(yaw.cos * turn), -(yaw.sin * turn), R::ZERO);
        let alpha = of_pitch + yaw_pitch.cross(ahead) * yd[5];
        Self {
            position: R::Vec3::new(x.q, y.q, z.q),
            attitude,
            yaw: [yaw.sin, yaw.cos],
            roll: ahead,
            alpha,
            centripetal: centripetal::<R>(yaw_pitch + ahead * yd[5], alpha),
        }
    }

    /// A point of the platform from its origin.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn arm(&self, at: [f64; 3]) -> R::Vec3 {
        let mut r = self.attitude[0] * R::from_f64(at[0]);
        // Constants: what is zero is not in the machine code.
        for (axis, x) in [(self.attitude[1], at[1]), (self.attitude[2], at[2])] {
            if x != 0.0 {
                r += axis * R::from_f64(x);
            }
        }
        r
    }

    /// The row of G of a rate that is `form` · ż at the end of `r`, from the platform's origin.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn row(&self, r: R::Vec3, form: R::Vec3) -> [R; 6] {
        let moment = r.cross(form);
        let ([x, y, z], [mx, my, mz]) = (form.array(), moment.array());
        let [sin, cos] = self.yaw;
        [x, y, z, mz, my * cos - mx * sin, moment.dot(self.roll)]
    }
}

/// The matrix of ω̇ × r + ω × (ω × r).
#[cfg_attr(not(debug_assertions), inline(always))]
fn centripetal<R: Real>(omega: R::Vec3, alpha: R::Vec3) -> R::Mat3 {
    let ([x, y, z], [ax, ay, az]) = (omega.array(), alpha.array());
    let (xx, yy, zz, xy, xz, yz) = (x * x, y * y, z * z, x * y, x * z, y * z);
    R::Mat3::from_cols(
        R::Vec3::new(-(yy + zz), xy + az, xz - ay),
        R::Vec3::new(xy - az, -(xx + zz), yz + ax),
        R::Vec3::new(xz + ay, yz - ax, -(xx + yy)),
    )
}

impl Stewart {
    /// The independent coordinates y, ẏ, ÿ of a platform from its pose, twist and acceleration.
    ///
    /// # Frames
    /// All in base axes and of the platform's origin, which is [`LocalWorldAligned`](crate::algorithms::frame): `twist`
    /// has ω and the velocity of the origin, rad/s and m/s, `acceleration` their derivatives.
    ///
    /// # Cost
    /// Some 60 flops, two divisions and a root, and an arc tangent for each of three angles.
    ///
    /// # Errors
    /// [`ClusterProblem::CannotClose`] at a pitch within 10⁻³ rad of ±90°, where yaw and roll have one axis. Numbers that
    /// are not finite are not refused here: they give coordinates that are not, for which the dynamics return
    /// [`ClusterProblem::NotFinite`].
    ///
    /// ```
    /// use dynamics_core::algorithms::Pose;
    /// use dynamics_core::clusters::Stewart;
    /// use dynamics_core::spatial::Motion;
    /// use glam::{DMat3, DVec3};
    /// let attitude = DMat3::from_rotation_z(0.3) * DMat3::from_rotation_y(-0.2) * DMat3::from_rotation_x(0.1);
    /// let pose = Pose { rot: attitude, pos: DVec3::new(0.1, 0.0, 0.8) };
    /// let twist = Motion::<f64> { ang: DVec3::Z, lin: DVec3::X };
    /// let y = Stewart::coordinates(&pose, twist, Motion::ZERO)?;
    /// let wanted = [0.1, 0.0, 0.8, 0.3, -0.2, 0.1];
    /// assert!(y.q.iter().zip(wanted).all(|(q, wanted)| (q - wanted).abs() < 1e-15));
    /// assert!((y.qd[3] - 1.0).abs() < 1e-15 && y.qd[4].abs() < 1e-15); // ω along z is a rate of yaw alone
    /// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
    /// ```
    pub fn coordinates<R: Real>(
        pose: &Pose<R>,
        twist: Motion<R>,
        acceleration: Motion<R>,
    ) -> Result<State<R, 6, 6>, ClusterProblem> {
        let [ahead, left, above] = pose.rot.cols().map(R::Vec3::array);
        let [flat, lift] = [ahead[0] * ahead[0] + ahead[1] * ahead[1], -ahead[2]];
        if flat <= R::from_f64(1e-6) {
            return Err(ClusterProblem::CannotClose);
        }
        let flat_inv = flat.rsqrt();
        let cos = flat * flat_inv;
        let yaw = of_unit(ahead[1] * flat_inv, ahead[0] * flat_inv);
        let pitch = of_unit(lift, cos);
        let roll = of_unit(left[2] * flat_inv, above[2] * flat_inv);
        // ω = ψ̇ z + θ̇ (−sin ψ, cos ψ, 0) + φ̇ x of the platform.
        let rates = |[x, y, z]: [R; 3]| {
            let roll = (x * yaw.cos + y * yaw.sin) * flat_inv;
            [z + roll * lift, y * yaw.cos - x * yaw.sin, roll]
        };
        let [yaw_d, pitch_d, roll_d] = rates(twist.ang.array());
        let moving = [R::ZERO, R::ZERO, R::ZERO, yaw_d, pitch_d, roll_d];
        let [x, y, z] = pose.pos.array().map(JointCoordinate::linear);
        let platform = Platform::<R>::of(&[x, y, z, yaw, pitch, roll], &moving);
        let [yaw_dd, pitch_dd, roll_dd] = rates((acceleration.ang - platform.alpha).array());
        let ([vx, vy, vz], [ax, ay, az]) = (twist.lin.array(), acceleration.lin.array());
        Ok(State {
            q: [x.q, y.q, z.q, yaw.q, pitch.q, roll.q],
            qd: [vx, vy, vz, yaw_d, pitch_d, roll_d],
            qdd: [ax, ay, az, yaw_dd, pitch_dd, roll_dd],
        })
    }
}
