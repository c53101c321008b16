//! Clusters of constant G: the transmission, and the differential.

use crate::clusters::{Cluster, ClusterMotion, ClusterProblem};
use crate::drivetrain::Transmission;
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::state::all_finite;
use crate::trig::Kernel;

/// The simplest cluster: q = G y + q₀ of a constant matrix, y in rad or m at the motors.
///
/// With the joints of the spanning tree for q: gears, belts, cables, mimic joints. Rotors may be
/// bodies of their own, with a row of their gear ratio each. M = V of the transmission, N = its M.
///
/// # Cost
/// 2 M N flops, and a sine and cosine for each joint.
///
/// # Errors
/// [`ClusterProblem::NotFinite`] where a sum overflows.
impl<const N: usize, const M: usize> Cluster<M, N> for Transmission<f64, N, M> {
    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        y: &[JointCoordinate<R>; N],
        _: &[R; N],
    ) -> Result<ClusterMotion<R, M, N>, ClusterProblem> {
        let g = self.matrix.map(|row| row.map(R::from_f64));
        let mut q = self.offset.map(R::from_f64);
        for (q, row) in q.iter_mut().zip(&g) {
            for (y, &g) in y.iter().zip(row) {
                *q += g * y.q;
            }
        }
        finite(&q)?;
        Ok(ClusterMotion {
            q: q.map(JointCoordinate::with_kernel::<K>),
            g,
            bias: [R::ZERO; M],
            singular: false,
        })
    }
}

/// Refuses numbers of which one is not finite.
#[cfg_attr(optimised, inline(always))]
pub(super) fn finite<R: Real>(values: &[R]) -> Result<(), ClusterProblem> {
    if all_finite(values) { Ok(()) } else { Err(ClusterProblem::NotFinite) }
}

/// A differential: two motors that together pitch, and against each other roll. M = 2, N = 2, y the
/// motors' angles.
///
/// Joint coordinates, in this order and in rad: pitch q₀ = (y₀ + y₁) / 2 i and roll q₁ = (y₀ − y₁)
/// / 2 j of the gear ratios i and j, the roll being about an axis that moves with the pitch. Bevel
/// gears and cable differentials have i = 1 between motor shafts and carrier. Rotors that are
/// bodies of the tree make it a [`Transmission`] of four rows.
///
/// # Cost
/// 2 sums and 2 products, and a sine and cosine for each joint.
///
/// # Errors
/// [`ClusterProblem::NotFinite`] where a sum overflows.
///
/// ```
/// use dynamics_core::clusters::{Cluster, Differential};
/// use dynamics_core::{model::JointCoordinate, scalar::Native};
/// const WRIST: Differential = Differential::new([1.0, 2.0]);
/// let motion = WRIST.evaluate::<f64, Native>(&[1.0, 0.2].map(JointCoordinate::linear), &[0.0; 2])?;
/// assert_eq!(motion.q.map(|q| q.q), [0.6, 0.2]);
/// assert_eq!(motion.torque(&[2.0, 0.0]), [1.0, 1.0]); // each motor carries half of the pitch
/// # Ok::<(), dynamics_core::clusters::ClusterProblem>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differential {
    halves: [f64; 2],
}

impl Differential {
    /// A differential with these gear ratios of pitch and roll.
    ///
    /// # Panics
    /// If a ratio is zero or not finite; in a `const` this does not compile.
    pub const fn new(ratios: [f64; 2]) -> Self {
        assert!(
            ratios[0] != 0.0 && ratios[0].is_finite() && ratios[1] != 0.0 && ratios[1].is_finite(),
            "a differential's ratio is zero or not finite"
        );
        Self { halves: [0.5 / ratios[0], 0.5 / ratios[1]] }
    }
}

impl Cluster<2, 2> for Differential {
    #[cfg_attr(optimised, inline(always))]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        [a, b]: &[JointCoordinate<R>; 2],
        _: &[R; 2],
    ) -> Result<ClusterMotion<R, 2, 2>, ClusterProblem> {
        let [i, j] = self.halves.map(R::from_f64);
        let q = [i * (a.q + b.q), j * (a.q - b.q)];
        finite(&q)?;
        Ok(ClusterMotion {
            q: q.map(JointCoordinate::with_kernel::<K>),
            g: [[i, i], [j, -j]],
            bias: [R::ZERO; 2],
            singular: false,
        })
    }
}
