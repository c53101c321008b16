//! The description of a robot with clusters: its spanning tree, and what drives its coordinates.

use super::motor_torques::MotorTorques;
use super::{ClusterError, ClusterProblem};
use crate::model::{JointCoordinate, Robot};
use crate::scalar::Real;
use crate::state::State;

/// The least rate of a cluster's motors per rate of an independent coordinate that is not damped,
/// by default; see [`Driven::damped_below`](super::Driven::damped_below).
pub const DEAD_POINT: f64 = 0.01;

/// A cluster of a robot, with its name and the places of its motors.
///
/// ```
/// use dynamics_core::clusters::{Differential, Driven};
/// const WRIST: Driven<Differential, 2, 2> = Driven::new("wrist", Differential::new([1.0, 1.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven<C, const M: usize, const N: usize> {
    pub(super) name: &'static str,
    pub(super) cluster: C,
    pub(super) actuated: Option<[usize; N]>,
    /// The reciprocals of the rates below which motors are damped.
    pub(super) per: [f64; N],
}

impl<C, const M: usize, const N: usize> Driven<C, M, N> {
    /// A cluster with the motors at its independent coordinates. Errors and statuses have its name.
    pub const fn new(name: &'static str, cluster: C) -> Self {
        Self { name, cluster, actuated: None, per: [1.0 / DEAD_POINT; N] }
    }

    /// The same with the motors at these rows of q, of which
    /// [`TreeMotion::to_motors`](super::TreeMotion::to_motors) has the torques.
    ///
    /// # Panics
    /// If the cluster has no such row or a row is named twice; in a `const` this does not compile.
    #[must_use]
    pub const fn actuated(mut self, rows: [usize; N]) -> Self {
        let mut k = 0;
        while k < N {
            assert!(rows[k] < M, "a cluster is actuated at a row that it does not have");
            let mut l = 0;
            while l < k {
                assert!(rows[k] != rows[l], "a cluster is actuated twice at one row");
                l += 1;
            }
            k += 1;
        }
        self.actuated = Some(rows);
        self
    }

    /// The same with other rates of the motors, per unit rate of each independent coordinate, below
    /// which their torques are damped, in place of [`DEAD_POINT`] for all.
    ///
    /// They are in the units of the motors over those of y, such as m/rad. They bound the torques
    /// of the motors: |τ_a| is at most the root of the sum of squares of the torques at y, each
    /// over its rate.
    ///
    /// ```
    /// use dynamics_core::clusters::{Branch, Driven, FourBar};
    /// const KNEE: FourBar = FourBar::new(0.2, 0.05, 0.2, 0.06, Branch::Positive);
    /// // 1 N·m at the crank takes at most 20 N·m of the motor at the shank.
    /// const DRIVEN: Driven<FourBar, 3, 1> = Driven::new("knee", KNEE).actuated([2]).damped_below([0.05]);
    /// ```
    ///
    /// # Panics
    /// If a rate is not positive; in a `const` this does not compile.
    #[must_use]
    pub const fn damped_below(mut self, rates: [f64; N]) -> Self {
        let mut k = 0;
        while k < N {
            assert!(
                rates[k] > 0.0 && rates[k].is_finite(),
                "a rate below which motors are damped is not positive"
            );
            self.per[k] = 1.0 / rates[k];
            k += 1;
        }
        self
    }
}

impl<C, const M: usize, const N: usize> Driven<C, M, N> {
    #[cold]
    pub(super) fn error(&self, problem: ClusterProblem) -> ClusterError {
        ClusterError { cluster: self.name, problem }
    }
}

