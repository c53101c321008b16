//! The joint-space inertia matrix: the composite-rigid-body algorithm in link coordinates.
//!
//! Walker & Orin (1982); Featherstone & Orin (2000), section 3.3; RBDA (2008), table 6.2. Composite inertias are
//! accumulated from the tips to the base; column j of M is the force of a unit acceleration of joint j on its composite
//! body, projected on every joint between it and the base.

use core::borrow::Borrow;

use heapless::Vec;

use super::chain;
use super::tree_pass::{Passed, inward, recalled};
use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, Scene, add_inertia, body_inertia, rotor_force};
use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::Xform;
use crate::spatial::inertia::CompositeInertia;
use crate::state::{Configuration, JointTrig};

/// The joint-space inertia matrix M(q), kg·m² between revolute joints, kg between prismatic ones, kg·m mixed.
///
/// Of the effects, armatures, rotors and payloads are part of M. A non-finite input gives a non-finite output.
///
/// ```text
/// Iᶜ_i = I_i + Σ_{λ(j)=i} ʲX_iᵀ Iᶜ_j ʲX_i      M_ij = M_ji = S_iᵀ ʲX_iᵀ Iᶜ_j S_j
/// ```
///
/// where joint i is joint j or one of its ancestors.
///
/// # Shape
/// V × V, symmetric; an entry between joints of which neither is an ancestor of the other is exactly zero.
///
/// # Cost
/// For B revolute joints some 190 B flops, and 40 for each pair of a joint and its ancestor: B² / 2 pairs on a chain.
///
/// # Source
/// Walker & Orin (1982); RBDA (2008), table 6.2.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::crba, effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let m = crba(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
/// assert!(m.get(1, 1) > m.get(5, 5) && m.get(0, 3) == m.get(3, 0));
/// ```
#[doc(alias = "HandC")]
#[doc(alias = "JSIM")]
#[doc(alias = "inertia matrix")]
#[doc(alias = "mass matrix")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn crba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    if const { D::MAY_BE_REVOLUTE }
        && let Some(robot) = robot.as_revolute_chain()
    {
        chain::crba::crba(&robot, trig, effects)
    } else if const { D::MAY_BE_REVOLUTE }
        && let Some(robot) = robot.as_all_revolute()
    {
        sweep(&robot, trig, effects)
    } else if const { D::MAY_HAVE_FIXED }
        && let Some(robot) = robot.as_revolute_or_fixed()
    {
        sweep(&robot, trig, effects)
    } else if const { D::CHAIN && D::SINGLE } {
        chain::crba::crba(robot, trig, effects)
    } else {
        sweep(robot, trig, effects)
    }
}

/// The results of the outward pass for the inward one.
struct Body<'a, R: Real> {
    link: LinkView<'a, R>,
    x: Xform<R>,
    ic: CompositeInertia<R>,
}

/// The two passes.
#[cfg_attr(optimised, inline(always))]
fn sweep<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    for i in 0..B {
        let Some(link) = robot.link(i) else {
            break;
        };
        let ic = body_inertia(effects, i, &link).into();
        let x = link.xform(turns);
        let _ = bodies.push(Body { link, x, ic });
    }

    let mut m = MassMatrix::ZERO;
    let mut pass = inward(&mut bodies);
    let mut passed = Passed::NONE;
    while let Some((body, inner)) = pass.next() {
        let link = recalled(robot, &body.link);
        let ic = passed.onto(&body.ic);
        let i = inner.len();
        if let Some(parent) = inner.get_mut(body.link.parent) {
            passed.add(&body.link, i, &mut parent.ic, ic.at_parent(&body.x));
        }
        for (k, joint) in link.coordinates().enumerate() {
            let mut f = ic.along(&link.subspace(turns, k));
            for (l, earlier) in link.coordinates().enumerate().take(k + 1) {
                m.set(joint, earlier, link.subspace(turns, l).dot(f));
            }
            if let Some(diagonal) = m.diagonal_mut(joint) {
                add_inertia(effects, joint, diagonal);
            }
            if E::GYROSCOPIC_ROTORS {
                f += rotor_force(effects, &body.link);
            }
            let mut child = &*body;
            while let Some(parent) = inner.get(child.link.parent) {
                f = child.x.transpose_mul(f);
                let link = recalled(robot, &parent.link);
                for (l, ancestor) in link.coordinates().enumerate() {
                    m.set(joint, ancestor, link.subspace(turns, l).dot(f));
                }
                child = parent;
            }
        }
    }
    m
}
