//! The passes of forward dynamics by clusters: [`Clustered::aba`](super::Clustered::aba).
//!
//! All bodies of a cluster give way at once, when the pass from the tips reaches the first of them. Its bodies' forces
//! are those of inverse dynamics within the cluster on a body that does not accelerate: once at ÿ = 0, which makes u =
//! τ − Gᵀ(…), and once for each unit ÿₖ, which makes a column of D and of U. The joint of a body in no cluster is a
//! cluster of one body with G = 1.

use heapless::Vec;

use super::aba::ForwardError;
use super::articulated::{Body, Column, Factor, Group};
use super::layout::{INDEPENDENT, NONE};
use super::set::sealed::Set;
use super::{ClusterError, ClusterProblem, ClusteredRobot, TreeMotion};
use crate::algorithms::{Magnitude, NotPositiveDefinite};
use crate::effects::{Effect, base_motion, body_inertia, body_wrench, joint_torque};
use crate::model::{BASE, LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, MotionSubspace, Xform};
use crate::state::entry;

/// How many roundings a pivot must exceed, relative to what the bodies could have: twice those of the algorithm without
/// clusters, since the motion of a cluster's body is a turn and a slide at once.
const ROUNDINGS: f64 = 16.0;

/// The articulated bodies of a tree of clusters.
pub(super) struct Passes<
    'a,
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
> {
    motion: &'a TreeMotion<R, T, B, Q, V, P, Y>,
    effects: &'a E,
    bodies: Vec<Body<'a, R>, B>,
    factors: [Factor<R>; Y],
}

