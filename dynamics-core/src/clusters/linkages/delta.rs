//! The Delta robot: three cranks with pairs of parallel rods carry a platform that does not turn.

use super::dyad::{Branch, Root, root};
use super::hook::Hook;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::{Real, Vector};
use crate::trig::Kernel;

/// A Delta robot (Clavel, 1988): three cranks with motors carry a platform, which does not turn, by
/// pairs of parallel rods. M = 12, N = 3, y = the cranks.
///
/// The base has z up; the arms are at 0°, 120° and 240° about it, counterclockwise, and the
/// platform is below the cranks. The spanning tree's joint coordinates, in this order and in rad
/// and m, are:
///
/// | q | joint | axis, in the body's frame |
/// |---|---|---|
/// | 0 | first crank on the base, at the radius `base`, x outwards | y |
/// | 1, 2 | rods of the first crank on its end | y, x |
/// | 3, 4, 5 | the same of the second arm | |
/// | 6, 7, 8 | the same of the third arm | |
/// | 9, 10, 11 | platform on the base | prismatic x, y, z |
///
/// At zero a crank points outwards, and positive angles lower its end; the rods hang from it along
/// −z. The rods of a crank are one body, between them: of the sum of their masses and of their
/// inertias about their own centres. Their ends on the platform are at the radius `platform`; the
/// loops are cut there. Two axes that meet are a universal joint, or two revolute joints with a
/// body without mass between them.
///
/// The one body is exact: parallel rods have the same angular velocity, and the vector between
/// their centres is parallel to the axis of the crank, so that on a base that does not turn both
/// centres have the same velocity. On a body that turns, the torques at y are exact, too; those of
/// the joints inward of it are with 2 m (d² 1 − d dᵀ) of every pair added to the body's rotational
/// inertia, m being the mass of a rod and 2 d the vector between the rods.
///
/// # Cost
/// Some 450 flops, two divisions and five reciprocal roots; sines and cosines of y only. An effect
/// that reads the angles of rods themselves adds six arc tangents.
///
/// # Errors
/// [`ClusterProblem::CannotClose`] where the three rods do not reach one point, or the cranks' ends
/// are in one line, about which the platform could turn. If the rods are in one plane, the
/// platform in that of the cranks' ends, or a rod is parallel to its crank's axis,
/// [`ClusterMotion::singular`] is set: the sine of the angle is below 3·10⁻⁵ in f64 and 6·10⁻³ in
/// f32, or as much more as the arms reach beyond a rod's length.
///
/// # Source
/// The intersection of three spheres, eₖ² = l² of the rods' vectors eₖ = p − cₖ, and its two
/// derivatives, eₖ·ṗ = eₖ·ċₖ and eₖ·p̈ = eₖ·c̈ₖ − ėₖ².
///
/// ```
/// use dynamics_core::clusters::{Cluster, Delta};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// const DELTA: Delta = Delta::new(0.2, 0.2, 0.45, 0.05);
/// // Level cranks: the rod is the hypotenuse over 0.2 + 0.2 − 0.05 and the depth of the platform.
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
    /// The radius of the cranks' joints less that of the rods' ends, m.
    radius: f64,
    crank: f64,
    rod: f64,
    /// The scale of the rounding errors, m².
    scale: f64,
}

/// cos and sin of 0°, 120° and 240°.
const SIDES: [(f64, f64); 3] =
    [(1.0, 0.0), (-0.5, 0.866_025_403_784_438_6), (-0.5, -0.866_025_403_784_438_6)];

impl Delta {
    /// A robot of these lengths, m: the radius of the circle of the cranks' joints, the cranks, the
    /// rods, and the radius of the circle of the rods' ends on the platform.
    ///
    /// # Panics
    /// If a length is not finite, a crank's or rod's not positive, or the rods reach the platform
    /// in no posture with equal cranks; in a `const` this does not compile.
    pub const fn new(base: f64, crank: f64, rod: f64, platform: f64) -> Self {
        assert!(base.is_finite() && platform.is_finite(), "a radius of a Delta is not finite");
        assert!(
            crank > 0.0 && crank.is_finite() && rod > 0.0 && rod.is_finite(),
            "a crank's or a rod's length is not positive"
        );
        let radius = base - platform;
        assert!(radius.abs() < crank + rod, "the rods of a Delta do not reach its platform");
        let reach = radius.abs() + crank;
        let longer = if rod > reach { rod } else { reach };
        Self { radius, crank, rod, scale: longer * longer }
    }
}

