//! Inverse dynamics: the recursive Newton-Euler algorithm in link coordinates.
//!
//! Featherstone & Orin (2000), equations (3) to (8); RBDA (2008), table 5.1. Bias, gravity and
//! full torque are this one function under different effects.

use heapless::Vec;

use crate::effects::{Effect, JointState};
use crate::model::Model;
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Posture, State, entry};

/// What the way out leaves for the way back.
#[derive(Clone, Copy)]
struct Body<R: Real> {
    x: Xform<R>,
    f: Force<R>,
}

/// τ = ID(q, q̇, q̈): the torque of each motor, N·m or N, under the effects named.
///
/// Shape: V. Cost: O(B); effects not named cost nothing. Errors: none; a non-finite input gives a
/// non-finite output, which [`crate::control`] gates. Source: Featherstone & Orin (2000).
///
/// ```
/// use dynamics_core::{algorithms::rnea, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let tau = rnea(&Ur5e::MODEL, &State::at([0.0; 6]), &RIGID_BODY);
/// assert!(tau[1] < -50.0 && tau[0] == 0.0); // the arm stretched out; gravity does not turn its base
/// ```
#[inline(always)]
pub fn rnea<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    state: &State<R, Q, V>,
    effects: &E,
) -> [R; V]
where
    E: Effect<R, B, V>,
{
    rnea_at(model, &Posture::of(model, &state.q), state, effects)
}

/// As [`rnea`], at a posture whose sines and cosines are at hand. `state.q` reaches joint effects.
#[inline(always)]
pub fn rnea_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    posture: &Posture<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
) -> [R; V]
where
    E: Effect<R, B, V>,
{
    let moving = const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY };
    let accelerated = const { E::FIELD | E::ACCELERATIONS | E::VELOCITY_PRODUCTS };
    let mut g = R::Vec3::ZERO;
    effects.field(&mut g);
    let (v_0, a_0) = (Motion::ZERO, Motion::new(R::Vec3::ZERO, -g));

    let mut v: Vec<Motion<R>, B> = Vec::new();
    let mut a: Vec<Motion<R>, B> = Vec::new();
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    for (i, link) in model.links.iter().enumerate() {
        let mut loaded = link.inertia;
        let inertia = if E::PAYLOAD && i + 1 == B {
            effects.payload(&mut loaded);
            &loaded
        } else {
            &link.inertia
        };
        let turn = entry(&posture.turns, link.q_at);
        let x = link.joint.xform(turn, &link.placement);
        let qd = entry(&state.qd, link.v_at);
        let mut v_i = Motion::ZERO;
        let mut f_i = Force::ZERO;
        if moving {
            v_i = x * *v.get(link.parent).unwrap_or(&v_0) + link.joint.motion(qd); // (3)
            let _ = v.push(v_i);
        }
        if accelerated {
            let mut a_i = x * *a.get(link.parent).unwrap_or(&a_0); // (4)
            if E::ACCELERATIONS {
                a_i += link.joint.motion(entry(&state.qdd, link.v_at));
            }
            if E::VELOCITY_PRODUCTS {
                a_i += link.joint.velocity_product(v_i, qd);
            }
            let _ = a.push(a_i);
            f_i = if E::VELOCITY_PRODUCTS {
                inertia.force(a_i, v_i) // (5)
            } else {
                *inertia * a_i
            };
        }
        if E::WRENCH {
            let mut fx = Force::ZERO;
            effects.wrench(i, v_i, &mut fx);
            f_i -= fx; // (6)
        }
        let _ = bodies.push(Body { x, f: f_i });
    }

    let mut tau = [R::ZERO; V];
    let mut inner = bodies.as_mut_slice();
    for link in model.links.iter().rev() {
        let Some((body, rest)) = inner.split_last_mut() else {
            break;
        };
        if let Some(tau) = tau.get_mut(link.v_at) {
            *tau = link.joint.project(body.f); // (8)
            let at = JointState {
                q: entry(&state.q, link.q_at),
                qd: entry(&state.qd, link.v_at),
                qdd: entry(&state.qdd, link.v_at),
            };
            effects.torque(link.v_at, at, tau);
        }
        if let Some(parent) = rest.get_mut(link.parent) {
            parent.f += body.x.transpose_mul(body.f); // (7)
        }
        inner = rest;
    }
    tau
}
