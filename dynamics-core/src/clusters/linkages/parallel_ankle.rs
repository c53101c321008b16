//! The parallel ankle: two cranks at the shank, each with a rod to the foot.

use super::dyad::{Branch, Root, root};
use super::zero::of_unit;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::{Real, Vector};
use crate::trig::Kernel;

/// One of the two drives of a [`ParallelAnkle`]: its crank and its rod. All in m, at pitch and roll
/// zero in frames that have the shank's axes: x forward, y to the left, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rod {
    /// The crank's joint, from the centre of the ankle.
    pub joint: [f64; 3],
    /// The rod's joint on the crank, from the crank's joint, at the crank's angle zero.
    pub crank: [f64; 3],
    /// The rod's ball joint on the foot, from the centre of the ankle.
    pub foot: [f64; 3],
    /// The length of the rod.
    pub length: f64,
    /// Which of the crank's two angles.
    pub branch: Branch,
}

/// The ankle of many humanoids: two motors at the shank pitch and roll the foot by two rods. M = 8,
/// N = 2, y = (pitch, roll).
///
/// The foot pitches about y, then rolls about its own x, through the centre of the ankle; the
/// cranks turn about y. The spanning tree's joint coordinates, in this order and in rad, are:
///
/// | q | joint | axis, in the body's frame |
/// |---|---|---|
/// | 0, 1 | foot on the shank: pitch, roll | y, x |
/// | 2 | first crank on the shank | y |
/// | 3, 4 | first rod on the first crank | y, x |
/// | 5 | second crank on the shank | y |
/// | 6, 7 | second rod on the second crank | y, x |
///
/// where a pair is a universal joint, or two revolute ones with a body without mass between them.
/// At zero all frames have the shank's axes, and a rod hangs from its crank along −z. The loops are
/// cut at the ball joints of the rods on the foot. The rods are bodies with an inertia of their
/// own; they do not spin about themselves.
///
/// y is the foot's attitude, of which the motors' angles q₂ and q₅ are a closed form. Torques of
/// the motors at q₂ and q₅ follow by
/// [`Driven::actuated`](crate::clusters::Driven::actuated)`([2, 5])`.
///
/// [`Branch::Positive`]: the crank turns towards positive angles as the end of its rod on the foot
/// moves away from it.
///
/// # Cost
/// Some 400 flops, two divisions and six reciprocal roots; sines and cosines of y only. An effect
/// that reads the angles of cranks and rods themselves adds six arc tangents.
///
/// # Errors
/// [`ClusterProblem::CannotClose`] where a rod does not reach its crank's circle. If crank and
/// rod are in line, or the rod parallel to y, [`ClusterMotion::singular`] is set.
///
/// # Source
/// The rod's length l = |p − t| with p on the foot and t on the crank: A cos m + B sin m = K in the
/// motor's angle m, and its two derivatives.
///
/// ```
/// use dynamics_core::clusters::{Branch, Cluster, ParallelAnkle, Rod};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// const fn rod(side: f64, height: f64) -> Rod {
///     Rod {
///         joint: [0.0, side, height],
///         crank: [-0.05, 0.0, 0.0],
///         foot: [-0.05, side, 0.0],
///         length: height,
///         branch: Branch::Negative,
///     }
/// }
/// const ANKLE: ParallelAnkle = ParallelAnkle::new([rod(0.04, 0.2), rod(-0.04, 0.3)]);
/// // Both cranks are parallel to the foot: they pitch as it does.
/// let motion = ANKLE.evaluate::<f64, Native>(&[0.2, 0.0].map(JointCoordinate::revolute), &[1.0, 0.0])?;
/// assert!((motion.q[2].q - 0.2).abs() < 1e-14 && (motion.q[5].q - 0.2).abs() < 1e-14);
/// assert!((motion.g[2][0] - 1.0).abs() < 1e-14 && motion.bias[2].abs() < 1e-13);
/// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
/// ```
///
/// A rod without length does not compile:
///
/// ```compile_fail,E0080
/// use dynamics_core::clusters::{Branch, ParallelAnkle, Rod};
/// const ROD: Rod = Rod {
///     joint: [0.0; 3],
///     crank: [-0.05, 0.0, 0.0],
///     foot: [-0.05, 0.0, 0.0],
///     length: 0.0,
///     branch: Branch::Positive,
/// };
/// const _: ParallelAnkle = ParallelAnkle::new([ROD, ROD]); // error: a rod's length is not positive
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParallelAnkle {
    rods: [Rod; 2],
}

