//! The torques of a robot's motors, where they are not at the independent coordinates of its
//! clusters.

use super::description::sealed::Set;
use super::motor_torques::{MotorTorques, solve};
use super::places::TreeLayout;
use super::{Cluster, ClusterError, ClusterMotion, ClusteredRobot, Driven, TreeMotion};
use crate::scalar::Real;
use crate::state::entry;

impl<R, T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    TreeMotion<R, T, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    /// The torques of the motors that do the work of the torques τ at y, N·m or N: G_aᵀ τ_a = τ of
    /// each cluster's actuated rows.
    ///
    /// A cluster without [`Driven::actuated`](super::Driven::actuated) rows has its motors at y.
    ///
    /// # Shape
    /// Y, in the places of y.
    ///
    /// # Dead points
    /// At a dead point of the motors no torque of theirs does the work. Near it, τ_a is that of
    /// damped least squares, with the rows of A = G_aᵀ and τ over
    /// [`Driven::damped_below`](super::Driven::damped_below):
    ///
    /// ```text
    /// τ_a = Aᵀ (A Aᵀ + λ² 1)⁻¹ τ      λ² = 1 − ς² where ς² = 1 / tr (A Aᵀ)⁻¹ < 1
    /// ```
    ///
    /// ς, at most the least singular value of A, is the distance from the dead point; from one on
    /// there is no damping. Everywhere |τ_a| ≤ |τ| of these rows, and there is no jump where the
    /// damping ends.
    ///
    /// # Cost
    /// N³/3 + 3 N² multiplications and N divisions for each cluster: 1,220 cycles of a Cortex-M4F
    /// with six motors. Near a dead point some 5 N³ more: 11,500 cycles.
    ///
    /// # Source
    /// Nakamura & Hanafusa (1986); Wampler (1986).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::Core;
    /// use dynamics_core::clusters::{Branch, Clustered, ClusteredRobot, Driven, FourBar};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
    /// use dynamics_core::state::State;
    /// # struct Knee;
    /// # impl Robot<3, 3, 3> for Knee {
    /// #     const MODEL: ArmModel<f64, 3> = Model::new("knee", [
    /// #         Body::new("crank", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(0.1).com([0.02, 0.0, 0.0]),
    /// #         Body::new("rod", 0, Joint::revolute([0.0, 0.0, 1.0])).xyz([0.05, 0.0, 0.0]).mass(0.1)
    /// #             .com([0.1, 0.0, 0.0]),
    /// #         Body::new("shank", BASE, Joint::revolute([0.0, 0.0, 1.0])).xyz([0.2, 0.0, 0.0]).mass(1.0)
    /// #             .com([0.0, -0.2, 0.0]),
    /// #     ]);
    /// # }
    /// impl ClusteredRobot<3, 3, 3, 1, 1> for Knee {
    ///     type Clusters = (Driven<FourBar, 3, 1>,);
    ///     // y is the angle of the crank, and the motor is at the shank.
    ///     const CLUSTERS: Self::Clusters =
    ///         (Driven::new("knee", FourBar::new(0.2, 0.05, 0.2, 0.06, Branch::Positive)).actuated([2]),);
    ///     const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
    /// }
    /// let at = |crank: f64| Clustered::<Core<Knee>>::motion(&State::at([crank]));
    /// let knee = at(1.0)?;
    /// let motors = knee.to_motors(&[1.0])?;
    /// assert_eq!(motors.singular, None);
    /// assert!((knee.from_motors(&motors.tau)[0] - 1.0).abs() < 1e-15);
    /// // Crank and rod in line: the law of cosines in the triangle of 0.2 + 0.05, 0.2 and 0.06.
    /// let in_line = (0.25_f64 * 0.25 + 0.2 * 0.2 - 0.06 * 0.06) / (2.0 * 0.25 * 0.2);
    /// let dead = at(in_line.acos())?.to_motors(&[1.0])?;
    /// assert_eq!(dead.singular, Some("knee"));
    /// assert!(dead.tau[0].abs() < 100.0); // N·m, 1 over `DEAD_POINT`
    /// # Ok::<(), dynamics_core::clusters::ClusterError>(())
    /// ```
    ///
    /// # Errors
    /// [`ClusterProblem::NotFinite`](super::ClusterProblem::NotFinite) names a cluster of which a
    /// torque is not finite.
    #[cfg_attr(optimised, inline(always))]
    pub fn to_motors(&self, tau: &[R; Y]) -> Result<MotorTorques<R, Y>, ClusterError> {
        let mut out = MotorTorques { tau: *tau, singular: None };
        let clusters = const { T::CLUSTERS };
        clusters.motors::<R, T, B, Q, V, P, Y>(&self.motions, &mut out)?;
        Ok(out)
    }

    /// The torques at y of the motors' torques, N·m or N: G_aᵀ τ_a, the inverse of
    /// [`TreeMotion::to_motors`].
    ///
    /// # Shape
    /// Y, in the places of y.
    ///
    /// # Cost
    /// 2 N² flops for each cluster with motors at actuated rows.
    ///
    /// # Example
    /// See the example of [`TreeMotion::to_motors`].
    pub fn from_motors(&self, tau: &[R; Y]) -> [R; Y] {
        let (mut out, set) = (*tau, const { T::CLUSTERS });
        for c in 0..<T::Clusters as Set>::SIZES.len() {
            let (Some(actuated), Some(&[_, first])) = (set.actuated(c), Self::LAYOUT.first.get(c))
            else {
                continue;
            };
            for (k, out) in out.iter_mut().skip(first).take(actuated.len()).enumerate() {
                let motors = actuated.iter().zip(tau.iter().skip(first));
                *out = motors.fold(R::ZERO, |sum, (&row, &tau)| {
                    let (g, _) = <T::Clusters as Set>::row(&self.motions, c, row);
                    sum + entry(g, k) * tau
                });
            }
        }
        out
    }
}

impl<C: Cluster<M, N>, const M: usize, const N: usize> Driven<C, M, N> {
    /// The torques of the I-th cluster's motors.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn put_motors<
        R: Real,
        T: ClusteredRobot<B, Q, V, P, Y>,
        const I: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        &self,
        motion: &ClusterMotion<R, M, N>,
        torques: &mut MotorTorques<R, Y>,
    ) -> Result<(), ClusterError> {
        let Some(rows) = self.actuated else {
            return Ok(());
        };
        let [_, first] = TreeLayout::<T, B, Q, V, P, Y>::LAYOUT.first[I];
        let g = rows.map(|row| motion.g.get(row).copied().unwrap_or([R::ZERO; N]));
        let wanted: [R; N] = core::array::from_fn(|k| entry(&torques.tau, first + k));
        let (tau, singular) = match solve(&g, &wanted, &self.per.map(R::from_f64)) {
            Ok(solution) => solution,
            Err(problem) => return Err(self.error(problem)),
        };
        for (out, tau) in torques.tau.iter_mut().skip(first).zip(tau) {
            *out = tau;
        }
        if singular && torques.singular.is_none() {
            torques.singular = Some(self.name);
        }
        Ok(())
    }
}
