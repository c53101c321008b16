//! Forward dynamics: the articulated-body algorithm in link coordinates.
//!
//! Featherstone, RBDA (2008), table 7.1; Featherstone & Orin (2000), section 3.2. A joint of several
//! degrees of freedom is eliminated a coordinate at a time, which is the same as by its block D. Where
//! [`hybrid`](super::hybrid()) prescribes a coordinate's motion, RBDA section 9.2, nothing is eliminated.

use heapless::Vec;

use super::handed::Handed;
use super::taken::{Magnitude, Pivots};
use super::{Given, NotPositiveDefinite, Response};
use crate::articulated::ArticulatedInertia;
use crate::effects::{
    Effect, base_motion, body_inertia, body_wrench, gyroscopic, joint_loss, rotor_force,
};
use crate::model::{Description, JointKind, Node};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Posture, State, entry};

/// q̈ = FD(q, q̇, τ): the acceleration of each joint, rad/s² or m/s², under the effects named.
///
/// Shape: V. Cost: O(B); some 590 flops a revolute joint. `state.qdd` is not read. Source: Featherstone (1983; RBDA table 7.1).
/// A scene without `Inertia` does not compile:
///
/// ```compile_fail
/// use dynamics_core::{Core, effects::Gravity, robots::Ur5e, state::State};
/// let _ = Core::<Ur5e>::aba(&State::at([0.0_f32; 6]), &[0.0; 6], &(Gravity::EARTH,));
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names the outermost coordinate that moves no inertia once those that it carries give way
/// (a massless last link without rotor inertia, a joint on the axis of another with no inertia between them, a
/// wrist without mass in gimbal lock), or whose inertia is not a number: its pivot is not above eight roundings of
/// the largest inertia that all that it carries, stretched out, could have about it. Of four joints or more without
/// inertia whose axes meet in one point rounding may leave more.
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
    let given = |joint| Given::Torque(entry(tau, joint));
    let response = match robot.revolutes() {
        Some(robot) => sweep(&robot, posture, state, effects, given)?,
        None => sweep(robot, posture, state, effects, given)?,
    };
    Ok(response.qdd)
}

/// What one pass leaves for the next.
struct Body<'a, R: Real> {
    node: Node<'a, R>,
    x: Xform<R>,
    c: Motion<R>,
    ia: ArticulatedInertia<R>,
    carried: Magnitude<R>,
    pa: Force<R>,
}

/// A coordinate on its own: U, 1/D and u; where its motion is prescribed, only U and sᵀ pᴬ.
#[derive(Clone, Copy)]
struct Handle<R: Real> {
    u_hat: Force<R>,
    per_d: R,
    u: R,
}

