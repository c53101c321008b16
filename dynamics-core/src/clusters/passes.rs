//! The first and the third pass of forward dynamics by clusters,
//! [`Clustered::aba`](super::Clustered::aba), and the forces within a cluster; the second pass is
//! in `inward.rs`.

use super::places::TreeLayout;
use heapless::Vec;

use super::articulated::{Body, Factor, Group};
use super::layout::NONE;
use super::{ClusteredRobot, TreeMotion};
use crate::algorithms::Magnitude;
use crate::effects::{Declared, Effect, base_motion, body_inertia, body_wrench, no_load_friction};
use crate::model::{BASE, LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, Xform};
use crate::state::entry;

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
    pub(super) motion: &'a TreeMotion<R, T, B, Q, V, P, Y>,
    pub(super) effects: &'a E,
    pub(super) bodies: Vec<Body<'a, R>, B>,
    pub(super) factors: [Factor<R>; Y],
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
        no_load_friction::<R, E, B, V>();
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
        Self { motion, effects, bodies, factors: [Factor::default(); Y] }
    }

    /// The cluster of a body, or [`NONE`].
    fn cluster(&self, i: usize) -> usize {
        let link = self.bodies.get(i).map(|body| &body.link);
        let v = link.map_or(NONE, LinkView::idx_v);
        let clusters = &TreeLayout::<T, B, Q, V, P, Y>::LAYOUT.cluster;
        clusters.get(v).copied().unwrap_or(NONE)
    }

    /// The cluster or joint that moves body `i`, if `i` is its first body.
    pub(super) fn group(&self, i: usize) -> Option<Group> {
        let layout = TreeLayout::<T, B, Q, V, P, Y>::LAYOUT;
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
        Some(Group { root: i, end: i + 1, cluster, first, count })
    }

    /// Whether body `i` is of the group.
    pub(super) fn is_in(&self, group: &Group, i: usize) -> bool {
        i == group.root || (i < B && group.cluster != NONE && self.cluster(i) == group.cluster)
    }

    /// The forces within the group while its parent body is at rest: `accel` is the acceleration
    /// that a body's joints add, and `visit` is called for the bodies from the last to the first.
    /// Returns the force on the parent body.
    pub(super) fn forces(
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

    /// The factor of coordinate `k` of a group.
    fn factor(&self, group: &Group, k: usize) -> Factor<R> {
        entry(&self.factors, group.first + k)
    }

    /// The third pass: D ÿ = u − Uᵀ a of the body that carries the group, and aᵢ = X a_λ + c + S G
    /// ÿ.
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
                let qdd = of_group.zip(g).fold(R::ZERO, |sum, (&ydd, &g)| sum + g * ydd);
                let s = body.link.subspace(&motion.trig.coordinates, k);
                body.accel = s.add_scaled_to(body.accel, qdd);
            }
        }
        ydd
    }
}
