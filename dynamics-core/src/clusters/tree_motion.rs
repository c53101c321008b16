//! The state of the spanning tree at independent coordinates, and the maps of torques, M and
//! Jacobians to these.

use super::places::{TreeCoordinate, TreeLayout};
use core::fmt;

use super::description::sealed::Set;
use super::layout::{EXPANDED, Layout, NONE};
use super::{ClusterError, ClusterProblem, ClusteredRobot};
use crate::algorithms::MassMatrix;
use crate::engine::for_each_joint;
use crate::scalar::Real;
use crate::spatial::Motion;
use crate::state::{JointTrig, State, StateWithTrig, all_finite, entry};

/// The spanning tree's state at y, ẏ, ÿ, with G: computed once a tick, for all algorithms.
///
/// Every algorithm of core and engine accepts [`TreeMotion::state`] or
/// [`TreeMotion::configuration`]; what it returns goes back to y by [`TreeMotion::torque`],
/// [`TreeMotion::inertia`] and [`TreeMotion::jacobian`]:
///
/// ```
/// use dynamics_core::algorithms::frame;
/// # use dynamics_core::clusters::{Branch, Clustered, ClusteredRobot, Driven, FourBar};
/// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
/// use dynamics_core::{Core, effects::RIGID_BODY, state::State};
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
/// # impl ClusteredRobot<3, 3, 3, 1, 1> for Knee {
/// #     type Clusters = (Driven<FourBar, 3, 1>,);
/// #     const CLUSTERS: Self::Clusters = (Driven::new("knee", FourBar::new(0.2, 0.05, 0.2, 0.06, Branch::Positive)),);
/// #     const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
/// # }
/// let knee = Clustered::<Core<Knee>>::motion(&State { q: [1.0_f64], qd: [2.0], qdd: [10.0] })?;
/// let tau = knee.torque(&Core::<Knee>::rnea(knee.state(), &RIGID_BODY)); // inverse dynamics
/// let m = knee.inertia(&Core::<Knee>::crba(knee.configuration(), &RIGID_BODY)); // M of y
/// let j = knee.jacobian(&Core::<Knee>::jacobian(knee.configuration(), 2, frame::Local)); // of the shank
/// assert!((j[0].ang.z * 2.0 - knee.state().state().qd[2]).abs() < 1e-15);
/// # use dynamics_core::state::RobotState;
/// # assert!(tau[0].is_finite() && m.get(0, 0) > 0.0);
/// # Ok::<(), dynamics_core::clusters::ClusterError>(())
/// ```
pub struct TreeMotion<
    R,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
> where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    pub(super) trig: JointTrig<R, Q>,
    pub(super) tree: State<R, Q, V>,
    pub(super) motions: <T::Clusters as Set>::Motions<R>,
    /// G of a coordinate in no cluster.
    pub(super) one: [R; 1],
}

impl<R, T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize> Clone
    for TreeMotion<R, T, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    fn clone(&self) -> Self {
        Self { ..*self }
    }
}

impl<R, T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    fmt::Debug for TreeMotion<R, T, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("TreeMotion")
            .field("tree", &self.tree)
            .field("motions", &self.motions)
            .finish_non_exhaustive()
    }
}

