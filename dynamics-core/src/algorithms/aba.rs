//! Forward dynamics: the articulated-body algorithm in link coordinates.
//!
//! Featherstone, RBDA (2008), table 7.1; Featherstone & Orin (2000), section 3.2. A joint of several
//! degrees of freedom is eliminated a coordinate at a time, which is the same as by its block D.

use heapless::Vec;

use super::NotPositiveDefinite;
use super::handed::Handed;
use crate::articulated::ArticulatedInertia;
use crate::effects::{Effect, base_motion, body_inertia, body_wrench, joint_losses};
use crate::model::{Description, Node};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Posture, State, entry};

/// What one pass leaves for the next.
struct Body<'a, R: Real> {
    node: Node<'a, R>,
    x: Xform<R>,
    c: Motion<R>,
    ia: ArticulatedInertia<R>,
    pa: Force<R>,
}

/// A coordinate on its own: U, 1/D and u.
#[derive(Clone, Copy, Default)]
struct Handle<R: Real> {
    u_hat: Force<R>,
    per_d: R,
    u: R,
}

/// q̈ = FD(q, q̇, τ): the acceleration of each joint, rad/s² or m/s², under the effects named.
///
/// Shape: V. Cost: O(B); some 700 flops a revolute joint. `state.qdd` is not read. Source: Featherstone (1983; RBDA table 7.1).
/// A scene without `Inertia` does not compile:
///
/// ```compile_fail
/// use dynamics_core::{Core, effects::Gravity, robots::Ur5e, state::State};
/// let _ = Core::<Ur5e>::aba(&State::at([0.0_f32; 6]), &[0.0; 6], &(Gravity::EARTH,));
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names a joint that moves no inertia (a massless last link without rotor
/// inertia), or whose inertia is not a number.
#[inline(always)]
pub fn aba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    aba_at(robot, &Posture::of(robot, &state.q), state, tau, effects)
}

/// As [`aba`], at a posture whose sines and cosines are at hand.
///
/// # Errors
/// As [`aba`].
#[inline(always)]
pub fn aba_at<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &Posture<R, Q>,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const {
        assert!(
            E::ACCELERATIONS,
            "forward dynamics needs `Inertia` in the scene"
        )
    };
    let (v_0, a_0) = base_motion(effects);
    let turns = &posture.turns;

    let mut v = Handed::<_, B>::from(v_0);
    let mut poses = Handed::<_, B>::from(Xform::IDENTITY);
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    for (i, node) in robot.nodes().enumerate() {
        let x = node.xform(turns);
        let v_i = node.plus_motion(x * v.by(D::CHAIN, node.parent), turns, &state.qd);
        let inertia = body_inertia(effects, i, &node);
        let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
        if E::VELOCITY_PRODUCTS {
            c = node.plus_velocity_product(Motion::ZERO, turns, &state.qd, v_i);
            pa = v_i.cross_force(inertia * v_i);
        }
        if E::WRENCH {
            let mut pose = Xform::IDENTITY;
            if E::BODY_POSE {
                pose = x * poses.by(D::CHAIN, node.parent);
                poses.push(D::CHAIN, pose);
            }
            pa -= body_wrench(effects, i, &node, &pose, v_i);
        }
        v.push(D::CHAIN, v_i);
        let ia = inertia.into();
        let _ = bodies.push(Body { node, x, c, ia, pa });
    }

    let mut handles = [Handle::default(); V];
    let losses = joint_losses(effects, robot, state);
    let mut inner = bodies.as_mut_slice();
    while let Some((body, rest)) = core::mem::take(&mut inner).split_last_mut() {
        let (mut ia, mut pa) = (body.ia, body.pa);
        for (k, joint) in body.node.coordinates().enumerate().rev() {
            let s = body.node.column(turns, k);
            let u_hat = ia * s;
            let mut d = s.dot(u_hat);
            effects.inertia(joint, &mut d);
            // One comparison that a NaN fails too.
            if !(d > R::ZERO && d.is_finite()) {
                return Err(NotPositiveDefinite { joint });
            }
            let per_d = R::ONE / d;
            let u = entry(tau, joint) - entry(&losses, joint) - s.dot(pa);
            ia = ia.minus_outer(u_hat, per_d);
            pa += u_hat * (u * per_d);
            if let Some(handle) = handles.get_mut(joint) {
                *handle = Handle { u_hat, per_d, u };
            }
        }
        if let Some(parent) = rest.get_mut(body.node.parent) {
            pa += ia * body.c;
            parent.ia += ia.at_parent(&body.x);
            parent.pa += body.x.transpose_mul(pa);
        }
        inner = rest;
    }

    let mut qdd = [R::ZERO; V];
    let mut a = Handed::<_, B>::from(a_0);
    for body in &bodies {
        let mut a_i = body.x * a.by(D::CHAIN, body.node.parent) + body.c;
        for (k, joint) in body.node.coordinates().enumerate() {
            let Handle { u_hat, per_d, u } = entry(&handles, joint);
            let qdd_k = (u - a_i.dot(u_hat)) * per_d;
            a_i += body.node.column(turns, k) * qdd_k;
            if let Some(qdd) = qdd.get_mut(joint) {
                *qdd = qdd_k;
            }
        }
        a.push(D::CHAIN, a_i);
    }
    Ok(qdd)
}
