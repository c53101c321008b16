//! How a robot with clusters is described: its spanning tree, and what drives its coordinates.

use super::cluster::{add_torque, dot};
use super::layout::{Layout, at};
use super::{Cluster, ClusterError, ClusterMotion, ClusterProblem};
use crate::engine::for_each_joint;
use crate::model::{JointCoordinate, Robot};
use crate::scalar::Real;
use crate::state::{State, entry};
use crate::trig::Kernel;

/// A cluster of a robot, under a name.
///
/// ```
/// use dynamics_core::clusters::{Differential, Driven};
/// const WRIST: Driven<Differential, 2, 2> = Driven::new("wrist", Differential::new([1.0, 1.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven<C, const M: usize, const N: usize> {
    name: &'static str,
    cluster: C,
    actuated: Option<[usize; N]>,
}

impl<C, const M: usize, const N: usize> Driven<C, M, N> {
    /// A cluster with the motors at its independent coordinates; its name is in errors.
    pub const fn new(name: &'static str, cluster: C) -> Self {
        Self {
            name,
            cluster,
            actuated: None,
        }
    }

    /// The same with the motors at these rows of q, of which [`TreeMotion::to_motors`](super::TreeMotion::to_motors) has the
    /// torques.
    ///
    /// # Panics
    /// If the cluster has no such row or a row is named twice; in a `const` this does not compile.
    #[must_use]
    pub const fn actuated(mut self, rows: [usize; N]) -> Self {
        let mut k = 0;
        while k < N {
            assert!(
                rows[k] < M,
                "a cluster is actuated at a row that it does not have"
            );
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
}

/// A robot of B bodies with Q positions and V velocities in its spanning tree, and P independent positions and Y independent
/// velocities, known at compile time.
///
/// y has, in the order of the tree's bodies, the coordinates that are in no cluster as they are, and the independent
/// coordinates of each cluster in the place of its first body. For robots whose joints all have one degree of freedom P = Y.
///
/// A description that cannot be does not compile: a coordinate that is driven twice, one that the robot does not have, bodies
/// of a cluster that are on two bodies outside it, a joint with a quaternion, wrong P and Y. This one can be,
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
/// and the same with a coordinate that is driven twice cannot:
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

/// The layout of a robot's coordinates, with its checks.
pub(super) struct Places<T, const B: usize, const P: usize, const Y: usize>(
    core::marker::PhantomData<T>,
);

impl<T, const B: usize, const P: usize, const Y: usize> Places<T, B, P, Y> {
    pub(super) const fn layout<const Q: usize, const V: usize>() -> Layout<Q, V>
    where
        T: ClusteredRobot<B, Q, V, P, Y>,
    {
        let sizes = <T::Clusters as sealed::Set>::SIZES;
        Layout::of(&T::MODEL, T::COORDINATES, sizes, [P, Y])
    }
}

/// A tuple of clusters: up to eight [`Driven`], of whatever kinds.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a tuple of clusters",
    note = "a tuple of up to eight `Driven<C, M, N>` with `C: Cluster<M, N>`, and a comma after a single one: `(Driven<FourBar, 3, 1>,)`"
)]
pub trait ClusterSet: sealed::Set {}

impl<S: sealed::Set> ClusterSet for S {}

/// The state of the spanning tree while it is filled in.
pub struct TreeState<'a, R, const Q: usize, const V: usize> {
    pub(super) turns: &'a mut [JointCoordinate<R>; Q],
    pub(super) state: &'a mut State<R, Q, V>,
}

pub(super) mod sealed {
    use super::{ClusterError, Real, State, TreeState};
    use crate::clusters::ClusteredRobot;
    use crate::trig::Kernel;
    use core::fmt::Debug;

    /// What the algorithms do with all clusters of a robot.
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

impl<C: Cluster<M, N>, const M: usize, const N: usize> Driven<C, M, N> {
    /// Evaluates the cluster, which is the I-th, and fills in the tree's coordinates that it drives.
    #[inline(always)]
    fn place<
        R: Real,
        K: Kernel<R>,
        T: ClusteredRobot<B, Q, V, P, Y>,
        const I: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        &self,
        y: &State<R, P, Y>,
        tree: &mut TreeState<'_, R, Q, V>,
    ) -> Result<ClusterMotion<R, M, N>, ClusterError> {
        let layout = const { &Places::<T, B, P, Y>::layout::<Q, V>() };
        let [p, first] = layout.first[I];
        let place = core::array::from_fn(|k| {
            let y = entry(&y.q, p + k);
            if layout.near[I] {
                JointCoordinate::revolute_bounded::<K>(y)
            } else {
                JointCoordinate::with_kernel::<K>(y)
            }
        });
        let yd: [R; N] = core::array::from_fn(|k| entry(&y.qd, first + k));
        let ydd: [R; N] = core::array::from_fn(|k| entry(&y.qdd, first + k));
        let motion: ClusterMotion<R, M, N> = match self.cluster.evaluate::<R, K>(&place, &yd) {
            Ok(motion) => motion,
            Err(problem) => return Err(self.error(problem)),
        };
        for_each_joint!(J, {
            // Not a loop, which might not be unrolled: angles that no effect reads are then computed.
            if const { J < M } {
                let v = const { at(T::COORDINATES[I], J) };
                let q = const {
                    at(
                        &Places::<T, B, P, Y>::layout::<Q, V>().position,
                        at(T::COORDINATES[I], J),
                    )
                };
                if let (Some(turn), Some(angle)) = (tree.turns.get_mut(q), tree.state.q.get_mut(q))
                {
                    (*turn, *angle) = (motion.q[J], motion.q[J].q);
                }
                if let (Some(qd), Some(qdd)) = (tree.state.qd.get_mut(v), tree.state.qdd.get_mut(v))
                {
                    let g = &motion.g[J];
                    (*qd, *qdd) = (dot(g, &yd), dot(g, &ydd) + motion.bias[J]);
                }
            }
        });
        Ok(motion)
    }

