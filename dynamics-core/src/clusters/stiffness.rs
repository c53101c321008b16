//! ∂τ/∂y at rest through the loops: the stiffness of a robot with clusters.

use super::{ClusterError, Clustered, ClusteredRobot, TreeAlgorithms, TreeMotion};
use crate::algorithms::{MassMatrix, rnea, rnea_derivatives};
use crate::effects::Effect;
use crate::model::Static;
use crate::scalar::Real;
use crate::state::{RobotState, State};

impl<A> Clustered<A> {
    /// ∂τ_y/∂y of the torques that hold the robot at rest at y, N·m/rad, N/rad or N/m: the Hessian
    /// of the potential energy, less what friction and motors add.
    ///
    /// ```text
    /// τ_y = Gᵀ τ      ∂τ_y/∂y = Gᵀ ∂ID/∂q G + Σ τ_v ∂²γ_v/∂y²
    /// ```
    ///
    /// The second derivatives of the loops' map γ are taken from its accelerations at ÿ = 0, which
    /// are the quadratic form ẏᵀ ∂²γ/∂y² ẏ: exact, without differences. With M by
    /// [`TreeMotion::inertia`] it is the linear system of the robot about rest.
    ///
    /// # Shape
    /// Y × Y, of robots whose joints have one coordinate each; symmetric up to rounding where the
    /// effects have a potential.
    ///
    /// # Cost
    /// The cost of [`rnea_derivatives`], and Y² / 2 evaluations of the clusters: for a design, not
    /// for a tick.
    ///
    /// # Errors
    /// As [`Clustered::motion`].
    ///
    /// # Source
    /// Featherstone, RBDA (2008), (3.16), differentiated.
    ///
    /// # Example
    /// ```
    /// # use dynamics_core::clusters::{Branch, Clustered, ClusteredRobot, Driven, FourBar};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
    /// use dynamics_core::{Core, effects::Gravity, state::State};
    /// # struct Knee;
    /// # impl Robot<3, 3, 3> for Knee {
    /// #     const MODEL: ArmModel<f64, 3> = Model::new("knee", [
    /// #         Body::new("crank", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(0.1).com([0.02, 0.0, 0.0]),
    /// #         Body::new("rod", 0, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.05, 0.0, 0.0]).mass(0.1)
    /// #             .com([0.1, 0.0, 0.0]),
    /// #         Body::new("shank", BASE, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.2, 0.0, 0.0]).mass(1.0)
    /// #             .com([0.0, 0.0, -0.2]),
    /// #     ]);
    /// # }
    /// # impl ClusteredRobot<3, 3, 3, 1, 1> for Knee {
    /// #     type Clusters = (Driven<FourBar, 3, 1>,);
    /// #     const CLUSTERS: Self::Clusters = (Driven::new("knee", FourBar::new(0.2, 0.05, 0.2, 0.06, Branch::Positive)),);
    /// #     const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
    /// # }
    /// type Linkage = Clustered<Core<Knee>>;
    /// let [[stiffness]] = Linkage::stiffness(&[1.0_f64], &Gravity::EARTH)?;
    /// let [before] = Linkage::rnea(&State::at([1.0_f64 - 1e-5]), &Gravity::EARTH)?;
    /// let [after] = Linkage::rnea(&State::at([1.0_f64 + 1e-5]), &Gravity::EARTH)?;
    /// assert!(((after - before) / 2e-5 - stiffness).abs() < 1e-8);
    /// # Ok::<(), dynamics_core::clusters::ClusterError>(())
    /// ```
    pub fn stiffness<R, E, const B: usize, const V: usize, const Y: usize>(
        y: &[R; Y],
        effects: &E,
    ) -> Result<[[R; Y]; Y], ClusterError>
    where
        R: Real,
        A: TreeAlgorithms<R, B, V, V>,
        A::Robot: ClusteredRobot<B, V, V, Y, Y>,
        E: Effect<R, B, V>,
    {
        let tree = &Static::<A::Robot>::NEW;
        let rest = Self::motion(&State::at(*y))?;
        let tau = rnea(tree, rest.state(), effects);
        let by = rnea_derivatives(tree, rest.state(), effects);
        // Gᵀ ∂ID/∂q G as of M; its columns are rows here, since ∂ID/∂q need not be symmetric.
        let mut k: [[R; Y]; Y] = rest.inertia(&MassMatrix { rows: by.dq }).rows;
        // Σ τ_v q̈_v along one or two unit rates.
        let bend = |i: usize, j: usize| {
            let mut state = State::at(*y);
            for at in [i, j] {
                if let Some(rate) = state.qd.get_mut(at) {
                    *rate = R::ONE;
                }
            }
            let motion: TreeMotion<R, A::Robot, B, V, V, Y, Y> = Self::motion(&state)?;
            let terms = tau.iter().zip(motion.state().state().qdd);
            Ok(terms.fold(R::ZERO, |sum, (&tau, qdd)| sum + tau * qdd))
        };
        for i in 0..Y {
            for j in 0..=i {
                let own = bend(i, j)?;
                let both =
                    if i == j { own } else { R::from_f64(0.5) * (own - bend(i, i)? - bend(j, j)?) };
                // An entry and its mirror image, or the diagonal once.
                for (row, column) in [(i, j), (j, i)].into_iter().take(if i == j { 1 } else { 2 }) {
                    if let Some(entry) = k.get_mut(row).and_then(|row| row.get_mut(column)) {
                        *entry += both;
                    }
                }
            }
        }
        Ok(core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                k.get(j).and_then(|row| row.get(i)).copied().unwrap_or(R::ZERO)
            })
        }))
    }
}