impl<'a, R, T, E, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    Passes<'a, R, T, E, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
    E: Effect<R, B, V>,
{
    /// The first pass: vᵢ, cᵢ and, of each body alone, Iᴬ = I and pᴬ = v ×* I v − fˣ.
    pub(super) fn new(
        robot: &'a impl RobotModel<R, B, Q, V>,
        motion: &'a TreeMotion<R, T, B, Q, V, P, Y>,
        effects: &'a E,
    ) -> Self {
        let (turns, tree) = (&motion.trig.coordinates, &motion.tree);
        let (v_0, _) = base_motion(effects);
        let (mut v, mut poses): (Vec<Motion<R>, B>, Vec<Xform<R>, B>) = (Vec::new(), Vec::new());
        let mut bodies = Vec::new();
        for (i, link) in robot.links().enumerate() {
            let x = link.xform(turns);
            let v_i = link.plus_motion(x * *v.get(link.parent).unwrap_or(&v_0), turns, &tree.qd);
            let inertia = body_inertia(effects, i, &link);
            let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
            if E::VELOCITY_PRODUCTS {
                c = link.plus_velocity_product(c, turns, &tree.qd, v_i);
                for (k, coordinate) in link.coordinates().enumerate() {
                    let (_, _, bias) = motion.row(coordinate);
                    c = link.subspace(turns, k).add_scaled_to(c, bias);
                }
                pa = inertia.bias_force(v_i);
            }
            if E::WRENCH {
                let pose = x * *poses.get(link.parent).unwrap_or(&Xform::IDENTITY);
                let _ = poses.push(pose);
                pa -= body_wrench(effects, i, &link, &pose, v_i);
            }
            let _ = v.push(v_i);
            let _ = bodies.push(Body {
                link,
                x,
                c,
                ia: inertia.into(),
                pa,
                magnitude: Magnitude::from(&inertia),
                accel: Motion::ZERO,
                force: Force::ZERO,
            });
        }
        Self {
            motion,
            effects,
            bodies,
            factors: [Factor::default(); Y],
        }
    }

    /// The cluster of a body, or [`NONE`].
    fn cluster(&self, i: usize) -> usize {
        let link = self.bodies.get(i).map(|body| &body.link);
        let v = link.map_or(NONE, LinkView::idx_v);
        let clusters = const { &TreeMotion::<R, T, B, Q, V, P, Y>::LAYOUT.cluster };
        clusters.get(v).copied().unwrap_or(NONE)
    }

    /// What moves at once with body `i`, if this is the first body of it.
    fn group(&self, i: usize) -> Option<Group> {
        let layout = const { &TreeMotion::<R, T, B, Q, V, P, Y>::LAYOUT };
        let cluster = self.cluster(i);
        if let (Some(&root), Some(&[_, first])) =
            (layout.root.get(cluster), layout.first.get(cluster))
        {
            let count = entry(&layout.count, cluster);
            return (root == i).then_some(Group {
                root,
                end: entry(&layout.end, cluster),
                cluster,
                first,
                count,
            });
        }
        let coordinates = self.bodies.get(i)?.link.coordinates();
        let (count, first) = (coordinates.len(), entry(&layout.free, coordinates.start));
        Some(Group {
            root: i,
            end: i + 1,
            cluster,
            first,
            count,
        })
    }

    /// Whether body `i` is of the group.
    fn is_in(&self, group: &Group, i: usize) -> bool {
        i == group.root || (i < B && group.cluster != NONE && self.cluster(i) == group.cluster)
    }

    /// The forces within the group while the body that carries it is at rest: `accel` is what each body's joints add to
    /// its acceleration, and `visit` sees the bodies from the last to the first. Returns what reaches the body that
    /// carries the group.
    fn forces(
        &mut self,
        group: &Group,
        biased: bool,
        accel: impl Fn(&Body<'a, R>) -> Motion<R>,
        mut visit: impl FnMut(&Body<'a, R>),
    ) -> Force<R> {
        for i in group.root..group.end {
            let members = self.is_in(group, i);
            let (inner, outer) = self.bodies.split_at_mut_checked(i).unwrap_or_default();
            let (true, Some(body)) = (members, outer.first_mut()) else {
                continue;
            };
            body.accel = accel(body);
            if let Some(parent) = group.parent_in(inner, &body.link) {
                body.accel += body.x * parent.accel;
            }
            body.force = body.ia.times(body.accel);
            if biased {
                body.force += body.pa;
            }
        }
        let mut total = Force::ZERO;
        for i in (group.root..group.end).rev() {
            let members = self.is_in(group, i);
            let (inner, outer) = self.bodies.split_at_mut_checked(i).unwrap_or_default();
            let (true, Some(body)) = (members, outer.first()) else {
                continue;
            };
            visit(body);
            let force = body.x.transpose_mul(body.force);
            match group.parent_in(inner, &body.link) {
                Some(parent) => parent.force += force,
                None => total += force,
            }
        }
        total
    }

    /// The second pass at body `i`: if it is the first of its group, the group gives way.
    pub(super) fn inward(&mut self, i: usize, tau: &[R; Y]) -> Result<(), ForwardError> {
        let Some(group) = self.group(i) else {
            return Ok(());
        };
        let (motion, effects, n) = (self.motion, self.effects, group.count);
        let turns = &motion.trig.coordinates;
        // ÿ = 0: u = τ − Gᵀ (Sᵀ f + what effects take).
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
                        effects.add_inertia(v, &mut rotor);
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
                        effects.add_inertia(v, &mut rotor);
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
        self.give_way(&group, bias_force);
        Ok(())
    }

    /// Iᴬ and pᴬ of the body that carries the group: Σ Xᵀ Iᴬ X − U D⁻¹ Uᵀ, and the bias force + U D⁻¹ u.
    fn give_way(&mut self, group: &Group, bias_force: Force<R>) {
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
        let carrier = self.bodies.get(group.root).map(|body| body.link.parent);
        let Some(carrier) = carrier.and_then(|parent| self.bodies.get_mut(parent)) else {
            return;
        };
        carrier.pa += bias_force;
        for factor in self.factors.iter().skip(group.first).take(group.count) {
            carrier.ia = carrier.ia.minus_outer(factor.z, factor.d_inv);
            carrier.pa += factor.z * (factor.u * factor.d_inv);
        }
    }

    /// The factor of coordinate `k` of a group.
    fn factor(&self, group: &Group, k: usize) -> Factor<R> {
        entry(&self.factors, group.first + k)
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

    /// The third pass: D ÿ = u − Uᵀ a of the body that carries the group, and aᵢ = X a_λ + c + S G ÿ.
    pub(super) fn outward(&mut self) -> [R; Y] {
        let (_, a_0) = base_motion(self.effects);
        let (motion, mut ydd) = (self.motion, [R::ZERO; Y]);
        for i in 0..B {
            let carrier = self.bodies.get(i).map_or(BASE, |body| body.link.parent);
            let a = self.bodies.get(carrier).map_or(a_0, |body| body.accel);
            if let Some(group) = self.group(i) {
                for k in (0..group.count).rev() {
                    let Factor { z, d_inv, u, .. } = self.factor(&group, k);
                    let mut x = (u - a.dot(z)) * d_inv;
                    for j in k + 1..group.count {
                        let l = entry(&self.factor(&group, j).l, k);
                        x -= l * entry(&ydd, group.first + j);
                    }
                    if let Some(ydd) = ydd.get_mut(group.first + k) {
                        *ydd = x;
                    }
                }
            }
            let Some(body) = self.bodies.get_mut(i) else {
                break;
            };
            body.accel = body.x * a + body.c;
            for (k, v) in body.link.coordinates().enumerate() {
                let (first, g, _) = motion.row(v);
                let of_group = ydd.get(first..).unwrap_or(&[]).iter();
                let qdd = of_group
                    .zip(g)
                    .fold(R::ZERO, |sum, (&ydd, &g)| sum + g * ydd);
                let s = body.link.subspace(&motion.trig.coordinates, k);
                body.accel = s.add_scaled_to(body.accel, qdd);
            }
        }
        ydd
    }
}
