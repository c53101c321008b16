//! Motion of motors that are at actuated coordinates of a cluster and not at y, and inverse
//! dynamics for them.
//!
//! q_a = γ_a(y), q̇_a = G_a ẏ of the rows a that [`Driven::actuated`](super::Driven::actuated)
//! names.

use super::clustered::evaluate;
use super::description::sealed::Set;
use super::{ClusterError, Clustered, ClusteredRobot, MotorTorques, TreeAlgorithms, TreeMotion};
use crate::effects::{Effect, no_load_friction};
use crate::scalar::Real;
use crate::state::{State, entry};

impl<A> Clustered<A> {
    /// The motors' positions, velocities and accelerations at y, ẏ, ÿ, rad and s or m and s: the
    /// reference of a controller whose encoders are at the motors.
    ///
    /// In the places of y: a coordinate in no cluster has its motor there, as has a cluster without
    /// [`Driven::actuated`](super::Driven::actuated) rows.
    ///
    /// # Cost
    /// The cost of the clusters, without what only other coordinates of the tree need, and an arc
    /// tangent for each angle of a motor.
    ///
    /// # Errors
    /// [`ClusterError`] names the cluster that no configuration closes at y.
    ///
    /// # Example
    /// See the example of [`Clustered::rnea_of_motors`].
    #[inline(never)]
    pub fn motors<
        R,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        y: &State<R, P, Y>,
    ) -> Result<State<R, P, Y>, ClusterError>
    where
        R: Real,
        A: TreeAlgorithms<R, B, Q, V>,
        A::Robot: ClusteredRobot<B, Q, V, P, Y>,
    {
        Ok(evaluate::<R, A, B, Q, V, P, Y>(y)?.motors(y))
    }

    /// The torques of the motors at y, ẏ, ÿ under the effects of the scene, N·m or N:
    /// [`Clustered::rnea`], and then [`TreeMotion::to_motors`].
    ///
    /// # Shape
    /// Y, in the places of y.
    ///
    /// # Cost
    /// The cost of both functions, with the clusters evaluated once.
    ///
    /// # Errors
    /// As both: [`ClusterError`] names the cluster that no configuration closes at y, or of which a
    /// torque is not finite.
    ///
    /// # Example
    /// ```
    /// # use dynamics_core::clusters::{Branch, Clustered, ClusteredRobot, Driven, FourBar};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
    /// use dynamics_core::{Engine, effects::RIGID_BODY, state::State};
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
    ///     const CLUSTERS: Self::Clusters =
    ///         (Driven::new("knee", FourBar::new(0.2, 0.05, 0.2, 0.06, Branch::Positive)).actuated([2]),);
    ///     const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
    /// }
    /// // y is the crank; the motor turns the shank.
    /// let y = State { q: [1.0_f64], qd: [2.0], qdd: [10.0] };
    /// let motor = Clustered::<Engine<Knee>>::motors(&y)?;
    /// let tau_a = Clustered::<Engine<Knee>>::rnea_of_motors(&y, &RIGID_BODY)?;
    /// let tau = Clustered::<Engine<Knee>>::rnea(&y, &RIGID_BODY)?;
    /// assert!((tau_a.tau[0] * motor.qd[0] - tau[0] * y.qd[0]).abs() < 1e-14); // the same power
    /// # Ok::<(), dynamics_core::clusters::ClusterError>(())
    /// ```
    #[inline(never)]
    pub fn rnea_of_motors<
        R,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        y: &State<R, P, Y>,
        effects: &E,
    ) -> Result<MotorTorques<R, Y>, ClusterError>
    where
        R: Real,
        A: TreeAlgorithms<R, B, Q, V>,
        A::Robot: ClusteredRobot<B, Q, V, P, Y>,
        E: Effect<R, B, V>,
    {
        no_load_friction::<R, E, B, V>();
        let motion = evaluate::<R, A, B, Q, V, P, Y>(y)?;
        let tau = A::rnea(&motion.trig, &motion.tree, effects);
        let tau = TreeMotion::<R, A::Robot, B, Q, V, P, Y>::finite(motion.torque(&tau))?;
        motion.to_motors(&tau)
    }
}

impl<R, T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    TreeMotion<R, T, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    /// The motors' positions, velocities and accelerations, in the places of `y`, of which this is
    /// the motion: see [`Clustered::motors`].
    #[cfg_attr(optimised, inline(always))]
    pub fn motors(&self, y: &State<R, P, Y>) -> State<R, P, Y> {
        let (set, layout) = (const { T::CLUSTERS }, Self::LAYOUT);
        let mut out = *y;
        for (c, coordinates) in T::COORDINATES.iter().enumerate() {
            let (Some(rows), Some(&[p, first])) = (set.actuated(c), layout.first.get(c)) else {
                continue;
            };
            for (k, &row) in rows.iter().enumerate() {
                let v = entry(coordinates, row);
                if let Some(q) = out.q.get_mut(p + k) {
                    *q = entry(&self.tree.q, entry(&layout.position, v));
                }
                let rates = out.qd.get_mut(first + k).zip(out.qdd.get_mut(first + k));
                if let Some((qd, qdd)) = rates {
                    (*qd, *qdd) = (entry(&self.tree.qd, v), entry(&self.tree.qdd, v));
                }
            }
        }
        out
    }
}