impl ParallelAnkle {
    /// An ankle with these two drives.
    ///
    /// # Panics
    /// If a number is not finite, a rod's length is not positive, or a crank or the foot's point is
    /// on its axis; in a `const` this does not compile.
    pub const fn new(rods: [Rod; 2]) -> Self {
        let mut i = 0;
        while i < rods.len() {
            let rod = &rods[i];
            let mut k = 0;
            while k < 3 {
                let finite =
                    rod.joint[k].is_finite() && rod.crank[k].is_finite() && rod.foot[k].is_finite();
                assert!(finite, "a length of a parallel ankle is not finite");
                k += 1;
            }
            assert!(rod.length > 0.0 && rod.length.is_finite(), "a rod's length is not positive");
            assert!(
                rod.crank[0] != 0.0 || rod.crank[2] != 0.0,
                "a crank of a parallel ankle has no length"
            );
            i += 1;
        }
        Self { rods }
    }
}

/// A vector of square `squared` at length one, also where that is almost zero.
#[cold]
#[inline(never)]
fn direction<R: Real>(x: R, y: R, squared: R) -> (R, R) {
    if squared < R::MIN_POSITIVE {
        return (R::ZERO, R::ONE);
    }
    let inv = squared.rsqrt();
    (x * inv, y * inv)
}

/// The foot's attitude and rate, which both rods share.
struct Foot<R: Real> {
    /// Sine and cosine of pitch and roll.
    pitch: [R; 2],
    roll: [R; 2],
    /// The axis of the roll.
    axis: R::Vec3,
    omega: R::Vec3,
    /// ω̇ at ÿ = 0.
    alpha: R::Vec3,
}

/// A rod's part of the cluster: its three coordinates, their rows of G, and Ġ ẏ.
type RodMotion<R> = ([JointCoordinate<R>; 3], [[R; 2]; 3], [R; 3], bool);