    #[cold]
    fn error(&self, problem: ClusterProblem) -> ClusterError {
        ClusterError {
            cluster: self.name,
            problem,
        }
    }

    /// Gᵀ τ of the I-th cluster.
    #[inline(always)]
    fn put_torque<
        R: Real,
        T: ClusteredRobot<B, Q, V, P, Y>,
        const I: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        motion: &ClusterMotion<R, M, N>,
        tau: &[R; V],
        out: &mut [R; Y],
    ) {
        let layout = const { &Places::<T, B, P, Y>::layout::<Q, V>() };
        let mut sums = [R::ZERO; N];
        for_each_joint!(J, {
            if const { J < M } {
                let tau = entry(tau, const { at(T::COORDINATES[I], J) });
                add_torque(&mut sums, &motion.g[J], tau, J == 0);
            }
        });
        for (k, tau) in sums.into_iter().enumerate() {
            if let Some(out) = out.get_mut(layout.first[I][1] + k) {
                *out = tau;
            }
        }
    }
}

macro_rules! tuple {
    ($($name:ident $m:ident $n:ident $at:tt),*) => {
        impl<$($name: Cluster<$m, $n>, const $m: usize, const $n: usize),*> sealed::Set
            for ($(Driven<$name, $m, $n>,)*)
        {
            type Motions<R: Real> = ($(ClusterMotion<R, $m, $n>,)*);
            const SIZES: &'static [[usize; 2]] = &[$([$m, $n]),*];

            #[inline(always)]
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
            ) -> Result<Self::Motions<R>, ClusterError> {
                Ok(($(self.$at.place::<R, K, T, $at, B, Q, V, P, Y>(y, tree)?,)*))
            }

            #[inline(always)]
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
            ) {
                $(Driven::<$name, $m, $n>::put_torque::<R, T, $at, B, Q, V, P, Y>(&motions.$at, tau, out);)*
            }

            #[inline(always)]
            fn row<R: Real>(motions: &Self::Motions<R>, cluster: usize, row: usize) -> (&[R], R) {
                match cluster {
                    $($at => match motions.$at.g.get(row) {
                        Some(g) => (g, entry(&motions.$at.bias, row)),
                        None => (&[], R::ZERO),
                    },)*
                    _ => (&[], R::ZERO),
                }
            }

            fn singular<R: Real>(motions: &Self::Motions<R>, cluster: usize) -> bool {
                match cluster {
                    $($at => motions.$at.singular,)*
                    _ => false,
                }
            }

            fn name(&self, cluster: usize) -> &'static str {
                match cluster {
                    $($at => self.$at.name,)*
                    _ => "",
                }
            }

            fn actuated(&self, cluster: usize) -> Option<&[usize]> {
                match cluster {
                    $($at => self.$at.actuated.as_ref().map(|rows| rows.as_slice()),)*
                    _ => None,
                }
            }
        }
    };
}

tuple!(C0 M0 N0 0);
tuple!(C0 M0 N0 0, C1 M1 N1 1);
tuple!(C0 M0 N0 0, C1 M1 N1 1, C2 M2 N2 2);
tuple!(C0 M0 N0 0, C1 M1 N1 1, C2 M2 N2 2, C3 M3 N3 3);
tuple!(C0 M0 N0 0, C1 M1 N1 1, C2 M2 N2 2, C3 M3 N3 3, C4 M4 N4 4);
tuple!(C0 M0 N0 0, C1 M1 N1 1, C2 M2 N2 2, C3 M3 N3 3, C4 M4 N4 4, C5 M5 N5 5);
tuple!(C0 M0 N0 0, C1 M1 N1 1, C2 M2 N2 2, C3 M3 N3 3, C4 M4 N4 4, C5 M5 N5 5, C6 M6 N6 6);
tuple!(C0 M0 N0 0, C1 M1 N1 1, C2 M2 N2 2, C3 M3 N3 3, C4 M4 N4 4, C5 M5 N5 5, C6 M6 N6 6, C7 M7 N7 7);