/// A vector in the frame of an arm at the angle of this cosine and sine.
#[cfg_attr(optimised, inline(always))]
fn turned<R: Real>([cos, sin]: [R; 2], v: R::Vec3) -> R::Vec3 {
    let [x, y, z] = v.array();
    R::Vec3::new(cos * x + sin * y, cos * y - sin * x, z)
}

/// An arm; vectors are in its own frame.
#[derive(Clone, Copy)]
struct Arm<R: Real> {
    /// cos and sin of its angle about the base.
    side: [R; 2],
    y: JointCoordinate<R>,
    yd: R,
    /// From the crank's joint to its end, m.
    radial: R::Vec3,
    /// The derivative of that, m/rad.
    tangent: R::Vec3,
    /// The crank's end, less the rod's end on the platform, in base axes, m.
    end: R::Vec3,
}

impl<R: Real> Arm<R> {
    #[cfg_attr(optimised, inline(always))]
    fn of((cos, sin): (f64, f64), y: JointCoordinate<R>, yd: R, delta: &Delta) -> Self {
        let [cos, sin, radius, length] = [cos, sin, delta.radius, delta.crank].map(R::from_f64);
        let (ahead, down) = (length * y.cos, length * y.sin);
        let radial = R::Vec3::new(ahead, R::ZERO, -down);
        Self {
            side: [cos, sin],
            y,
            yd,
            radial,
            tangent: R::Vec3::new(-down, R::ZERO, -ahead),
            end: turned::<R>([cos, -sin], radial + R::Vec3::new(radius, R::ZERO, R::ZERO)),
        }
    }

    /// A vector in base axes in the arm's.
    #[cfg_attr(optimised, inline(always))]
    fn turn(&self, v: R::Vec3) -> R::Vec3 {
        turned::<R>(self.side, v)
    }
}

/// The platform, in base axes.
struct Platform<R: Real> {
    position: R::Vec3,
    /// The x with eₖ·x = bₖ of each unit vector b.
    dual: [R::Vec3; 3],
    singular: bool,
}

impl<R: Real> Platform<R> {
    /// The point below the arms' ends, at the length of the rods from each.
    #[cfg_attr(optimised, inline(always))]
    fn of([a, b, c]: [R::Vec3; 3], delta: &Delta) -> Result<Self, ClusterProblem> {
        let [scale, half, rod2] = [delta.scale, 0.5, delta.rod * delta.rod].map(R::from_f64);
        let (d1, d2) = (b - a, c - a);
        let normal = d1.cross(d2);
        let area = root(normal.dot(normal), scale * scale, Branch::Positive)?;
        if area.singular {
            return Err(ClusterProblem::CannotClose); // the ends are in one line
        }
        // w − h n from the first end, n being a unit vector and w in the plane of the ends.
        let (n, n2_inv) = (normal * area.h_inv, area.h_inv * area.h_inv);
        let (e2, e3) = (d2.cross(normal) * n2_inv, normal.cross(d1) * n2_inv);
        let w = e2 * (half * d1.dot(d1)) + e3 * (half * d2.dot(d2));
        let Root { h, h_inv, singular } = root(rod2 - w.dot(w), scale, Branch::Positive)?;
        let (w2, w3) = (w.dot(e2), w.dot(e3));
        Ok(Self {
            position: a + w - n * h,
            dual: [
                e2 + e3 + n * ((w2 + w3 - R::ONE) * h_inv),
                -e2 - n * (w2 * h_inv),
                -e3 - n * (w3 * h_inv),
            ],
            singular,
        })
    }
}

/// Σ xₖ fₖ.
#[cfg_attr(optimised, inline(always))]
fn combined<R: Real>([a, b, c]: &[R::Vec3; 3], [x, y, z]: [R; 3]) -> R::Vec3 {
    *a * x + *b * y + *c * z
}

/// Angles, rows of G and Ġ ẏ of the rods of an arm.
struct RodsMotion<R> {
    q: [JointCoordinate<R>; 2],
    g: [[R; 3]; 2],
    bias: [R; 2],
    singular: bool,
}

/// The motion of the platform, in base axes.
struct Moving<R: Real> {
    /// ∂p/∂y by columns.
    columns: [R::Vec3; 3],
    /// p̈ at ÿ = 0.
    acceleration: R::Vec3,
}

