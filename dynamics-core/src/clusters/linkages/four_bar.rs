//! The planar four-bar linkage.

use super::dyad::{Branch, Dyad, Lengths};
use super::zero::Zero;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::trig::Kernel;

/// A planar four-bar: a crank and a rocker on one body, and a coupler between their ends. M = 3, N
/// = 1, y = q₀.
///
/// In the plane across the three joints' axes, which are parallel and point the same way, x leads
/// from the crank's joint to the rocker's, both on the parent body. The spanning tree's joint
/// coordinates, in this order and in rad, are:
///
/// | q | joint | angle |
/// |---|---|---|
/// | 0 | crank on the parent | of the crank, from x |
/// | 1 | coupler on the crank | of the coupler, from the crank |
/// | 2 | rocker on the parent | of the rocker, from x |
///
/// each less its [`FourBar::zeros`]. The loop is cut between the ends of coupler and rocker: crank
/// e₀ + coupler e₁ = ground x + rocker e₂. Any of the links may be the longest; the crank is that
/// of which y is the angle, and need not be able to turn.
///
/// [`Branch::Positive`]: the rocker's direction is counterclockwise from the coupler's, by less
/// than π. The branch does not change while y moves, as the linkage itself cannot change it but at
/// a singularity.
///
/// # Cost
/// Some 85 flops, a division and a reciprocal root; sine and cosine of y, and none of q₁ and q₂.
/// An effect that reads the angles q₁ and q₂ themselves adds two arc tangents.
///
/// # Errors
/// [`ClusterProblem::CannotClose`] for a y that the crank does not reach. If coupler and rocker
/// are in line, such as at the change points of a Grashof linkage (shortest + longest = sum of the
/// other two) and in a flat parallelogram, [`ClusterMotion::singular`] is set: the sine of the
/// angle between them is below √(σ · longest · longer of the two) / rocker. σ is 10⁻⁹ in f64 and
/// 256 ε in f32, which is 0.002° and 0.3° where these lengths are equal. Beyond that the error of Ġ
/// ẏ is at most some 5·10⁻³ ẏ² in f64; in f32 it is 0.3 ẏ² there, and decreases with the cube of
/// the angle.
///
/// # Source
/// Freudenstein's equation (1955); McCarthy & Soh, *Geometric Design of Linkages* (2011), section
/// 2.2.
///
/// ```
/// use dynamics_core::clusters::{Branch, Cluster, FourBar};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// // A parallelogram: the rocker turns as the crank does, the coupler keeps its direction.
/// const PARALLEL: FourBar = FourBar::new(0.3, 0.1, 0.3, 0.1, Branch::Positive);
/// let motion = PARALLEL.evaluate::<f64, Native>(&[JointCoordinate::revolute(1.2)], &[2.0])?;
/// assert!((motion.q[2].q - 1.2).abs() < 1e-15 && (motion.q[1].q + 1.2).abs() < 1e-15);
/// assert!((motion.g[2][0] - 1.0).abs() < 1e-15 && motion.bias[2].abs() < 1e-14);
/// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
/// ```
///
/// Lengths that close at no angle do not compile:
///
/// ```compile_fail,E0080
/// use dynamics_core::clusters::{Branch, FourBar};
/// const BROKEN: FourBar = FourBar::new(1.0, 0.1, 0.3, 0.1, Branch::Positive);
/// const _: FourBar = BROKEN; // error: the longest link of a four-bar is longer than the other three
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar {
    ground: f64,
    crank: f64,
    links: Lengths,
    branch: Branch,
    zeros: [Zero; 3],
}

impl FourBar {
    /// A linkage of these lengths, m: from the crank's joint to the rocker's, of the crank, the
    /// coupler, the rocker.
    ///
    /// # Panics
    /// If a length is not positive or the longest is longer than the other three; in a `const` this
    /// does not compile.
    pub const fn new(ground: f64, crank: f64, coupler: f64, rocker: f64, branch: Branch) -> Self {
        assert!(
            ground > 0.0 && ground.is_finite() && crank > 0.0 && crank.is_finite(),
            "a link's length is not positive"
        );
        let reach = if ground > crank { ground } else { crank };
        let links = Lengths::new(coupler, rocker, reach);
        let all = [ground, crank, coupler, rocker];
        let (mut sum, mut longest, mut i) = (0.0, 0.0, 0);
        while i < all.len() {
            sum += all[i];
            if all[i] > longest {
                longest = all[i];
            }
            i += 1;
        }
        assert!(
            2.0 * longest <= sum,
            "the longest link of a four-bar is longer than the other three"
        );
        Self { ground, crank, links, branch, zeros: [Zero::at(0.0); 3] }
    }

    /// The same, of joints whose coordinates are zero at these angles of the table above, rad.
    #[must_use]
    pub const fn zeros(mut self, angles: [f64; 3]) -> Self {
        self.zeros = [Zero::at(angles[0]), Zero::at(angles[1]), Zero::at(angles[2])];
        self
    }
}

impl Cluster<3, 1> for FourBar {
    const INDEPENDENT: [Option<usize>; 3] = [Some(0), None, None];

    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        [y]: &[JointCoordinate<R>; 1],
        &[yd]: &[R; 1],
    ) -> Result<ClusterMotion<R, 3, 1>, ClusterProblem> {
        let e0 = self.zeros[0].direction(y);
        let [x0, y0] = e0.map(|e| R::from_f64(self.crank) * e);
        // From the crank's end to the rocker's joint.
        let w = [R::from_f64(self.ground) - x0, -y0];
        let dyad = Dyad::close(w, &self.links, self.branch)?;
        let e2 = dyad.b2_e2.map(|e| e * R::from_f64(1.0 / self.links.b2));
        // At a unit rate of the crank ẇ is −crank e₀⊥, and ẅ = crank e₀.
        let [g1, g2] = dyad.rates(&self.links, [y0, -x0]);
        let [cx, cy] = dyad.centripetal(&self.links, [g1, g2]);
        let [b1, b2] = dyad.rates(&self.links, [x0 + cx, y0 + cy]);
        let squared = yd * yd;
        Ok(ClusterMotion {
            q: [*y, self.zeros[1].coordinate(e0, dyad.e1), self.zeros[2].of(e2)],
            g: [[R::ONE], [g1 - R::ONE], [g2]],
            bias: [R::ZERO, b1 * squared, b2 * squared],
            singular: dyad.singular,
        })
    }
}
