//! Articulated-body inertias without forces: pass 2 of RBDA (2008), table 7.1, for algorithms that
//! need only these.

use heapless::Vec;

use super::NotPositiveDefinite;
use super::pivot_check::{Magnitude, PivotCheck};
use super::tree_pass::inward;
use crate::effects::{Declared, Effect, add_inertia, body_inertia};
use crate::model::{JointCoordinate, RobotModel};
use crate::scalar::Real;
use crate::spatial::inertia::ArticulatedInertia;
use crate::spatial::{Force, Xform};

/// The result of the elimination of a coordinate: U and 1/D.
#[derive(Clone, Copy, Default)]
pub(super) struct JointFactor<R: Real> {
    pub(super) u_a: Force<R>,
    pub(super) d_inv: R,
    /// 1 − sᵀU/D: the share of the joint's inertia that is a rotor's, not the bodies'.
    pub(super) armature_share: R,
}

/// The results of the pass: ⁱX_λ(i) of every body, and the factor of every coordinate.
pub(super) struct ArticulatedPass<R: Real, const B: usize, const V: usize> {
    pub(super) x: Vec<Xform<R>, B>,
    pub(super) factors: [JointFactor<R>; V],
}

/// Eliminates every coordinate, from the tips to the base. Some 390 flops per revolute joint.
#[cfg_attr(optimised, inline(always))]
pub(super) fn eliminate<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    turns: &[JointCoordinate<R>; Q],
    effects: &E,
) -> Result<ArticulatedPass<R, B, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { assert!(!E::GYROSCOPIC_ROTORS, "no rotors that spin as bodies here; name `Armature`") };
    let mut bodies: Vec<(ArticulatedInertia<R>, Magnitude<R>), B> = Vec::new();
    let mut x = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let inertia = body_inertia(effects, i, &link);
        let _ = bodies.push((inertia.into(), Magnitude::from(&inertia)));
        let _ = x.push(link.xform(turns));
    }
    let mut factors = [JointFactor::default(); V];
    let mut pass = inward(&mut bodies);
    while let Some((&mut (body, magnitude), inner)) = pass.next() {
        let (Some(link), Some(x_i)) = (robot.link(inner.len()), x.get(inner.len())) else {
            break;
        };
        let (mut ia, mut pivots) = (body, PivotCheck::of(magnitude));
        for (k, joint) in link.coordinates().enumerate().rev() {
            let s = link.subspace(turns, k);
            let u_a = ia.along(&s);
            let bodies = s.dot(u_a);
            let mut d = bodies;
            add_inertia(effects, joint, &mut d);
            pivots.check(&link, k, turns, u_a, d)?;
            let d_inv = R::ONE / d;
            let armature_share = (d - bodies) * d_inv;
            ia = ia.minus_outer(u_a, d_inv);
            if let Some(factor) = factors.get_mut(joint) {
                *factor = JointFactor { u_a, d_inv, armature_share };
            }
        }
        if let Some((parent, parent_magnitude)) = inner.get_mut(link.parent) {
            *parent += ia.at_parent(x_i);
            *parent_magnitude += magnitude.at_parent(x_i.pos);
        }
    }
    Ok(ArticulatedPass { x, factors })
}
