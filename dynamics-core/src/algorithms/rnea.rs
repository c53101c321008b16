//! Inverse dynamics: the recursive Newton-Euler algorithm in link coordinates.
//!
//! Featherstone & Orin (2000), equations (3) to (8); RBDA (2008), table 5.1. Bias, gravity and
//! full torque are this one function under different effects.

use core::borrow::Borrow;

use heapless::Vec;

use super::tree_pass::PerBody;
use crate::effects::{
    Effect, base_motion, body_inertia, body_wrench, gyroscopic, joint_torques, rotor_force,
};
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real};
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Configuration, JointTrig, RobotState, State, entry};

/// τ = ID(q, q̇, q̈): the torque of each motor, N·m or N, under the effects named.
///
/// Shape: V. Cost: O(B); 250 flops a revolute joint, less what no effect asks for. Errors: none; a
/// non-finite input gives a non-finite output, which [`crate::control`] gates. Source: Featherstone &
/// Orin (2000); Luh, Walker & Paul (1980).
///
/// ```
/// use dynamics_core::{algorithms::rnea, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let tau = rnea(&Ur5e::MODEL, &State::at([0.0; 6]), &RIGID_BODY);
/// assert!(tau[1] < -50.0 && tau[0] == 0.0); // the arm stretched out; gravity does not turn its base
/// ```
#[inline(always)]
pub fn rnea<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    match robot.as_all_revolute() {
        Some(robot) => sweep(&robot, trig, state, effects),
        None => sweep(robot, trig, state, effects),
    }
}

/// What the way out leaves for the way back.
#[derive(Clone, Copy)]
struct Body<R: Real> {
    rot: R::Mat3,
    f: Force<R>,
}

/// The two passes.
#[inline(always)]
fn sweep<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let moving = const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY };
    let accelerated = const { E::FIELD | E::BASE_MOTION | E::ACCELERATIONS | E::VELOCITY_PRODUCTS };
    let (v_0, a_0) = base_motion(effects);
    let mut v = PerBody::<_, B>::from(v_0);
    let mut poses = PerBody::<_, B>::from(Xform::IDENTITY);
    let mut a = PerBody::<_, B>::from(a_0);
    let turns = &trig.turns;

    let mut bodies: Vec<Body<R>, B> = Vec::new();
    let mut turned_along = [R::ZERO; V]; // ρ I z·α_λ of the rotors
    for i in 0..B {
        let Some(link) = robot.link(i) else {
            break;
        };
        let x = link.xform(turns);
        let mut v_i = Motion::ZERO;
        let mut f_i = Force::ZERO;
        if moving {
            v_i = link.plus_motion(x * v.parent(D::CHAIN, link.parent), turns, &state.qd); // (3)
            v.push(D::CHAIN, v_i);
        }
        if accelerated {
            let mut a_i = x * a.parent(D::CHAIN, link.parent); // (4)
            if E::GYROSCOPIC_ROTORS
                && let Some(tau) = turned_along.get_mut(link.idx_v())
            {
                *tau = a_i.dot(rotor_force(effects, &link));
            }
            if E::ACCELERATIONS {
                a_i = link.plus_motion(a_i, turns, &state.qdd);
            }
            if E::VELOCITY_PRODUCTS {
                a_i = link.plus_velocity_product(a_i, turns, &state.qd, v_i);
            }
            a.push(D::CHAIN, a_i);
            let inertia = body_inertia(effects, i, &link);
            f_i = if E::VELOCITY_PRODUCTS {
                inertia.force(a_i, v_i) // (5)
            } else {
                inertia * a_i
            };
        }
        if E::WRENCH {
            let mut pose = Xform::IDENTITY;
            if E::BODY_POSE {
                pose = x * poses.parent(D::CHAIN, link.parent);
                poses.push(D::CHAIN, pose);
            }
            f_i -= body_wrench(effects, i, &link, &pose, v_i); // (6)
        }
        if E::GYROSCOPIC_ROTORS
            && let Some(parent) = bodies.get_mut(link.parent)
        {
            let at = link.idx_v();
            let rate = if E::VELOCITY_PRODUCTS {
                entry(&state.qd, at)
            } else {
                R::ZERO
            };
            let accel = if E::ACCELERATIONS {
                entry(&state.qdd, at)
            } else {
                R::ZERO
            };
            let couple = gyroscopic(effects, &link, v_i.ang, rate, accel);
            parent.f.ang += x.rot.transpose_mul(couple);
        }
        let _ = bodies.push(Body { rot: x.rot, f: f_i });
    }

    let mut tau = [R::ZERO; V];
    let mut below = Force::ZERO; // what the one body above asks of a chain
    let mut inner = bodies.as_mut_slice();
    while let Some((body, rest)) = inner.split_last_mut() {
        let Some(link) = robot.link(rest.len()) else {
            break;
        };
        let f_i = if D::CHAIN { body.f + below } else { body.f };
        link.project(turns, f_i, &mut tau); // (8)
        joint_torques(effects, &link, state, &mut tau);
        if E::GYROSCOPIC_ROTORS
            && let Some(tau) = tau.get_mut(link.idx_v())
        {
            *tau += entry(&turned_along, link.idx_v());
        }
        if rest.is_empty() {
            break; // the first body stands on the base
        }
        let (rot, pos) = (body.rot, link.origin(turns));
        let f_parent = Xform { rot, pos }.transpose_mul(f_i); // (7)
        if D::CHAIN {
            below = f_parent;
        } else if let Some(parent) = rest.get_mut(link.parent) {
            parent.f += f_parent;
        }
        inner = rest;
    }
    tau
}
