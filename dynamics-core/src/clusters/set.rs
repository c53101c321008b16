//! All clusters of a robot: a tuple.

use super::cluster::{add, add_torque, dot};
use super::description::{TreeState, sealed};
use super::motor_torques::MotorTorques;
use super::places::{ClusterRow, IndependentRow, TreeLayout};
use super::{Cluster, ClusterError, ClusterMotion, ClusteredRobot, Driven};
use crate::engine::{Index, for_each_joint};
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::state::{State, entry};
use crate::trig::Kernel;

impl<C: Cluster<M, N>, const M: usize, const N: usize> Driven<C, M, N> {
    /// Evaluates the cluster, which is the I-th, and fills in the tree's coordinates that it
    /// drives.
    #[cfg_attr(optimised, inline(always))]
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
        let layout = TreeLayout::<T, B, Q, V, P, Y>::LAYOUT;
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
            // Not a loop, which might not be unrolled: angles that no effect reads are then
            // computed.
            if Index::<J, M>::IS_BELOW {
                let v = ClusterRow::<T, B, Q, V, P, Y, I, J>::VELOCITY;
                let q = ClusterRow::<T, B, Q, V, P, Y, I, J>::POSITION;
                if let (Some(turn), Some(angle)) = (tree.turns.get_mut(q), tree.state.q.get_mut(q))
                {
                    (*turn, *angle) = (motion.q[J], motion.q[J].q);
                }
                if let (Some(qd), Some(qdd)) = (tree.state.qd.get_mut(v), tree.state.qdd.get_mut(v))
                {
                    (*qd, *qdd) = match IndependentRow::<C, M, N, J>::COLUMN {
                        Some(k) => (entry(&yd, k), entry(&ydd, k)),
                        None => {
                            let g = &motion.g[J];
                            (dot(g, &yd), dot(g, &ydd) + motion.bias[J])
                        }
                    };
                }
            }
        });
        Ok(motion)
    }

    /// Gᵀ τ of the I-th cluster.
    #[cfg_attr(optimised, inline(always))]
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
        let layout = TreeLayout::<T, B, Q, V, P, Y>::LAYOUT;
        let mut sums = [None; N];
        for_each_joint!(J, {
            if Index::<J, M>::IS_BELOW {
                let tau = entry(tau, ClusterRow::<T, B, Q, V, P, Y, I, J>::VELOCITY);
                match IndependentRow::<C, M, N, J>::COLUMN {
                    Some(k) => {
                        if let Some(sum) = sums.get_mut(k) {
                            add(sum, tau);
                        }
                    }
                    None => add_torque(&mut sums, &motion.g[J], tau),
                }
            }
        });
        for (k, tau) in sums.into_iter().enumerate() {
            if let Some(out) = out.get_mut(layout.first[I][1] + k) {
                *out = tau.unwrap_or_default();
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

            #[cfg_attr(optimised, inline(always))]
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

            #[cfg_attr(optimised, inline(always))]
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

            #[cfg_attr(optimised, inline(always))]
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
            ) -> Result<(), ClusterError> {
                $(self.$at.put_motors::<R, T, $at, B, Q, V, P, Y>(&motions.$at, torques)?;)*
                Ok(())
            }

            #[cfg_attr(optimised, inline(always))]
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
