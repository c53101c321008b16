//! The planar five-bar linkage.

use super::dyad::{Branch, Dyad, Lengths};
use super::zero::Zero;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::trig::Kernel;

/// A planar five-bar: two cranks on one body, each with a rod, and the rods' ends joined. M = 4, N
/// = 2, y = (q₀, q₂).
///
/// Legs and arms with both motors at the body are of this kind. In the plane across the joints'
/// axes, which are parallel and point the same way, x leads from the first crank's joint to the
/// second's, both on the parent body. The spanning tree's joint coordinates, in this order and in
/// rad, are:
///
/// | q | joint | angle |
/// |---|---|---|
/// | 0 | first crank on the parent | of the crank, from x |
/// | 1 | first rod on the first crank | of the rod, from its crank |
/// | 2 | second crank on the parent | of the crank, from x |
/// | 3 | second rod on the second crank | of the rod, from its crank |
///
/// each less its [`FiveBar::zeros`]. The loop is cut between the rods' ends. The ground may be 0:
/// cranks on one axis.
///
/// [`Branch::Positive`]: the second rod's direction is counterclockwise from the first's, by less
/// than π.
///
/// # Cost
/// Some 130 flops, a division and a reciprocal root; sines and cosines of y. An effect that reads
/// the angles q₁ and q₃ themselves adds two arc tangents.
///
/// # Errors
/// [`ClusterProblem::CannotClose`] where the rods do not reach each other. If they are in line,
/// [`ClusterMotion::singular`] is set, as by [`FourBar`](super::FourBar).
///
/// # Source
/// The intersection of two circles and its derivatives; Cervantes-Sánchez, Hernández-Rodríguez &
/// Angeles (2001).
///
/// ```
/// use dynamics_core::clusters::{Branch, Cluster, FiveBar};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// // Both cranks on one axis, as of a jumping leg: at angles of ±120° from the axis of symmetry the rods meet on it.
/// const LEG: FiveBar = FiveBar::new(0.0, [0.1, 0.2], [0.1, 0.2], Branch::Negative);
/// let y = [-2.0, 2.0].map(JointCoordinate::revolute);
/// let motion = LEG.evaluate::<f64, Native>(&y, &[1.0, -1.0])?;
/// assert!((motion.q[1].q + motion.q[3].q).abs() < 1e-14); // symmetric
/// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FiveBar {
    ground: f64,
    cranks: [f64; 2],
    rods: Lengths,
    branch: Branch,
    zeros: [Zero; 4],
}

impl FiveBar {
    /// A linkage of these lengths, m: between the cranks' joints; of the first crank and its rod;
    /// of the second and its.
    ///
    /// # Panics
    /// If a link's length is not positive, the ground's is negative, or the linkage closes at no y;
    /// in a `const` this does not compile.
    pub const fn new(ground: f64, first: [f64; 2], second: [f64; 2], branch: Branch) -> Self {
        let cranks = [first[0], second[0]];
        assert!(
            ground >= 0.0 && ground.is_finite(),
            "the distance of the cranks is negative or not finite"
        );
        assert!(
            cranks[0] > 0.0 && cranks[0].is_finite() && cranks[1] > 0.0 && cranks[1].is_finite(),
            "a link's length is not positive"
        );
        let reach = ground + cranks[0] + cranks[1];
        let rods = Lengths::new(first[1], second[1], reach);
        let all = [ground, cranks[0], cranks[1], rods.b1, rods.b2];
        let (sum, mut i) = (reach + rods.b1 + rods.b2, 0);
        while i < all.len() {
            assert!(
                2.0 * all[i] <= sum,
                "the longest link of a five-bar is longer than the other four"
            );
            i += 1;
        }
        Self { ground, cranks, rods, branch, zeros: [Zero::at(0.0); 4] }
    }

    /// The same, of joints whose coordinates are zero at these angles of the table above, rad.
    #[must_use]
    pub const fn zeros(mut self, angles: [f64; 4]) -> Self {
        let mut i = 0;
        while i < angles.len() {
            self.zeros[i] = Zero::at(angles[i]);
            i += 1;
        }
        self
    }
}

impl Cluster<4, 2> for FiveBar {
    const INDEPENDENT: [Option<usize>; 4] = [Some(0), None, Some(1), None];

    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        [y0, y1]: &[JointCoordinate<R>; 2],
        &[first, second]: &[R; 2],
    ) -> Result<ClusterMotion<R, 4, 2>, ClusterProblem> {
        let (e0, e1) = (self.zeros[0].direction(y0), self.zeros[2].direction(y1));
        let a = e0.map(|e| R::from_f64(self.cranks[0]) * e);
        let b = e1.map(|e| R::from_f64(self.cranks[1]) * e);
        let w = [R::from_f64(self.ground) + b[0] - a[0], b[1] - a[1]];
        let dyad = Dyad::close(w, &self.rods, self.branch)?;
        let rod = dyad.b2_e2.map(|e| e * R::from_f64(1.0 / self.rods.b2));
        // ẇ = b⊥ ẏ₁ − a⊥ ẏ₀, and ẅ = a ẏ₀² − b ẏ₁² at ÿ = 0.
        let [g10, g30] = dyad.rates(&self.rods, [a[1], -a[0]]);
        let [g11, g31] = dyad.rates(&self.rods, [-b[1], b[0]]);
        let rates = [g10 * first + g11 * second, g30 * first + g31 * second];
        let centripetal = dyad.centripetal(&self.rods, rates);
        let (ff, ss) = (first * first, second * second);
        let z = [0, 1].map(|i| (a[i] * ff - b[i] * ss) + centripetal[i]);
        let [bias1, bias3] = dyad.rates(&self.rods, z);
        let (one, zero) = (R::ONE, R::ZERO);
        Ok(ClusterMotion {
            q: [*y0, self.zeros[1].coordinate(e0, dyad.e1), *y1, self.zeros[3].coordinate(e1, rod)],
            g: [[one, zero], [g10 - one, g11], [zero, one], [g30, g31 - one]],
            bias: [zero, bias1, zero, bias3],
            singular: dyad.singular,
        })
    }
}