/// A robot of B bodies with Q positions and V velocities in its spanning tree, and P independent
/// positions and Y independent velocities, known at compile time.
///
/// y has, in the order of the tree's bodies, the coordinates that are in no cluster as they are,
/// and the independent coordinates of each cluster in the place of its first body. For robots whose
/// joints all have one degree of freedom P = Y.
///
/// An impossible description does not compile: a coordinate that is driven twice, one that the
/// robot does not have, bodies of a cluster that are on two bodies outside it, a joint with a
/// quaternion, wrong P and Y. This one compiles,
///
/// ```
/// use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
/// use dynamics_core::{Core, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// struct Arm;
/// impl Robot<6, 6, 6> for Arm {
///     const MODEL: dynamics_core::model::ArmModel<f64, 6> = Ur5e::MODEL;
/// }
/// impl ClusteredRobot<6, 6, 6, 6, 6> for Arm {
///     type Clusters = (Driven<Differential, 2, 2>,);
///     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
///     const COORDINATES: &'static [&'static [usize]] = &[&[4, 5]];
/// }
/// assert!(Clustered::<Core<Arm>>::rnea(&State::at([0.1; 6]), &RIGID_BODY).is_ok());
/// ```
///
/// and the same with a coordinate that is driven twice does not,
///
/// ```compile_fail,E0080
/// # use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
/// # use dynamics_core::{Core, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// # struct Arm;
/// # impl Robot<6, 6, 6> for Arm {
/// #     const MODEL: dynamics_core::model::ArmModel<f64, 6> = Ur5e::MODEL;
/// # }
/// impl ClusteredRobot<6, 6, 6, 6, 6> for Arm {
///     type Clusters = (Driven<Differential, 2, 2>,);
///     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
///     const COORDINATES: &'static [&'static [usize]] = &[&[4, 4]];
/// }
/// assert!(Clustered::<Core<Arm>>::rnea(&State::at([0.1; 6]), &RIGID_BODY).is_ok());
/// // error: a coordinate is driven twice, by one cluster or by two
/// ```
///
/// nor with one that the robot does not have:
///
/// ```compile_fail,E0080
/// # use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
/// # use dynamics_core::{Core, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// # struct Arm;
/// # impl Robot<6, 6, 6> for Arm {
/// #     const MODEL: dynamics_core::model::ArmModel<f64, 6> = Ur5e::MODEL;
/// # }
/// impl ClusteredRobot<6, 6, 6, 6, 6> for Arm {
///     type Clusters = (Driven<Differential, 2, 2>,);
///     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
///     const COORDINATES: &'static [&'static [usize]] = &[&[5, 6]];
/// }
/// assert!(Clustered::<Core<Arm>>::rnea(&State::at([0.1; 6]), &RIGID_BODY).is_ok());
/// // error: a cluster drives a coordinate that the robot does not have
/// ```
///
/// nor with bodies that are not on each other, here with two between them:
///
/// ```compile_fail,E0080
/// # use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
/// # use dynamics_core::{Core, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// # struct Arm;
/// # impl Robot<6, 6, 6> for Arm {
/// #     const MODEL: dynamics_core::model::ArmModel<f64, 6> = Ur5e::MODEL;
/// # }
/// impl ClusteredRobot<6, 6, 6, 6, 6> for Arm {
///     type Clusters = (Driven<Differential, 2, 2>,);
///     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
///     const COORDINATES: &'static [&'static [usize]] = &[&[2, 5]];
/// }
/// assert!(Clustered::<Core<Arm>>::rnea(&State::at([0.1; 6]), &RIGID_BODY).is_ok());
/// // error: the bodies of a cluster are not all on each other or on one body outside it
/// ```
///
/// nor with another number of independent coordinates:
///
/// ```compile_fail,E0080
/// # use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
/// # use dynamics_core::{Core, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// # struct Arm;
/// # impl Robot<6, 6, 6> for Arm {
/// #     const MODEL: dynamics_core::model::ArmModel<f64, 6> = Ur5e::MODEL;
/// # }
/// impl ClusteredRobot<6, 6, 6, 5, 5> for Arm {
///     type Clusters = (Driven<Differential, 2, 2>,);
///     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
///     const COORDINATES: &'static [&'static [usize]] = &[&[4, 5]];
/// }
/// assert!(Clustered::<Core<Arm>>::rnea(&State::at([0.1; 5]), &RIGID_BODY).is_ok());
/// // error: P and Y are not the numbers of independent positions and velocities
/// ```
pub trait ClusteredRobot<
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
>: Robot<B, Q, V>
{
    /// The clusters' types: a tuple of up to eight [`Driven`].
    type Clusters: ClusterSet;
    /// The clusters.
    const CLUSTERS: Self::Clusters;
    /// Which velocity coordinates of the tree each cluster drives, in the order of its rows.
    const COORDINATES: &'static [&'static [usize]];
}

/// A tuple of clusters: up to eight [`Driven`], of any kinds.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a tuple of clusters",
    note = "a tuple of up to eight `Driven<C, M, N>` with `C: Cluster<M, N>`, and a comma after a \
            single one: `(Driven<FourBar, 3, 1>,)`"
)]
pub trait ClusterSet: sealed::Set {}

impl<S: sealed::Set> ClusterSet for S {}

/// The state of the spanning tree while it is filled in.
pub struct TreeState<'a, R, const Q: usize, const V: usize> {
    pub(super) turns: &'a mut [JointCoordinate<R>; Q],
    pub(super) state: &'a mut State<R, Q, V>,
}

pub(super) mod sealed {
    use core::fmt::Debug;

    use super::{ClusterError, ClusteredRobot, MotorTorques, Real, State, TreeState};
    use crate::trig::Kernel;

    /// The operations of the algorithms on all clusters of a robot.
    pub trait Set: Copy {
        /// The motions of the clusters.
        type Motions<R: Real>: Copy + Debug + PartialEq;
        /// M and N of each.
        const SIZES: &'static [[usize; 2]];

        /// Evaluates every cluster and fills in the tree's coordinates that it drives.
        fn evaluate<
            R: Real,
            K: Kernel<R>,
            T: ClusteredRobot<B, Q, V, P, Y, Clusters = Self>,
            const B: usize,
            const Q: usize,
            const V: usize,
            const P: usize,
            const Y: usize,
        >(
            &self,
            y: &State<R, P, Y>,
            tree: &mut TreeState<'_, R, Q, V>,
        ) -> Result<Self::Motions<R>, ClusterError>;

        /// Gᵀ τ of every cluster.
        fn torque<
            R: Real,
            T: ClusteredRobot<B, Q, V, P, Y, Clusters = Self>,
            const B: usize,
            const Q: usize,
            const V: usize,
            const P: usize,
            const Y: usize,
        >(
            motions: &Self::Motions<R>,
            tau: &[R; V],
            out: &mut [R; Y],
        );

        /// The torques of the motors, in place of those at y.
        fn motors<
            R: Real,
            T: ClusteredRobot<B, Q, V, P, Y, Clusters = Self>,
            const B: usize,
            const Q: usize,
            const V: usize,
            const P: usize,
            const Y: usize,
        >(
            &self,
            motions: &Self::Motions<R>,
            torques: &mut MotorTorques<R, Y>,
        ) -> Result<(), ClusterError>;

        /// A row of G and of Ġ ẏ.
        fn row<R: Real>(motions: &Self::Motions<R>, cluster: usize, row: usize) -> (&[R], R);
        /// Whether a cluster is at a singularity.
        fn singular<R: Real>(motions: &Self::Motions<R>, cluster: usize) -> bool;
        /// The name of a cluster.
        fn name(&self, cluster: usize) -> &'static str;
        /// The actuated rows of a cluster.
        fn actuated(&self, cluster: usize) -> Option<&[usize]>;
    }
}
