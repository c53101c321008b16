//! The platform on six legs.

use super::dyad::{Branch, Root, root};
use super::hook::Hook;
use super::platform::Platform;
use crate::clusters::cluster::dot;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::{Real, Vector};
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

/// A platform on six legs of variable length (Gough; Stewart, 1965). M = 24, N = 6, y = the platform's position x, y, z
/// and yaw, pitch, roll.
///
/// The attitude is R_z(yaw) R_y(pitch) R_x(roll), the `rpy` of URDF. The spanning tree's joint coordinates, in this
/// order and in m and rad, are:
///
/// | q | joint | axis, in the body's frame |
/// |---|---|---|
/// | 0, 1, 2 | platform on the base | prismatic x, y, z |
/// | 3, 4, 5 | platform: yaw, pitch, roll | z, y, x |
/// | 6, 7 | lower half of the first leg on the base | y, x |
/// | 8 | upper half of the first leg on the lower | prismatic z |
/// | 9 … 23 | the same of the other legs | |
///
/// The bodies between these axes have no mass. At zero all frames have the base's axes, and a leg points along z. The
/// loops are cut at the ball joints on the platform; both halves of a leg are bodies, which do not spin about the leg.
///
/// The motors are at the slides: [`Driven::actuated`](crate::clusters::Driven::actuated)`([8, 11, 14, 17, 20, 23])`.
/// The motion of the platform determines that of the legs everywhere, the reverse has no closed form. Configurations in
/// which no forces of the legs hold the platform are therefore not singular for this cluster, but dead points of the
/// motors: [`TreeMotion::to_motors`](crate::clusters::TreeMotion::to_motors) names them.
///
/// # Cost
/// Some 1,200 flops, six divisions and twelve reciprocal roots; sines and cosines of the attitude only. Where an effect
/// reads the angles of the legs themselves, twelve arc tangents.
///
/// # Errors
/// None of a finite y. Where a leg has no length or is parallel to y, [`ClusterMotion::singular`] is set: within an angle
/// of 3·10⁻⁵ rad in f64 and 6·10⁻³ rad in f32, and at a length of as much of the largest leg's reach.
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
    /// What rounding errors are relative to, m².
    scale: f64,
}

impl Stewart {
    /// Of these legs.
    ///
    /// # Panics
    /// If a number is not finite or a length is negative; in a `const` this does not compile.
    pub const fn new(legs: [Leg; 6]) -> Self {
        let (mut i, mut scale) = (0, 0.0);
        while i < legs.len() {
            let Leg {
                base,
                platform,
                length,
            } = &legs[i];
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

/// What a leg adds to the cluster: its three coordinates, their rows of G, and Ġ ẏ.
struct LegMotion<R> {
    q: [JointCoordinate<R>; 3],
    g: [[R; 6]; 3],
    bias: [R; 3],
    singular: bool,
}

impl Leg {
    #[cfg_attr(not(debug_assertions), inline(always))]
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
        let Root {
            h: l,
            h_inv: l_inv,
            singular,
        } = root(l2, scale, Branch::Positive)?;
        let hook = if singular {
            Hook::<R>::short(z, scale)?
        } else {
            Hook::<R>::of(z, l_inv, l2)?
        };
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

    #[cfg_attr(not(debug_assertions), inline(always))]
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
