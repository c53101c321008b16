//! Articulated bodies without forces: the inward pass of RBDA (2008), table 7.1, for what needs no more.

use heapless::Vec;

use super::NotPositiveDefinite;
use super::taken::{Magnitude, Pivots};
use crate::articulated::ArticulatedInertia;
use crate::effects::{Effect, body_inertia};
use crate::model::{Description, Turn};
use crate::scalar::Real;
use crate::spatial::{Force, Xform};

/// What a coordinate's elimination leaves: U and 1/D.
#[derive(Clone, Copy, Default)]
pub(super) struct Handle<R: Real> {
    pub(super) u_hat: Force<R>,
    pub(super) per_d: R,
    /// 1 − sᵀU/D: what of the joint's inertia is not the bodies', but a rotor's.
    pub(super) held: R,
}

/// What the pass leaves: ⁱX_λ(i) of every body, and the handle of every coordinate.
pub(super) struct Eliminated<R: Real, const B: usize, const V: usize> {
    pub(super) x: Vec<Xform<R>, B>,
    pub(super) handles: [Handle<R>; V],
}

/// Eliminates every coordinate, from the tips to the base. Some 390 flops a revolute joint.
#[inline(always)]
pub(super) fn eliminate<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    turns: &[Turn<R>; Q],
    effects: &E,
) -> Result<Eliminated<R, B, V>, NotPositiveDefinite>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const {
        assert!(
            !E::SPINNING,
            "no rotors that spin as bodies here; name `RotorInertia`"
        )
    };
    let mut bodies: Vec<(ArticulatedInertia<R>, Magnitude<R>), B> = Vec::new();
    let mut x = Vec::new();
    for (i, node) in robot.nodes().enumerate() {
        let inertia = body_inertia(effects, i, &node);
        let _ = bodies.push((inertia.into(), Magnitude::from(&inertia)));
        let _ = x.push(node.xform(turns));
    }
    let mut handles = [Handle::default(); V];
    let mut inner = bodies.as_mut_slice();
    while let Some((&mut (body, carried), rest)) = core::mem::take(&mut inner).split_last_mut() {
        let (Some(node), Some(x_i)) = (robot.node(rest.len()), x.get(rest.len())) else {
            break;
        };
        let (mut ia, mut pivots) = (body, Pivots::of(carried));
        for (k, joint) in node.coordinates().enumerate().rev() {
            let s = node.axis(turns, k);
            let u_hat = ia.along(&s);
            let bodies = s.dot(u_hat);
            let mut d = bodies;
            effects.inertia(joint, &mut d);
            pivots.check((&node, k), turns, (u_hat, d), joint)?;
            let per_d = R::ONE / d;
            let held = (d - bodies) * per_d;
            ia = ia.minus_outer(u_hat, per_d);
            if let Some(handle) = handles.get_mut(joint) {
                *handle = Handle { u_hat, per_d, held };
            }
        }
        if let Some((parent, carries)) = rest.get_mut(node.parent) {
            *parent += ia.at_parent(x_i);
            *carries += carried.at_parent(x_i.pos);
        }
        inner = rest;
    }
    Ok(Eliminated { x, handles })
}
