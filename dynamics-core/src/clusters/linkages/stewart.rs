//! The platform on six legs.

use super::dyad::{Branch, Root, root};
use super::hook::Hook;
use super::zero::of_unit;
use crate::algorithms::Pose;
use crate::clusters::cluster::dot;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Motion;
use crate::state::State;
use crate::trig::Kernel;

/// A leg of a [`Stewart`] platform, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Its universal joint on the base.
    pub base: [f64; 3],
    /// Its ball joint in the platform's frame.
    pub platform: [f64; 3],
    /// Its length where the slide's coordinate is zero.
    pub length: f64,
}

/// A platform on six legs of variable length (Gough; Stewart, 1965). M = 24, N = 6, y = the
/// platform's position x, y, z and yaw, pitch, roll.
///
/// The attitude is R_z(yaw) R_y(pitch) R_x(roll), the `rpy` of URDF. The spanning tree's joint
/// coordinates, in this order and in m and rad, are:
///
/// | q | joint | axis, in the body's frame |
/// |---|---|---|
/// | 0, 1, 2 | platform on the base | prismatic x, y, z |
/// | 3, 4, 5 | platform: yaw, pitch, roll | z, y, x |
/// | 6, 7 | lower half of the first leg on the base | y, x |
/// | 8 | upper half of the first leg on the lower | prismatic z |
/// | 9 … 23 | the same of the other legs | |
///
/// The bodies between these axes have no mass. At zero all frames have the base's axes, and a leg
/// points along z. The loops are cut at the ball joints on the platform; both halves of a leg are
/// bodies, which do not spin about the leg.
///
/// The motors are at the slides:
/// [`Driven::actuated`](crate::clusters::Driven::actuated)`([8, 11, 14, 17, 20, 23])`. The motion
/// of the platform determines that of the legs everywhere, the reverse has no closed form.
/// Configurations in which no forces of the legs hold the platform are therefore not singular for
/// this cluster, but dead points of the motors:
/// [`TreeMotion::to_motors`](crate::clusters::TreeMotion::to_motors) names them.
///
/// # Cost
/// Some 1,200 flops, six divisions and twelve reciprocal roots; sines and cosines of the attitude
/// only. An effect that reads the angles of the legs themselves adds twelve arc tangents.
///
/// # Errors
/// None for a finite y. If a leg has no length or is parallel to y, [`ClusterMotion::singular`]
/// is set: within an angle of 3·10⁻⁵ rad in f64 and 6·10⁻³ rad in f32, and at a length of as much
/// of the largest leg's reach.
///
/// # Source
/// The legs' vectors z = p + R s − b, and their derivatives in spherical coordinates.
///
/// ```
/// use dynamics_core::clusters::{Cluster, Leg, Stewart};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// const fn leg(base: [f64; 2], platform: [f64; 2]) -> Leg {
///     Leg { base: [base[0], base[1], 0.0], platform: [platform[0], platform[1], 0.0], length: 0.5 }
/// }
/// const STEWART: Stewart = Stewart::new([
///     leg([0.5, -0.1], [0.2, -0.3]),
///     leg([0.5, 0.1], [0.2, 0.3]),
///     leg([-0.2, 0.5], [0.1, 0.35]),
///     leg([-0.3, 0.4], [-0.3, 0.05]),
///     leg([-0.3, -0.4], [-0.3, -0.05]),
///     leg([-0.2, -0.5], [0.1, -0.35]),
/// ]);
/// let y = [0.0, 0.0, 0.6, 0.0, 0.0, 0.0].map(JointCoordinate::revolute);
/// let motion = STEWART.evaluate::<f64, Native>(&y, &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0])?;
/// let length = (0.3_f64 * 0.3 + 0.2 * 0.2 + 0.6 * 0.6).sqrt();
/// assert!((motion.q[8].q + 0.5 - length).abs() < 1e-15);
/// assert!((motion.g[8][2] - 0.6 / length).abs() < 1e-15);
/// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stewart {
    legs: [Leg; 6],
    /// The scale of the rounding errors, m².
    scale: f64,
}

impl Stewart {
    /// A platform on these legs.
    ///
    /// # Panics
    /// If a number is not finite or a length is negative; in a `const` this does not compile.
    pub const fn new(legs: [Leg; 6]) -> Self {
        let (mut i, mut scale) = (0, 0.0);
        while i < legs.len() {
            let Leg { base, platform, length } = &legs[i];
            assert!(
                *length >= 0.0 && length.is_finite(),
                "the length of a leg is negative or not finite"
            );
            let mut k = 0;
            while k < 3 {
                assert!(
                    base[k].is_finite() && platform[k].is_finite(),
                    "a joint of a leg is not finite"
                );
                let reach = base[k].abs() + platform[k].abs() + *length;
                if reach * reach > scale {
                    scale = reach * reach;
                }
                k += 1;
            }
            i += 1;
        }
        Self { legs, scale }
    }
}

/// A leg's part of the cluster: its three coordinates, their rows of G, and Ġ ẏ.
struct LegMotion<R> {
    q: [JointCoordinate<R>; 3],
    g: [[R; 6]; 3],
    bias: [R; 3],
    singular: bool,
}

