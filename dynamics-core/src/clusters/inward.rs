//! The second pass of forward dynamics by clusters: articulated inertias and bias forces, inward.
//!
//! All coordinates of a cluster are eliminated at once, when the pass reaches its first body. The
//! forces of its bodies are those of inverse dynamics within the cluster on a parent body at rest:
//! once at ÿ = 0, which gives u = τ − Gᵀ(…), and once for each unit ÿₖ, which gives a column of D
//! and of U. The joint of a body in no cluster is a cluster of one body with G = 1.

use super::aba::ForwardError;
use super::articulated::{Column, Group};
use super::description::sealed::Set;
use super::layout::{INDEPENDENT, NONE};
use super::passes::Passes;
use super::{ClusterError, ClusterProblem, ClusteredRobot};
use crate::algorithms::NotPositiveDefinite;
use crate::effects::{Effect, add_inertia, joint_torque};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, MotionSubspace};
use crate::state::entry;

/// The number of roundings that a pivot must exceed, relative to the largest inertia that the
/// bodies could have along its motion: twice those of the algorithm without clusters, since a body
/// of a cluster rotates and translates at once.
const ROUNDINGS: f64 = 16.0;

impl<R, T, E, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    Passes<'_, R, T, E, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
    E: Effect<R, B, V>,
{
    /// The second pass at body `i`: if it is the first of its group, the group's coordinates are
    /// eliminated.
    pub(super) fn inward(&mut self, i: usize, tau: &[R; Y]) -> Result<(), ForwardError> {
        let Some(group) = self.group(i) else {
            return Ok(());
        };
        let (motion, effects, n) = (self.motion, self.effects, group.count);
        let turns = &motion.trig.coordinates;
        // ÿ = 0: u = τ − Gᵀ (Sᵀ f + the torques of effects).
        let mut u: [R; INDEPENDENT] = core::array::from_fn(|k| entry(tau, group.first + k));
        let bias_force = self.forces(
            &group,
            true,
            |body| body.c,
            |body| {
                for (k, v) in body.link.coordinates().enumerate() {
                    let (first, g, bias) = motion.row(v);
                    let mut torque = body.link.subspace(turns, k).dot(body.force);
                    torque += joint_torque(effects, &body.link, &motion.tree, v);
                    if E::VELOCITY_PRODUCTS {
                        let mut rotor = R::ZERO;
                        add_inertia(effects, v, &mut rotor);
                        torque += rotor * bias;
                    }
                    let places = u.iter_mut().skip(first.wrapping_sub(group.first));
                    for (u, &g) in places.zip(g) {
                        *u -= g * torque;
                    }
                }
            },
        );
        // Unit ÿₖ: columns of D and of U, and how large D's diagonal could be.
        let mut columns = [Column::default(); INDEPENDENT];
        for (c, (column, &u)) in columns.iter_mut().zip(&u).enumerate().take(n) {
            let of = |first: usize, g: &[R]| entry(g, (group.first + c).wrapping_sub(first));
            let Column { d, noise, factor } = column;
            factor.u = u;
            factor.z = self.forces(
                &group,
                false,
                |body| {
                    let coordinates = body.link.coordinates().enumerate();
                    coordinates.fold(Motion::ZERO, |sum, (k, v)| {
                        let (first, g, _) = motion.row(v);
                        let s = body.link.subspace(turns, k);
                        s.add_scaled_to(sum, of(first, g))
                    })
                },
                |body| {
                    *noise += body.magnitude.along(&MotionSubspace::General(body.accel));
                    for (k, v) in body.link.coordinates().enumerate() {
                        let (first, g, _) = motion.row(v);
                        let mut rotor = R::ZERO;
                        add_inertia(effects, v, &mut rotor);
                        let s = body.link.subspace(turns, k);
                        let torque = s.dot(body.force) + rotor * of(first, g);
                        let sums = d.iter_mut().skip(first.wrapping_sub(group.first));
                        for (d, &g) in sums.zip(g) {
                            *d += g * torque;
                        }
                    }
                },
            );
        }
        // D = L Δ Lᵀ, with L⁻¹ Uᵀ and L⁻¹ u.
        for k in 0..n {
            let (before, at) = columns.split_at_mut_checked(k).unwrap_or_default();
            let Some(column) = at.first_mut() else {
                break;
            };
            let pivot = column.eliminate(before);
            // False of a NaN, too.
            let least = column.noise * (R::EPSILON * R::from_f64(ROUNDINGS));
            if !((pivot > least) & pivot.is_finite()) {
                return Err(self.no_inertia(&group, k));
            }
            if let Some(factor) = self.factors.get_mut(group.first + k) {
                *factor = column.factor;
            }
        }
        self.eliminate_group(&group, bias_force);
        Ok(())
    }

    /// Iᴬ and pᴬ of the group's parent body: Σ Xᵀ Iᴬ X − U D⁻¹ Uᵀ, and the bias force + U D⁻¹ u.
    fn eliminate_group(&mut self, group: &Group, bias_force: Force<R>) {
        let carrier = self.bodies.get(group.root).map(|body| body.link.parent);
        let Some(carrier) = carrier.filter(|&parent| parent < B) else {
            return; // No pass reads the forces on the base.
        };
        for i in (group.root..group.end).rev() {
            let member = self.is_in(group, i);
            let (inner, outer) = self.bodies.split_at_mut_checked(i).unwrap_or_default();
            let (true, Some(body)) = (member, outer.first()) else {
                continue;
            };
            if let Some(parent) = inner.get_mut(body.link.parent) {
                parent.ia += body.ia.at_parent(&body.x);
                parent.magnitude += body.magnitude.at_parent(body.x.pos);
            }
        }
        let Some(carrier) = self.bodies.get_mut(carrier) else {
            return;
        };
        carrier.pa += bias_force;
        for factor in self.factors.iter().skip(group.first).take(group.count) {
            carrier.ia = carrier.ia.minus_outer(factor.z, factor.d_inv);
            carrier.pa += factor.z * (factor.u * factor.d_inv);
        }
    }

    #[cold]
    fn no_inertia(&self, group: &Group, k: usize) -> ForwardError {
        if group.cluster == NONE {
            let link = self.bodies.get(group.root).map(|body| &body.link);
            let joint = link.map_or(NONE, |link| link.idx_v() + k);
            return ForwardError::Joint(NotPositiveDefinite { joint });
        }
        ForwardError::Cluster(ClusterError {
            cluster: T::CLUSTERS.name(group.cluster),
            problem: ClusterProblem::NoInertia,
        })
    }
}