impl<R: Real> Arm<R> {
    /// The rods: e is the vector along them from the crank, with its rate.
    #[cfg_attr(optimised, inline(always))]
    fn rods(
        &self,
        [e, ed]: [R::Vec3; 2],
        moving: &Moving<R>,
        delta: &Delta,
        own: usize,
    ) -> Result<RodsMotion<R>, ClusterProblem> {
        let [l, l_inv, l2] = [delta.rod, 1.0 / delta.rod, delta.rod * delta.rod].map(R::from_f64);
        let hook = Hook::<R>::of(-e, l_inv, l2)?;
        let edd = self.turn(moving.acceleration) + self.radial * (self.yd * self.yd);
        let (mut turn, mut lift) = ([R::ZERO; 3], [R::ZERO; 3]);
        unrolled!(J in 0 1 2, {
            let mut column = -self.turn(moving.columns[J]);
            if J == own {
                column += self.tangent;
            }
            (turn[J], lift[J]) = (hook.turn_rate(column), hook.lift_rate(column));
            if J == own {
                turn[J] -= R::ONE; // relative to the crank
            }
        });
        let rates = [hook.turn_rate(-ed), hook.lift_rate(-ed)];
        Ok(RodsMotion {
            q: hook.angles_from([self.y.sin, self.y.cos]),
            g: [turn, lift],
            bias: hook.accelerations(-edd, rates, l),
            singular: hook.singular,
        })
    }
}

impl Cluster<12, 3> for Delta {
    const INDEPENDENT: [Option<usize>; 12] = {
        let mut cranks = [None; 12];
        (cranks[0], cranks[3], cranks[6]) = (Some(0), Some(1), Some(2));
        cranks
    };

    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        y: &[JointCoordinate<R>; 3],
        yd: &[R; 3],
    ) -> Result<ClusterMotion<R, 12, 3>, ClusterProblem> {
        let [a, b, c] = [
            Arm::of(SIDES[0], y[0], yd[0], self),
            Arm::of(SIDES[1], y[1], yd[1], self),
            Arm::of(SIDES[2], y[2], yd[2], self),
        ];
        let platform = Platform::<R>::of([a.end, b.end, c.end], self)?;
        let arms = [a, b, c];
        let (mut rods, mut rates) = ([R::Vec3::ZERO; 3], [R::Vec3::ZERO; 3]);
        let (mut columns, mut right) = (platform.dual, [R::ZERO; 3]);
        unrolled!(I in 0 1 2, {
            rods[I] = arms[I].turn(platform.position - arms[I].end);
            // eₖ·∂p/∂yₖ = eₖ·tangentₖ
            columns[I] = columns[I] * rods[I].dot(arms[I].tangent);
        });
        let velocity = combined::<R>(&columns, *yd);
        unrolled!(I in 0 1 2, {
            let arm = &arms[I];
            rates[I] = arm.turn(velocity) - arm.tangent * arm.yd;
            // c̈ = −radial ẏ² at ÿ = 0.
            let crank = rods[I].dot(arm.radial) * (arm.yd * arm.yd);
            right[I] = -(crank + rates[I].dot(rates[I]));
        });
        let moving = Moving::<R> { columns, acceleration: combined::<R>(&platform.dual, right) };

        let mut motion = ClusterMotion {
            q: [JointCoordinate::default(); 12],
            g: [[R::ZERO; 3]; 12],
            bias: [R::ZERO; 12],
            singular: platform.singular,
        };
        let [p, pdd] = [platform.position.array(), moving.acceleration.array()];
        let columns = columns.map(R::Vec3::array);
        unrolled!(I in 0 1 2, {
            let rods = arms[I].rods([rods[I], rates[I]], &moving, self, I)?;
            motion.q[3 * I] = y[I];
            (motion.q[3 * I + 1], motion.q[3 * I + 2]) = (rods.q[0], rods.q[1]);
            motion.g[3 * I][I] = R::ONE;
            (motion.g[3 * I + 1], motion.g[3 * I + 2]) = (rods.g[0], rods.g[1]);
            (motion.bias[3 * I + 1], motion.bias[3 * I + 2]) = (rods.bias[0], rods.bias[1]);
            motion.singular |= rods.singular;
            motion.q[9 + I] = JointCoordinate::linear(p[I]);
            motion.g[9 + I] = [columns[0][I], columns[1][I], columns[2][I]];
            motion.bias[9 + I] = pdd[I];
        });
        Ok(motion)
    }
}
