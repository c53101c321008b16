//! The joint-space inertia matrix: the composite-rigid-body algorithm in link coordinates.
//!
//! Walker & Orin (1982); Featherstone & Orin (2000), section 3.3; RBDA (2008), table 6.2. Composite
//! inertias grow from the tips to the base; column j of M is the force that accelerates the composite
//! of joint j alone by one, felt at every joint on its way to the base.

use heapless::Vec;

use crate::algorithms::MassMatrix;
use crate::effects::{Effect, body_inertia, rotor_force};
use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::Xform;
use crate::spatial::inertia::CompositeInertia;
use crate::state::JointTrig;

/// M(q), kg·m² between revolute joints, kg between prismatic ones, kg·m mixed; with rotors and payload
/// if the scene has them, whatever else it names.
///
/// Shape: V × V, symmetric; an entry between joints of which neither carries the other is exactly zero.
/// Cost: for B revolute joints some 190 B flops and 40 for each joint that carries another; B² / 2 of
/// these on a chain. Errors: none; a non-finite input gives a non-finite output. Source: Walker & Orin
/// (1982); RBDA, table 6.2.
///
/// ```
/// use dynamics_core::{algorithms::crba, effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let m = crba(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
/// assert!(m.get(1, 1) > m.get(5, 5) && m.get(0, 3) == m.get(3, 0));
/// ```
#[inline(always)]
pub fn crba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &[R; Q],
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    crba_at(robot, &JointTrig::of(robot, q), effects)
}

/// As [`crba`], at a posture whose sines and cosines are at hand.
#[inline(always)]
pub fn crba_at<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &JointTrig<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    match robot.as_all_revolute() {
        Some(robot) => sweep(&robot, posture, effects),
        None => sweep(robot, posture, effects),
    }
}

/// What one pass leaves for the next.
struct Body<'a, R: Real> {
    link: LinkView<'a, R>,
    x: Xform<R>,
    ic: CompositeInertia<R>,
}

/// The two passes.
#[inline(always)]
fn sweep<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &JointTrig<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &posture.turns;
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
    let mut inner = bodies.as_mut_slice();
    while let Some((body, rest)) = core::mem::take(&mut inner).split_last_mut() {
        if let Some(parent) = rest.get_mut(body.link.parent) {
            parent.ic += body.ic.at_parent(&body.x);
        }
        for (k, joint) in body.link.coordinates().enumerate() {
            let mut f = body.ic.along(&body.link.subspace(turns, k));
            for (l, above) in body.link.coordinates().enumerate().take(k + 1) {
                m.set(joint, above, body.link.subspace(turns, l).dot(f));
            }
            if let Some(diagonal) = m.diagonal_mut(joint) {
                effects.add_inertia(joint, diagonal);
            }
            if E::GYROSCOPIC_ROTORS {
                f += rotor_force(effects, &body.link);
            }
            let mut below = &*body;
            while let Some(carrier) = rest.get(below.link.parent) {
                f = below.x.transpose_mul(f);
                for (l, above) in carrier.link.coordinates().enumerate() {
                    m.set(joint, above, carrier.link.subspace(turns, l).dot(f));
                }
                below = carrier;
            }
        }
        inner = rest;
    }
    m
}
