//! A belt or cable over pulleys that are not round.

use super::constant::finite;
use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::trig::Kernel;

/// A joint that a motor drives with a ratio that depends on its angle: q = Σ cₖ yᵏ, the ratio dq/dy
/// = Σ k cₖ yᵏ⁻¹. M = 2, N = 1.
///
/// A belt, chain or cable over pulleys that are not round. Joint coordinates, in this order, in rad
/// or m: the driving pulley, which is a body of the tree, q₀ = y, and the joint q₁ = Σ cₖ yᵏ. Both
/// are on the parent body, or the pulley on the parent and the joint wherever the tree has it
/// within the cluster.
///
/// # Cost
/// 6 C flops for C coefficients, and sine and cosine of q₁.
///
/// # Errors
/// [`ClusterProblem::NotFinite`] where the polynomial overflows.
///
/// # Source
/// Horner's scheme with its first two derivatives.
///
/// ```
/// use dynamics_core::clusters::{Belt, Cluster};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// // A ratio of 1/2 in the middle that grows by 0.1 in each rad.
/// const SPIRAL: Belt<3> = Belt::new([0.0, 0.5, 0.05]);
/// let motion = SPIRAL.evaluate::<f64, Native>(&[JointCoordinate::linear(1.0)], &[2.0])?;
/// assert!((motion.q[1].q - 0.55).abs() < 1e-15 && (motion.g[1][0] - 0.6).abs() < 1e-15);
/// assert!((motion.bias[1] - 0.4).abs() < 1e-15); // 0.1 ẏ²
/// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belt<const C: usize> {
    coefficients: [f64; C],
}

impl<const C: usize> Belt<C> {
    /// A belt with the coefficients c₀, c₁, …
    ///
    /// # Panics
    /// If a coefficient is not finite; in a `const` this does not compile.
    pub const fn new(coefficients: [f64; C]) -> Self {
        let mut i = 0;
        while i < C {
            assert!(coefficients[i].is_finite(), "a coefficient of a belt is not finite");
            i += 1;
        }
        Self { coefficients }
    }
}

impl<const C: usize> Cluster<2, 1> for Belt<C> {
    const INDEPENDENT: [Option<usize>; 2] = [Some(0), None];

    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        [y]: &[JointCoordinate<R>; 1],
        &[yd]: &[R; 1],
    ) -> Result<ClusterMotion<R, 2, 1>, ClusterProblem> {
        // q, q′ and q″/2.
        let [mut q, mut ratio, mut half] = [R::ZERO; 3];
        for &c in self.coefficients.iter().rev() {
            half = half * y.q + ratio;
            ratio = ratio * y.q + q;
            q = q * y.q + R::from_f64(c);
        }
        finite(&[q, ratio, half])?;
        Ok(ClusterMotion {
            q: [*y, JointCoordinate::with_kernel::<K>(q)],
            g: [[R::ONE], [ratio]],
            bias: [R::ZERO, (half + half) * (yd * yd)],
            singular: false,
        })
    }
}