impl<R, T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    TreeMotion<R, T, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    pub(super) const LAYOUT: &'static Layout<Q, V> = TreeLayout::<T, B, Q, V, P, Y>::LAYOUT;

    /// γ(y), G ẏ and G ÿ + Ġ ẏ: the state of the tree with its sines and cosines.
    #[cfg_attr(optimised, inline(always))]
    pub fn state(&self) -> StateWithTrig<'_, R, Q, V> {
        self.trig.with(&self.tree)
    }

    /// γ(y) with its sines and cosines.
    #[cfg_attr(optimised, inline(always))]
    pub fn configuration(&self) -> &JointTrig<R, Q> {
        &self.trig
    }

    /// The name of the first cluster that is at a singularity, where G is damped.
    pub fn singular(&self) -> Option<&'static str> {
        let clusters = 0..<T::Clusters as Set>::SIZES.len();
        let found =
            clusters.into_iter().find(|&c| <T::Clusters as Set>::singular(&self.motions, c));
        found.map(|c| T::CLUSTERS.name(c))
    }

    /// Gᵀ τ: the torques at y of the tree's torques, N·m or N.
    ///
    /// # Cost
    /// 2 M N flops for each cluster.
    #[cfg_attr(optimised, inline(always))]
    pub fn torque(&self, tau: &[R; V]) -> [R; Y] {
        let mut out = [R::ZERO; Y];
        let layout = Self::LAYOUT;
        for_each_joint!(J, {
            let place = TreeCoordinate::<T, B, Q, V, P, Y, J>::FREE_VELOCITY;
            if place < Y {
                out[place] = tau[J];
            }
        });
        if const { V > EXPANDED } {
            for (&place, &tau) in layout.free.iter().zip(tau).skip(EXPANDED) {
                if let Some(out) = out.get_mut(place) {
                    *out = tau;
                }
            }
        }
        <T::Clusters as Set>::torque::<R, T, B, Q, V, P, Y>(&self.motions, tau, &mut out);
        out
    }

    /// Gᵀ M G: the inertia at y of the tree's M, kg·m², kg and kg·m.
    ///
    /// # Cost
    /// 2 V flops for each entry of G that can differ from zero, and that of [`TreeMotion::torque`]
    /// Y times.
    #[must_use]
    pub fn inertia(&self, m: &MassMatrix<R, V>) -> MassMatrix<R, Y> {
        // M G by columns, and Gᵀ of each.
        let mut columns = [[R::ZERO; V]; Y];
        for v in 0..V {
            let (first, g, _) = self.row(v);
            for (k, &g) in g.iter().enumerate() {
                if let Some(column) = columns.get_mut(first + k) {
                    for (i, entry) in column.iter_mut().enumerate() {
                        *entry += m.get(i, v) * g;
                    }
                }
            }
        }
        MassMatrix { rows: columns.map(|column| self.torque(&column)) }
    }

    /// J G: the Jacobian of a body with respect to ẏ, by columns, of that of the tree.
    ///
    /// # Cost
    /// 12 M N flops for each cluster.
    #[must_use]
    pub fn jacobian(&self, j: &[Motion<R>; V]) -> [Motion<R>; Y] {
        let mut columns = [Motion::ZERO; Y];
        for (v, &column) in j.iter().enumerate() {
            let (first, g, _) = self.row(v);
            for (k, &g) in g.iter().enumerate() {
                if let Some(sum) = columns.get_mut(first + k) {
                    *sum += column * g;
                }
            }
        }
        columns
    }

    /// Torques or accelerations at y, all of which are finite.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn finite(of_y: [R; Y]) -> Result<[R; Y], ClusterError> {
        if all_finite(&of_y) { Ok(of_y) } else { Err(Self::not_finite(&of_y)) }
    }

    /// Names the first cluster of which a torque or an acceleration is not finite, or the robot.
    #[cold]
    #[inline(never)]
    fn not_finite(of_y: &[R; Y]) -> ClusterError {
        let layout = Self::LAYOUT;
        let mut clusters = layout.first.iter().zip(&layout.count).enumerate();
        let found = clusters.find(|&(_, (&[_, first], &count))| {
            let own = of_y.iter().skip(first).take(count);
            own.fold(false, |found, x| found | !x.is_finite())
        });
        ClusterError {
            cluster: found.map_or(T::MODEL.name, |(c, _)| T::CLUSTERS.name(c)),
            problem: ClusterProblem::NotFinite,
        }
    }

    /// Row v of G, beginning at a place of ẏ, and the entry of Ġ ẏ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn row(&self, v: usize) -> (usize, &[R], R) {
        let layout = Self::LAYOUT;
        match layout.cluster.get(v) {
            Some(&NONE) | None => (entry(&layout.free, v), &self.one, R::ZERO),
            Some(&c) => {
                let (g, bias) = <T::Clusters as Set>::row(&self.motions, c, entry(&layout.row, v));
                let first = layout.first.get(c).map_or(NONE, |first| first[1]);
                (first, g, bias)
            }
        }
    }
}
