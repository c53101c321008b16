//! Forward dynamics of a robot with clusters: the articulated-body algorithm by clusters.
//!
//! Jain (2011), section 11.5, constraint embedding; Chignoli, Adrian, Kim & Wensing (2023); table
//! 7.1 of RBDA (2008), in which S of a cluster has the columns Aᵢₖ = X A_λ(i)ₖ + Sᵢ Gᵢₖ for each
//! body i of it: U = Σ Iᴬ A at the body that carries the cluster, D = Aᵀ Iᴬ A of N × N. A
//! coordinate in no cluster is a cluster of one, of the column S.

use core::fmt;

use super::clustered::Unbounded;
use super::passes::Passes;
use super::{ClusterError, Clustered, ClusteredRobot, TreeAlgorithms, TreeMotion};
use crate::Core;
use crate::algorithms::NotPositiveDefinite;
use crate::effects::{Declared, Effect};
use crate::model::{RobotModel, Static};
use crate::scalar::Real;
use crate::state::State;
use crate::trig::Kernel;

/// Why forward dynamics has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ForwardError {
    /// A cluster does not close or moves no inertia.
    Cluster(ClusterError),
    /// A coordinate of the tree in no cluster moves no inertia.
    Joint(NotPositiveDefinite),
}

impl fmt::Display for ForwardError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cluster(error) => error.fmt(out),
            Self::Joint(error) => error.fmt(out),
        }
    }
}

impl core::error::Error for ForwardError {}

impl From<ClusterError> for ForwardError {
    fn from(error: ClusterError) -> Self {
        Self::Cluster(error)
    }
}

impl<T, K> Clustered<Core<T, K>> {
    /// ÿ = FD(y, ẏ, τ_y): the independent accelerations, rad/s² or m/s², under the effects of the
    /// scene.
    ///
    /// `y.qdd` is not read. τ_y are torques at y: those of motors elsewhere go through
    /// [`TreeMotion::from_motors`](super::TreeMotion::from_motors).
    ///
    /// # Shape
    /// Y.
    ///
    /// # Cost
    /// O(B): some 600 flops for each revolute joint, 200 for each independent coordinate on each
    /// body of a cluster.
    ///
    /// # Source
    /// Jain (2011), section 11.5; Chignoli, Adrian, Kim & Wensing (2023).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
    /// use dynamics_core::{Core, effects::RIGID_BODY, model::{ArmModel, Robot}, robots::Ur5e, state::State};
    /// struct Arm;
    /// impl Robot<6, 6, 6> for Arm {
    ///     const MODEL: ArmModel<f64, 6> = Ur5e::MODEL;
    /// }
    /// impl ClusteredRobot<6, 6, 6, 6, 6> for Arm {
    ///     type Clusters = (Driven<Differential, 2, 2>,);
    ///     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
    ///     const COORDINATES: &'static [&'static [usize]] = &[&[4, 5]];
    /// }
    /// let y = State { q: [0.1, -1.2, 1.5, 0.3, 0.9, 0.2], qd: [0.5; 6], qdd: [1.0; 6] };
    /// let tau = Clustered::<Core<Arm>>::rnea(&y, &RIGID_BODY)?;
    /// let ydd = Clustered::<Core<Arm>>::aba(&y, &tau, &RIGID_BODY)?;
    /// assert!(ydd.iter().all(|ydd| (ydd - 1.0_f64).abs() < 1e-9));
    /// # Ok::<(), dynamics_core::clusters::ForwardError>(())
    /// ```
    ///
    /// # Errors
    /// [`ForwardError`] names the cluster that no configuration closes at y or that moves no
    /// inertia in some direction, or the joint that moves none.
    #[inline(never)]
    pub fn aba<
        R,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        y: &State<R, P, Y>,
        tau: &[R; Y],
        effects: &E,
    ) -> Result<[R; Y], ForwardError>
    where
        R: Real,
        T: ClusteredRobot<B, Q, V, P, Y>,
        K: Kernel<R>,
        Core<T, K>: TreeAlgorithms<R, B, Q, V, Robot = T, Kernel = Unbounded<K>>,
        E: Effect<R, B, V>,
    {
        let motion = Clustered::<Core<T, K>>::motion(y)?;
        motion.aba(&Static::<T, K>::NEW, tau, effects)
    }
}

impl<R, T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    TreeMotion<R, T, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    /// ÿ = FD(y, ẏ, τ_y) of a robot with the joints and loops of `T` and inertias of its own,
    /// rad/s² or m/s²: [`Calibrated`](crate::model::Calibrated), identified or disturbed.
    ///
    /// The lengths of the loops are those of `T`: placements of joints are not to be changed. See
    /// [`Clustered::aba`] for the rest.
    ///
    /// # Cost
    /// The cost of [`Clustered::aba`] without the motion of the tree.
    ///
    /// # Errors
    /// As [`Clustered::aba`], but those of clusters that do not close.
    ///
    /// ```
    /// # use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
    /// # use dynamics_core::model::{ArmModel, Robot};
    /// # use dynamics_core::{Core, effects::RIGID_BODY, robots::Ur5e, state::State};
    /// # struct Arm;
    /// # impl Robot<6, 6, 6> for Arm {
    /// #     const MODEL: ArmModel<f64, 6> = Ur5e::MODEL;
    /// # }
    /// # impl ClusteredRobot<6, 6, 6, 6, 6> for Arm {
    /// #     type Clusters = (Driven<Differential, 2, 2>,);
    /// #     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
    /// #     const COORDINATES: &'static [&'static [usize]] = &[&[4, 5]];
    /// # }
    /// use dynamics_core::model::Calibrated;
    /// let mut heavy = Calibrated::<Arm, f64, 6, 6, 6>::nominal();
    /// for inertia in heavy.inertias() {
    ///     *inertia = *inertia + *inertia;
    /// }
    /// let y = State { q: [0.1, -1.2, 1.5, 0.3, 0.9, 0.2], qd: [0.5; 6], qdd: [0.0; 6] };
    /// let motion = Clustered::<Core<Arm>>::motion(&y)?;
    /// let tau = [40.0; 6];
    /// let light = Clustered::<Core<Arm>>::aba(&y, &tau, &RIGID_BODY)?;
    /// let same = motion.aba(&heavy, &tau.map(|tau| 2.0 * tau), &RIGID_BODY)?;
    /// assert!(light.iter().zip(same).all(|(a, b)| (a - b).abs() < 1e-9)); // twice the torque on twice the mass
    /// # Ok::<(), dynamics_core::clusters::ForwardError>(())
    /// ```
    #[cfg_attr(optimised, inline(always))]
    pub fn aba<D, E>(&self, robot: &D, tau: &[R; Y], effects: &E) -> Result<[R; Y], ForwardError>
    where
        D: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const {
            assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene");
            assert!(
                !E::GYROSCOPIC_ROTORS,
                "no rotors that spin as bodies here; make them bodies of the tree"
            );
        };
        let mut passes = Passes::new(robot, self, effects);
        for i in (0..B).rev() {
            passes.inward(i, tau)?;
        }
        Ok(Self::finite(passes.outward())?)
    }
}