impl Leg {
    #[cfg_attr(optimised, inline(always))]
    fn reach<R: Real>(
        &self,
        platform: &Platform<R>,
        yd: &[R; 6],
        scale: R,
    ) -> Result<LegMotion<R>, ClusterProblem> {
        let r = platform.arm(self.platform);
        let b = self.base.map(R::from_f64);
        let z = (platform.position - R::Vec3::new(b[0], b[1], b[2])) + r;
        let l2 = z.dot(z);
        let Root { h: l, h_inv: l_inv, singular } = root(l2, scale, Branch::Positive)?;
        let hook =
            if singular { Hook::<R>::short(z, scale)? } else { Hook::<R>::of(z, l_inv, l2)? };
        let [e_l, e_turn, e_lift] = hook.axes();
        let g = [
            platform.row(r, e_turn * hook.flat_inv),
            platform.row(r, e_lift * l_inv),
            platform.row(r, e_l),
        ];
        let rates = [dot(&g[0], yd), dot(&g[1], yd), dot(&g[2], yd)];
        let [turn, lift] = hook.angles();
        let slide = JointCoordinate::linear(l - R::from_f64(self.length));
        Ok(LegMotion {
            q: [turn, lift, slide],
            g,
            bias: hook.telescoping(platform.centripetal * r, rates, [l, l_inv]),
            singular: hook.singular,
        })
    }
}

impl Cluster<24, 6> for Stewart {
    const INDEPENDENT: [Option<usize>; 24] = {
        let mut platform = [None; 24];
        let mut k = 0;
        while k < 6 {
            platform[k] = Some(k);
            k += 1;
        }
        platform
    };

    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        y: &[JointCoordinate<R>; 6],
        yd: &[R; 6],
    ) -> Result<ClusterMotion<R, 24, 6>, ClusterProblem> {
        let platform = Platform::of(y, yd);
        let mut motion = ClusterMotion {
            q: [JointCoordinate::default(); 24],
            g: [[R::ZERO; 6]; 24],
            bias: [R::ZERO; 24],
            singular: false,
        };
        unrolled!(K in 0 1 2 3 4 5, {
            motion.q[K] = if K < 3 {
                JointCoordinate::linear(y[K].q)
            } else {
                y[K]
            };
            motion.g[K][K] = R::ONE;
            let leg = self.legs[K].reach(&platform, yd, R::from_f64(self.scale))?;
            unrolled!(I in 0 1 2, {
                    motion.q[6 + 3 * K + I] = leg.q[I];
                    motion.g[6 + 3 * K + I] = leg.g[I];
                    motion.bias[6 + 3 * K + I] = leg.bias[I];
                });
            motion.singular |= leg.singular;
        });
        Ok(motion)
    }
}

impl Stewart {
    /// The independent coordinates y, ẏ, ÿ of a platform from its pose, twist and acceleration.
    ///
    /// # Frames
    /// All in base axes and of the platform's origin, which is
    /// [`LocalWorldAligned`](crate::algorithms::frame): `twist` has ω and the velocity of the
    /// origin, rad/s and m/s, `acceleration` their derivatives.
    ///
    /// # Cost
    /// Some 60 flops, two divisions and a root, and an arc tangent for each of three angles.
    ///
    /// # Errors
    /// [`ClusterProblem::CannotClose`] at a pitch within 10⁻³ rad of ±90°, where yaw and roll have
    /// one axis. Numbers that are not finite are not refused here: they give coordinates that are
    /// not, for which the dynamics return [`ClusterProblem::NotFinite`].
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

/// The platform's position, attitude and rates, which all legs share.
struct Platform<R: Real> {
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
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of([x, y, z, yaw, pitch, roll]: &[JointCoordinate<R>; 6], yd: &[R; 6]) -> Self {
        let ahead = R::Vec3::new(yaw.cos * pitch.cos, yaw.sin * pitch.cos, -pitch.sin);
        let left = R::Vec3::new(-yaw.sin, yaw.cos, R::ZERO);
        // ẑ of the platform before it rolls.
        let above = R::Vec3::new(yaw.cos * pitch.sin, yaw.sin * pitch.sin, pitch.cos);
        let attitude =
            [ahead, left * roll.cos + above * roll.sin, above * roll.cos - left * roll.sin];
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
    #[cfg_attr(optimised, inline(always))]
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
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn row(&self, r: R::Vec3, form: R::Vec3) -> [R; 6] {
        let moment = r.cross(form);
        let ([x, y, z], [mx, my, mz]) = (form.array(), moment.array());
        let [sin, cos] = self.yaw;
        [x, y, z, mz, my * cos - mx * sin, moment.dot(self.roll)]
    }
}

/// The matrix of ω̇ × r + ω × (ω × r).
#[cfg_attr(optimised, inline(always))]
fn centripetal<R: Real>(omega: R::Vec3, alpha: R::Vec3) -> R::Mat3 {
    let ([x, y, z], [ax, ay, az]) = (omega.array(), alpha.array());
    let (xx, yy, zz, xy, xz, yz) = (x * x, y * y, z * z, x * y, x * z, y * z);
    R::Mat3::from_cols(
        R::Vec3::new(-(yy + zz), xy + az, xz - ay),
        R::Vec3::new(xy - az, -(xx + zz), yz + ax),
        R::Vec3::new(xz + ay, yz - ax, -(xx + yy)),
    )
}
