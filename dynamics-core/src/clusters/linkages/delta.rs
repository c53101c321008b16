//! The Delta robot: three cranks with pairs of parallel rods carry a platform that does not turn.

use super::dyad::{Branch, Root, root};
use super::hook::Hook;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::{Real, Vector};
use crate::trig::Kernel;

/// A Delta robot (Clavel, 1988): three cranks with motors carry a platform, which does not turn, by pairs of parallel
/// rods. M = 12, N = 3, y = the cranks.
///
/// The base has z up; the arms are at 0°, 120° and 240° about it, counterclockwise, and the platform is below the
/// cranks. The spanning tree's joint coordinates, in this order and in rad and m, are:
///
/// | q | joint | axis, in the body's frame |
/// |---|---|---|
/// | 0 | first crank on the base, at the radius `base`, x outwards | y |
/// | 1, 2 | rods of the first crank on its end | y, x |
/// | 3, 4, 5 | the same of the second arm | |
/// | 6, 7, 8 | the same of the third arm | |
/// | 9, 10, 11 | platform on the base | prismatic x, y, z |
///
/// At zero a crank points outwards, and positive angles lower its end; the rods hang from it along −z. The rods of a
/// crank are one body, between them: of the sum of their masses and of their inertias about their own centres. That is
/// exact: parallel rods turn alike, and their centres keep their distance along the axis of the crank. Their ends on the
/// platform are at the radius `platform`; the loops are cut there. Where a pair of axes is at one place, a universal
/// joint serves, too, or a body without mass between them, which the engine takes.
///
/// # Cost
/// Some 450 flops, two divisions and five reciprocal roots; sines and cosines of y only. Where an effect reads the
/// angles of rods themselves, six arc tangents.
///
/// # Errors
/// [`ClusterProblem::CannotClose`] where the three rods do not reach one point. Where they are in one plane, the platform
/// in that of the cranks' ends, or a rod is parallel to its crank's axis, [`ClusterMotion::singular`] is set.
///
/// # Source
/// The intersection of three spheres, eₖ² = l² of the rods' vectors eₖ = p − cₖ, and its two derivatives, eₖ·ṗ = eₖ·ċₖ
/// and eₖ·p̈ = eₖ·c̈ₖ − ėₖ².
///
/// ```
/// use dynamics_core::clusters::{Cluster, Delta};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// const DELTA: Delta = Delta::new(0.2, 0.2, 0.45, 0.05);
/// // Level cranks: the platform is below the middle, at the height of Pythagoras.
/// let motion = DELTA.evaluate::<f64, Native>(&[0.0; 3].map(JointCoordinate::revolute), &[1.0; 3])?;
/// let [x, y, z] = [9, 10, 11].map(|i| motion.q[i].q);
/// let depth = (0.45_f64.powi(2) - 0.35_f64.powi(2)).sqrt();
/// assert!(x.abs() < 1e-15 && y.abs() < 1e-15 && (z + depth).abs() < 1e-15);
/// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
/// ```
///
/// Rods that are too short to reach the platform in any posture do not compile:
///
/// ```compile_fail,E0080
/// use dynamics_core::clusters::Delta;
/// const _: Delta = Delta::new(0.5, 0.1, 0.2, 0.05); // error: the rods of a Delta do not reach its platform
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delta {
    /// Of the cranks' joints less that of the rods' ends, m.
    radius: f64,
    crank: f64,
    rod: f64,
    /// What rounding errors are relative to, m².
    scale: f64,
}

/// cos and sin of 0°, 120° and 240°.
const SIDES: [(f64, f64); 3] = [
    (1.0, 0.0),
    (-0.5, 0.866_025_403_784_438_6),
    (-0.5, -0.866_025_403_784_438_6),
];

impl Delta {
    /// A robot of these lengths, m: the radius of the circle of the cranks' joints, the cranks, the rods, and the radius
    /// of the circle of the rods' ends on the platform.
    ///
    /// # Panics
    /// If a length is not finite, a crank's or rod's not positive, or the rods reach the platform in no posture with
    /// equal cranks; in a `const` this does not compile.
    pub const fn new(base: f64, crank: f64, rod: f64, platform: f64) -> Self {
        assert!(
            base.is_finite() && platform.is_finite(),
            "a radius of a Delta is not finite"
        );
        assert!(
            crank > 0.0 && crank.is_finite() && rod > 0.0 && rod.is_finite(),
            "a crank's or a rod's length is not positive"
        );
        let radius = base - platform;
        assert!(
            radius.abs() < crank + rod,
            "the rods of a Delta do not reach its platform"
        );
        let reach = radius.abs() + crank;
        let longer = if rod > reach { rod } else { reach };
        Self {
            radius,
            crank,
            rod,
            scale: longer * longer,
        }
    }
}

/// A vector in the frame of a side, or back with the sine's sign changed.
#[inline(always)]
fn turned<R: Real>([cos, sin]: [R; 2], v: R::Vec3) -> R::Vec3 {
    let [x, y, z] = v.array();
    R::Vec3::new(cos * x + sin * y, cos * y - sin * x, z)
}

/// A crank, in the frame of its side.
struct Crank<R: Real> {
    /// From the joint to its end, m.
    radial: R::Vec3,
    /// The derivative of that, m/rad.
    tangent: R::Vec3,
}