/// The three passes; each coordinate's torque or its acceleration is `given`.
#[inline(always)]
pub(super) fn sweep<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &Posture<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: impl Fn(usize) -> Given<R>,
) -> Result<Response<R, V>, NotPositiveDefinite>
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
    for i in 0..B {
        let Some(node) = robot.node(i) else {
            break;
        };
        let x = node.xform(turns);
        let v_i = node.plus_motion(x * v.by(D::CHAIN, node.parent), turns, &state.qd);
        let inertia = body_inertia(effects, i, &node);
        let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
        if E::VELOCITY_PRODUCTS {
            c = node.plus_velocity_product(Motion::ZERO, turns, &state.qd, v_i);
            pa = inertia.force(Motion::ZERO, v_i); // v ×* I v
        }
        if E::WRENCH {
            let mut pose = Xform::IDENTITY;
            if E::BODY_POSE {
                pose = x * poses.by(D::CHAIN, node.parent);
                poses.push(D::CHAIN, pose);
            }
            pa -= body_wrench(effects, i, &node, &pose, v_i);
        }
        if E::SPINNING
            && E::VELOCITY_PRODUCTS
            && let Some(parent) = bodies.get_mut(node.parent)
        {
            let rate = entry(&state.qd, node.velocity_at());
            let couple = gyroscopic(effects, &node, v_i.ang, rate, R::ZERO);
            parent.pa.ang += x.rot.transpose_mul(couple);
        }
        v.push(D::CHAIN, v_i);
        let (ia, carried) = (inertia.into(), Magnitude::from(&inertia));
        let _ = bodies.push(Body {
            node,
            x,
            c,
            ia,
            carried,
            pa,
        });
    }

    let mut handles: Vec<Handle<R>, V> = Vec::new(); // a stack: the last one made is the first used
    let mut inner = bodies.as_mut_slice();
    while let Some((body, rest)) = core::mem::take(&mut inner).split_last_mut() {
        let (mut ia, mut pa) = (body.ia, body.pa);
        let mut pivots = Pivots::of(body.carried);
        for (k, joint) in body.node.coordinates().enumerate().rev() {
            let s = body.node.axis(turns, k);
            let u_hat = ia.along(&s);
            let handle = match given(joint) {
                Given::Torque(tau) => {
                    let mut d = s.dot(u_hat);
                    effects.inertia(joint, &mut d);
                    pivots.check((&body.node, k), turns, (u_hat, d), joint)?;
                    let per_d = R::ONE / d;
                    let u = tau - joint_loss(effects, &body.node, state, joint) - s.dot(pa);
                    if E::SPINNING {
                        // A rotor feels and bears q̈ on the parent's side of the joint. Written twice:
                        // a sum that may be made or not costs scenes without rotors 18 instructions.
                        let u_hat = u_hat + rotor_force(effects, &body.node);
                        ia = ia.minus_outer(u_hat, per_d);
                        pa += u_hat * (u * per_d);
                        Handle { u_hat, per_d, u }
                    } else {
                        ia = ia.minus_outer(u_hat, per_d);
                        pa += u_hat * (u * per_d);
                        Handle { u_hat, per_d, u }
                    }
                }
                Given::Acceleration(qdd) => {
                    let (per_d, u) = (R::ZERO, s.dot(pa));
                    if E::SPINNING {
                        let u_hat = u_hat + rotor_force(effects, &body.node);
                        pa += u_hat * qdd;
                        Handle { u_hat, per_d, u }
                    } else {
                        pa += u_hat * qdd;
                        Handle { u_hat, per_d, u }
                    }
                }
            };
            let _ = handles.push(handle);
        }
        if let Some(parent) = rest.get_mut(body.node.parent) {
            pa += ia.times(body.c);
            parent.ia += ia.at_parent(&body.x);
            parent.carried += body.carried.at_parent(body.x.pos);
            parent.pa += body.x.transpose_mul(pa);
        }
        inner = rest;
    }

    let mut response = Response::ZERO;
    let mut a = Handed::<_, B>::from(a_0);
    for body in &bodies {
        let carried = body.x * a.by(D::CHAIN, body.node.parent) + body.c;
        // What is free of its parent does not feel it: what falls with all its joints at rest stays so exactly.
        let free = D::KINDS.has(JointKind::Free) && is_free(&body.node, effects, &given);
        let mut a_i = if free { Motion::ZERO } else { carried };
        for (k, joint) in body.node.coordinates().enumerate() {
            let Some(Handle { u_hat, per_d, u }) = handles.pop() else {
                break;
            };
            let s = body.node.axis(turns, k);
            let (tau, qdd) = match given(joint) {
                Given::Torque(tau) => (tau, (u - a_i.dot(u_hat)) * per_d),
                Given::Acceleration(qdd) => {
                    let (mut tau, mut rotor) = (a_i.dot(u_hat) + s.dot(u_hat) * qdd + u, R::ZERO);
                    if E::SPINNING {
                        tau -= s.dot(rotor_force(effects, &body.node)) * qdd;
                    }
                    effects.inertia(joint, &mut rotor);
                    tau += rotor * qdd + joint_loss(effects, &body.node, state, joint);
                    (tau, qdd)
                }
            };
            a_i = s.raise(a_i, qdd);
            response.set(joint, tau, qdd);
        }
        if free {
            let [ang, lin] = [a_i.ang - carried.ang, a_i.lin - carried.lin].map(R::Vec3::array);
            for (joint, &qdd) in body.node.coordinates().zip(ang.iter().chain(&lin)) {
                response.set(joint, entry(&response.tau, joint), qdd);
            }
        }
        a.push(D::CHAIN, a_i);
    }
    Ok(response)
}

/// Whether nothing ties a body to its parent: no constraint, no prescribed motion, no inertia at the joint.
#[inline(always)]
fn is_free<R: Real, E, const B: usize, const V: usize>(
    node: &Node<'_, R>,
    effects: &E,
    given: &impl Fn(usize) -> Given<R>,
) -> bool
where
    E: Effect<R, B, V>,
{
    matches!(node.kind(), JointKind::Free)
        && node.coordinates().all(|joint| {
            let mut inertia = R::ZERO;
            effects.inertia(joint, &mut inertia);
            matches!(given(joint), Given::Torque(_)) & (inertia == R::ZERO)
        })
}
