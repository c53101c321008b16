//! What the clusters' independent coordinates make of the spanning tree, and the maps back.

use core::fmt;

use super::description::Places;
use super::layout::{EXPANDED, INDEPENDENT, Layout, NONE, at};
use super::set::sealed::Set;
use super::{ClusterError, ClusterProblem, ClusteredRobot};
use crate::algorithms::MassMatrix;
use crate::engine::for_each_joint;
use crate::scalar::Real;
use crate::spatial::Motion;
use crate::state::{JointTrig, State, StateWithTrig, entry};

/// The spanning tree's state at y, ẏ, ÿ, with G: computed once a tick, for all algorithms.
///
/// Every algorithm of core and engine accepts [`TreeMotion::state`] or [`TreeMotion::configuration`]; what it returns
/// goes back to y by [`TreeMotion::torque`], [`TreeMotion::inertia`] and [`TreeMotion::jacobian`]:
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
    pub(super) const LAYOUT: Layout<Q, V> = Places::<T, B, P, Y>::layout::<Q, V>();

    /// γ(y), G ẏ and G ÿ + Ġ ẏ: the state of the tree with its sines and cosines.
    #[inline(always)]
    pub fn state(&self) -> StateWithTrig<'_, R, Q, V> {
        self.trig.with(&self.tree)
    }

    /// γ(y) with its sines and cosines.
    #[inline(always)]
    pub fn configuration(&self) -> &JointTrig<R, Q> {
        &self.trig
    }

    /// The name of the first cluster that is at a singularity, where G is damped.
    pub fn singular(&self) -> Option<&'static str> {
        let clusters = 0..<T::Clusters as Set>::SIZES.len();
        let found = clusters
            .into_iter()
            .find(|&c| <T::Clusters as Set>::singular(&self.motions, c));
        found.map(|c| T::CLUSTERS.name(c))
    }

    /// Gᵀ τ: the torques at y of the tree's torques, N·m or N. Cost: 2 M N flops for each cluster.
    #[inline(always)]
    pub fn torque(&self, tau: &[R; V]) -> [R; Y] {
        let mut out = [R::ZERO; Y];
        let layout = const { &Self::LAYOUT };
        for_each_joint!(J, {
            let place = const { at(&Self::LAYOUT.free, J) };
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
        MassMatrix {
            rows: columns.map(|column| self.torque(&column)),
        }
    }

    /// J G: the Jacobian with respect to ẏ of the tree's, by columns.
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

    /// The torques of the motors that do the work of the torques τ at y, N·m or N: G_aᵀ τ_a = τ of each cluster's
    /// actuated rows.
    ///
    /// In the places of y; a cluster without [`Driven::actuated`](super::Driven::actuated) rows has its motors at y.
    ///
    /// # Errors
    /// [`ClusterProblem::NotActuated`] names a cluster whose actuated coordinates do not determine the others: its
    /// motors are at a dead point.
    pub fn to_motors(&self, tau: &[R; Y]) -> Result<[R; Y], ClusterError> {
        let mut out = *tau;
        for c in 0..<T::Clusters as Set>::SIZES.len() {
            let Some((mut rows, first, n)) = self.actuation(c, tau) else {
                continue;
            };
            let rows = rows.get_mut(..n).unwrap_or_default();
            if solve(rows).is_none() {
                return Err(ClusterError {
                    cluster: T::CLUSTERS.name(c),
                    problem: ClusterProblem::NotActuated,
                });
            }
            for (out, &(_, x)) in out.iter_mut().skip(first).zip(&*rows) {
                *out = x;
            }
        }
        Ok(out)
    }

    /// The torques at y of the motors' torques, N·m or N: Gᵀ τ_a, the reverse of [`TreeMotion::to_motors`].
    pub fn from_motors(&self, tau: &[R; Y]) -> [R; Y] {
        let mut out = *tau;
        for c in 0..<T::Clusters as Set>::SIZES.len() {
            let Some((rows, first, n)) = self.actuation(c, tau) else {
                continue;
            };
            for (out, (row, _)) in out.iter_mut().skip(first).zip(&rows).take(n) {
                let terms = row.iter().zip(tau.iter().skip(first));
                *out = terms.fold(R::ZERO, |sum, (&g, &tau)| sum + g * tau);
            }
        }
        out
    }

    /// G_aᵀ of a cluster's actuated rows by rows, each with its entry of `tau`; where they begin in ẏ, and how many
    /// there are.
    fn actuation(&self, c: usize, tau: &[R; Y]) -> Option<([Row<R>; INDEPENDENT], usize, usize)> {
        let set = const { T::CLUSTERS };
        let actuated = set.actuated(c)?;
        let first = Self::LAYOUT.first.get(c)?[1];
        let row = |k| {
            let column = core::array::from_fn(|l| match actuated.get(l) {
                Some(&row) => entry(<T::Clusters as Set>::row(&self.motions, c, row).0, k),
                None => R::ZERO,
            });
            (column, entry(tau, first + k))
        };
        Some((core::array::from_fn(row), first, actuated.len()))
    }

    /// Row v of G, beginning at a place of ẏ, and the entry of Ġ ẏ.
    #[inline(always)]
    pub(super) fn row(&self, v: usize) -> (usize, &[R], R) {
        let layout = const { &Self::LAYOUT };
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

/// A row of A, and the entry of b.
type Row<R> = ([R; INDEPENDENT], R);

/// x with A x = b, in place of b, by elimination with row pivots; nothing where a pivot is below 64 roundings of A's
/// largest entry.
fn solve<R: Real>(rows: &mut [Row<R>]) -> Option<()> {
    let entries = rows.iter().flat_map(|(row, _)| row);
    let largest = entries.fold(R::ZERO, |most, a| {
        let size = a.abs();
        if size > most { size } else { most }
    });
    let least = largest * (R::EPSILON * R::from_f64(64.0));
    for k in 0..rows.len() {
        let (_, rest) = rows.split_at_mut_checked(k)?;
        let (first, others) = rest.split_first_mut()?;
        for other in &mut *others {
            if entry(&other.0, k).abs() > entry(&first.0, k).abs() {
                core::mem::swap(first, other);
            }
        }
        let pivot = entry(&first.0, k);
        // False of a NaN, too.
        let regular = pivot.abs() > least;
        if !regular {
            return None;
        }
        let inv = R::ONE / pivot;
        first.0 = first.0.map(|a| a * inv);
        first.1 *= inv;
        for (row, b) in others {
            let l = entry(row, k);
            for (a, &above) in row.iter_mut().zip(&first.0) {
                *a -= l * above;
            }
            *b -= l * first.1;
        }
    }
    for k in (0..rows.len()).rev() {
        let (above, rest) = rows.split_at_mut_checked(k)?;
        let (_, x) = *rest.first()?;
        for (row, b) in above {
            *b -= entry(row, k) * x;
        }
    }
    Some(())
}
