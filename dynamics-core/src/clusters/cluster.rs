//! One cluster: joint coordinates that are a function of fewer independent ones.

use core::fmt;

use crate::engine::{Index, for_each_joint};
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::state::all_finite;
use crate::trig::Kernel;

/// M joint coordinates q of a spanning tree as a function q = γ(y) of N independent coordinates y:
/// a loop, or several.
///
/// Implemented by the linkages of this module, by [`Transmission`](crate::drivetrain::Transmission)
/// and by the user's own:
///
/// ```
/// use dynamics_core::clusters::{Cluster, ClusterMotion, ClusterProblem};
/// use dynamics_core::{model::JointCoordinate, scalar::Real, trig::Kernel};
///
/// /// A slide that an eccentric of this radius, m, pushes up: q = (y, r sin y).
/// #[derive(Clone, Copy)]
/// struct ScotchYoke(f64);
///
/// impl Cluster<2, 1> for ScotchYoke {
///     const INDEPENDENT: [Option<usize>; 2] = [Some(0), None];
///
///     fn evaluate<R: Real, K: Kernel<R>>(
///         &self,
///         [y]: &[JointCoordinate<R>; 1],
///         [yd]: &[R; 1],
///     ) -> Result<ClusterMotion<R, 2, 1>, ClusterProblem> {
///         let r = R::from_f64(self.0);
///         Ok(ClusterMotion {
///             q: [*y, JointCoordinate::linear(r * y.sin)],
///             g: [[R::ONE], [r * y.cos]],
///             bias: [R::ZERO, -(r * y.sin * *yd * *yd)],
///             singular: false,
///         })
///     }
/// }
///
/// let crank = [JointCoordinate::revolute(0.5_f64)];
/// let motion = ScotchYoke(0.1).evaluate::<f64, dynamics_core::scalar::Native>(&crank, &[2.0])?;
/// assert!((motion.q[1].q - 0.1 * 0.5_f64.sin()).abs() < 1e-15);
/// # Ok::<(), ClusterProblem>(())
/// ```
///
/// # Source
/// Jain, *Robot and Multibody Dynamics* (2011), chapter 11, constraint embedding; Chignoli, Adrian,
/// Kim & Wensing (2023).
pub trait Cluster<const M: usize, const N: usize>: Copy {
    /// The independent coordinate that each joint coordinate is, of those that are one.
    ///
    /// Its row of G must be a unit row, and its Ġ ẏ zero: no product with them is computed. `None`,
    /// which is the default, is right for every row. A number beyond N does not compile.
    const INDEPENDENT: [Option<usize>; M] = [None; M];

    /// γ(y), G and Ġ ẏ.
    ///
    /// `y` are the independent coordinates with their sines and cosines by the kernel K, which also
    /// serves for those of the results: [`JointCoordinate::with_kernel`]. |y| ≤ 100 rad where all
    /// the cluster's joints have limits within ±4π, else 10⁴ rad.
    ///
    /// # Errors
    /// [`ClusterProblem`] where no configuration belongs to y. If y and ẏ are finite, every
    /// result must be finite; at a singularity of G the results are those of a damped G, and
    /// `singular` is set.
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        y: &[JointCoordinate<R>; N],
        yd: &[R; N],
    ) -> Result<ClusterMotion<R, M, N>, ClusterProblem>;
}

/// Position, G and Ġ ẏ of a cluster: q = γ(y), q̇ = G ẏ, q̈ = G ÿ + Ġ ẏ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClusterMotion<R, const M: usize, const N: usize> {
    /// The joint coordinates γ(y), rad or m, those of angles with sine and cosine.
    pub q: [JointCoordinate<R>; M],
    /// G = ∂γ/∂y, a row for each joint coordinate.
    pub g: [[R; N]; M],
    /// Ġ ẏ, rad/s² or m/s²: the joints' acceleration at ÿ = 0.
    pub bias: [R; M],
    /// Whether y is at or near a singularity, where G and Ġ ẏ are damped and do not close the loop.
    /// For the linkages of this module, that begins where rounding errors of Ġ ẏ are some
    /// thousandths of ẏ² in f64, and as large as ẏ² in f32.
    pub singular: bool,
}

impl<R: Real, const M: usize, const N: usize> ClusterMotion<R, M, N> {
    /// Gᵀ τ: the torques at y that do the work of the joints' torques τ.
    #[cfg_attr(optimised, inline(always))]
    pub fn torque(&self, tau: &[R; M]) -> [R; N] {
        core::array::from_fn(|k| {
            let mut terms = self.g.iter().zip(tau).map(|(row, &tau)| row[k] * tau);
            let first = terms.next().unwrap_or_default();
            terms.fold(first, |sum, term| sum + term)
        })
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let q = self.q.iter().all(|q| all_finite(&[q.q, q.sin, q.cos]));
        q && self.g.iter().all(|row| all_finite(row)) && all_finite(&self.bias)
    }
}

/// aᵀ b, without a loop and without an addition to zero.
#[cfg_attr(optimised, inline(always))]
pub(super) fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let mut sum = R::ZERO;
    for_each_joint!(K, {
        if Index::<K, N>::IS_BELOW {
            let term = a[K] * b[K];
            sum = if K == 0 { term } else { sum + term };
        }
    });
    sum
}

/// Adds gᵏ τ to each of the sums, or begins them.
#[cfg_attr(optimised, inline(always))]
pub(super) fn add_torque<R: Real, const N: usize>(sums: &mut [Option<R>; N], g: &[R; N], tau: R) {
    for_each_joint!(K, {
        if Index::<K, N>::IS_BELOW {
            add(&mut sums[K], g[K] * tau);
        }
    });
}

/// Adds a term to a sum, or begins it: without an addition to zero.
#[cfg_attr(optimised, inline(always))]
pub(super) fn add<R: Real>(sum: &mut Option<R>, term: R) {
    *sum = Some(sum.map_or(term, |sum| sum + term));
}

/// Why a cluster has no motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ClusterProblem {
    /// The links do not reach each other at these independent coordinates.
    CannotClose,
    /// An iteration has not converged.
    NotConverged,
    /// A coordinate or a torque is not finite.
    NotFinite,
    /// Forward dynamics: some motion of the cluster moves no inertia.
    NoInertia,
}

/// A cluster that has no motion, or no forward dynamics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ClusterError {
    /// The cluster's name.
    pub cluster: &'static str,
    /// The mistake in it.
    pub problem: ClusterProblem,
}

impl fmt::Display for ClusterError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self.problem {
            ClusterProblem::CannotClose => "the links do not reach each other",
            ClusterProblem::NotConverged => "the iteration has not converged",
            ClusterProblem::NotFinite => "a coordinate or a torque is not finite",
            ClusterProblem::NoInertia => "it moves no inertia in some direction",
        };
        write!(out, "cluster `{}`: {text}", self.cluster)
    }
}

impl core::error::Error for ClusterError {}