impl Cluster<12, 3> for Delta {
    #[inline(always)]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        y: &[JointCoordinate<R>; 3],
        yd: &[R; 3],
    ) -> Result<ClusterMotion<R, 12, 3>, ClusterProblem> {
        let (one, zero, half) = (R::ONE, R::ZERO, R::from_f64(0.5));
        let [radius, l, rod] = [self.radius, self.crank, self.rod].map(R::from_f64);
        let scale = R::from_f64(self.scale);
        let sides = SIDES.map(|(cos, sin)| [R::from_f64(cos), R::from_f64(sin)]);
        let back = |k: usize, v: R::Vec3| turned::<R>([sides[k][0], -sides[k][1]], v);
        let cranks = [0, 1, 2].map(|k| Crank::<R> {
            radial: R::Vec3::new(l * y[k].cos, zero, -(l * y[k].sin)),
            tangent: R::Vec3::new(-(l * y[k].sin), zero, -(l * y[k].cos)),
        });
        let ends = [0, 1, 2].map(|k| back(k, cranks[k].radial + R::Vec3::new(radius, zero, zero)));

        // The point at the distance `rod` from all ends, below them: w − h n from the first, n being a unit vector.
        let (d1, d2) = (ends[1] - ends[0], ends[2] - ends[0]);
        let normal = d1.cross(d2);
        let n2 = normal.dot(normal);
        let area = root(n2, scale * scale, Branch::Positive)?;
        if area.singular {
            return Err(ClusterProblem::CannotClose); // the ends are in one line
        }
        let (n, n2_inv) = (normal * area.h_inv, area.h_inv * area.h_inv);
        let (e2, e3) = (d2.cross(normal) * n2_inv, normal.cross(d1) * n2_inv);
        let w = e2 * (half * d1.dot(d1)) + e3 * (half * d2.dot(d2));
        let Root { h, h_inv, singular } = root(rod * rod - w.dot(w), scale, Branch::Positive)?;
        let to_platform = w - n * h;
        let p = ends[0] + to_platform;
        // The x with eₖ·x = bₖ: unit vectors of b.
        let (w2, w3) = (w.dot(e2), w.dot(e3));
        let [of_2, of_3] = [(e2, w2), (e3, w3)].map(|(e, along)| -e - n * (along * h_inv));
        let of_1 = e2 + e3 + n * ((w2 + w3 - one) * h_inv);
        let dual = [of_1, of_2, of_3];

        let rods = [0, 1, 2].map(|k| turned::<R>(sides[k], p - ends[k]));
        let columns: [R::Vec3; 3] =
            core::array::from_fn(|k| dual[k] * rods[k].dot(cranks[k].tangent));
        let pd = columns[0] * yd[0] + columns[1] * yd[1] + columns[2] * yd[2];
        let rates = [0, 1, 2].map(|k| turned::<R>(sides[k], pd) - cranks[k].tangent * yd[k]);
        // c̈ = −radial ẏ² at ÿ = 0.
        let squares = yd.map(|yd| yd * yd);
        let right =
            |k: usize| -(rods[k].dot(cranks[k].radial) * squares[k] + rates[k].dot(rates[k]));
        let pdd = dual[0] * right(0) + dual[1] * right(1) + dual[2] * right(2);

        let mut motion = ClusterMotion {
            q: [JointCoordinate::default(); 12],
            g: [[zero; 3]; 12],
            bias: [zero; 12],
            singular,
        };
        let (l_inv, rod2) = (
            R::from_f64(1.0 / self.rod),
            R::from_f64(self.rod * self.rod),
        );
        for k in 0..3 {
            let hook = Hook::<R>::of(-rods[k], l_inv, rod2)?;
            let [turn, lift] = hook.angles_from([y[k].sin, y[k].cos]);
            let zd = -rates[k];
            let zdd = -(turned::<R>(sides[k], pdd) + cranks[k].radial * squares[k]);
            let of_column = |j: usize| {
                let column = turned::<R>(sides[k], columns[j]);
                let own = if j == k {
                    column - cranks[k].tangent
                } else {
                    column
                };
                [hook.turn_rate(-own), hook.lift_rate(-own)]
            };
            let rows = [of_column(0), of_column(1), of_column(2)];
            let angular = [hook.turn_rate(zd), hook.lift_rate(zd)];
            let accelerations = hook.accelerations(zdd, angular, rod);
            let first = 3 * k;
            (motion.q[first], motion.q[first + 1], motion.q[first + 2]) = (y[k], turn, lift);
            motion.g[first][k] = one;
            motion.g[first + 1] = rows.map(|row| row[0]);
            motion.g[first + 1][k] -= one;
            motion.g[first + 2] = rows.map(|row| row[1]);
            (motion.bias[first + 1], motion.bias[first + 2]) = (accelerations[0], accelerations[1]);
            motion.singular |= hook.singular;
        }
        let columns = columns.map(R::Vec3::array);
        for (i, (&p, &pdd)) in p.array().iter().zip(&pdd.array()).enumerate() {
            motion.q[9 + i] = JointCoordinate::linear(p);
            motion.g[9 + i] = columns.map(|column| column[i]);
            motion.bias[9 + i] = pdd;
        }
        Ok(motion)
    }
}