impl Rod {
    /// The crank's angle and the rod's two.
    #[cfg_attr(optimised, inline(always))]
    fn close<R: Real>(&self, foot: &Foot<R>, yd: &[R; 2]) -> Result<RodMotion<R>, ClusterProblem> {
        let [cx, cy, cz] = self.joint.map(R::from_f64);
        let [kx, ky, kz] = self.crank.map(R::from_f64);
        let ([sp, cp], [sr, cr]) = (foot.pitch, foot.roll);
        let p = {
            // R_y(pitch) R_x(roll) f
            let [fx, fy, fz] = self.foot.map(R::from_f64);
            let (y, z) = (fy * cr - fz * sr, fy * sr + fz * cr);
            R::Vec3::new(fx * cp + z * sp, y, z * cp - fx * sp)
        };
        // d from the crank's joint; d·ρ = K with ρ = R_y(m) k.
        let [px, py, pz] = p.array();
        let (dx, dy, dz) = (px - cx, (py - cy) - ky, pz - cz);
        let (a, b) = (dx * kx + dz * kz, dx * kz - dz * kx);
        let k2 = self.crank[0] * self.crank[0] + self.crank[2] * self.crank[2];
        let across = R::from_f64(k2 - self.length * self.length);
        let k = (dx * dx + dy * dy + (dz * dz + across)) * R::from_f64(0.5);
        let reach2 = a * a + b * b;
        let scale = R::from_f64(k2 * (k2 + self.length * self.length));
        let Root { h, h_inv, singular } = root(reach2 - k * k, scale, self.branch)?;
        let (cm, sm) = if singular && reach2 <= scale * R::EPSILON {
            // The foot's point is on the crank's axis, and any angle closes the loop.
            (R::ONE, R::ZERO)
        } else {
            let r_inv = R::ONE / reach2;
            ((a * k + b * h) * r_inv, (b * k - a * h) * r_inv)
        };
        let (rx, rz) = (kx * cm + kz * sm, kz * cm - kx * sm);
        // From the crank's end to the foot: e, of the rod's length; ρ′ = y × ρ = (ρ_z, 0, −ρ_x), of
        // e·ρ′ = h.
        let (ex, ey, ez) = (dx - rx, dy, dz - rz);
        let e = R::Vec3::new(ex, ey, ez);
        // Foot rates of unit pitch and roll, and the motor's: ṁ e·ρ′ = e·ṗ.
        let p_pitch = R::Vec3::new(pz, R::ZERO, -px);
        let p_roll = foot.axis.cross(p);
        let g = [e.dot(p_pitch) * h_inv, e.dot(p_roll) * h_inv];
        let tangent = R::Vec3::new(rz, R::ZERO, -rx);
        let columns = [p_pitch - tangent * g[0], p_roll - tangent * g[1]];
        let md = g[0] * yd[0] + g[1] * yd[1];
        let ed = columns[0] * yd[0] + columns[1] * yd[1];
        // p̈ + ṁ² ρ at ÿ = m̈ = 0, and m̈ e·ρ′ = e·that + ė·ė.
        let radial = R::Vec3::new(rx, R::ZERO, rz);
        let pdd = foot.alpha.cross(p) + foot.omega.cross(foot.omega.cross(p));
        let rest = pdd + radial * (md * md);
        let mdd = (e.dot(rest) + ed.dot(ed)) * h_inv;
        let edd = rest - tangent * mdd;
        // e = −l (sin α cos v, −sin v, cos α cos v) with α = m + u.
        let flat2 = ex * ex + ez * ez;
        let level = root(flat2, R::from_f64(self.length * self.length), Branch::Positive)?;
        let (flat, flat_inv) = (level.h, level.h_inv);
        let flat2_inv = flat_inv * flat_inv;
        let l_inv = R::from_f64(1.0 / self.length);
        let (sa, ca) = if level.singular {
            direction(-ex, -ez, flat2)
        } else {
            (-(ex * flat_inv), -(ez * flat_inv))
        };
        let (sv, cv) = (ey * l_inv, flat * l_inv);
        let turn = |d: R::Vec3| {
            let [x, _, z] = d.array();
            (ez * x - ex * z) * flat2_inv
        };
        let lift = |d: R::Vec3| d.array()[1] * flat_inv;
        let [edx, edy, edz] = ed.array();
        let alpha_d = turn(ed);
        let two = alpha_d + alpha_d;
        let alpha_dd = turn(edd) - two * ((ex * edx + ez * edz) * flat2_inv);
        let vd = edy * flat_inv;
        let vdd = lift(edd) + ey * vd * vd * flat_inv;
        // One by one: a loop is not removed where no effect reads the angles.
        let q = [of_unit(sm, cm), of_unit(sa * cm - ca * sm, ca * cm + sa * sm), of_unit(sv, cv)];
        let rows = [g, [turn(columns[0]) - g[0], turn(columns[1]) - g[1]], columns.map(lift)];
        Ok((q, rows, [mdd, alpha_dd - mdd, vdd], singular | level.singular))
    }
}

impl Cluster<8, 2> for ParallelAnkle {
    const INDEPENDENT: [Option<usize>; 8] = [Some(0), Some(1), None, None, None, None, None, None];

    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        [pitch, roll]: &[JointCoordinate<R>; 2],
        yd: &[R; 2],
    ) -> Result<ClusterMotion<R, 8, 2>, ClusterProblem> {
        let (one, zero) = (R::ONE, R::ZERO);
        let axis = R::Vec3::new(pitch.cos, zero, -pitch.sin);
        // ẏ × axis = (−sin, 0, −cos) at unit pitch.
        let foot = Foot {
            pitch: [pitch.sin, pitch.cos],
            roll: [roll.sin, roll.cos],
            axis,
            omega: axis * yd[1] + R::Vec3::new(zero, yd[0], zero),
            alpha: R::Vec3::new(-pitch.sin, zero, -pitch.cos) * (yd[0] * yd[1]),
        };
        let (q0, g0, b0, singular0) = self.rods[0].close(&foot, yd)?;
        let (q1, g1, b1, singular1) = self.rods[1].close(&foot, yd)?;
        Ok(ClusterMotion {
            q: [*pitch, *roll, q0[0], q0[1], q0[2], q1[0], q1[1], q1[2]],
            g: [[one, zero], [zero, one], g0[0], g0[1], g0[2], g1[0], g1[1], g1[2]],
            bias: [zero, zero, b0[0], b0[1], b0[2], b1[0], b1[1], b1[2]],
            singular: singular0 | singular1,
        })
    }
}
