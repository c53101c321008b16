//! Forward dynamics: the articulated-body algorithm in link coordinates.
//!
//! Featherstone, RBDA (2008), table 7.1; Featherstone & Orin (2000), section 3.2. A joint of several
//! degrees of freedom is eliminated a coordinate at a time, which is the same as by its block D. Where
//! [`hybrid_dynamics`](super::hybrid_dynamics()) prescribes a coordinate's motion, RBDA section 9.2, nothing is eliminated.

use heapless::Vec;

use super::pivot_check::{Magnitude, PivotCheck};
use super::tree_pass::PerBody;
use super::{JointResult, NotPositiveDefinite, Prescribed};
use crate::effects::{
    Effect, base_motion, body_inertia, body_wrench, gyroscopic, joint_torque, rotor_force,
};
use crate::model::{JointKind, LinkView, RobotModel};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::inertia::ArticulatedInertia;
use crate::spatial::{Force, Motion, Xform};
use crate::state::{JointTrig, State, entry};

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
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    aba_at(robot, &JointTrig::of(robot, &state.q), state, tau, effects)
}

/// As [`aba`], at a posture whose sines and cosines are at hand.
///
/// # Errors
/// As [`aba`].
#[inline(always)]
pub fn aba_at<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let given = |joint| Prescribed::Torque(entry(tau, joint));
    let response = match robot.as_all_revolute() {
        Some(robot) => sweep(&robot, posture, state, effects, given)?,
        None => sweep(robot, posture, state, effects, given)?,
    };
    Ok(response.qdd)
}

/// What one pass leaves for the next.
struct Body<'a, R: Real> {
    link: LinkView<'a, R>,
    x: Xform<R>,
    c: Motion<R>,
    ia: ArticulatedInertia<R>,
    carried: Magnitude<R>,
    pa: Force<R>,
}

/// A coordinate on its own: U, 1/D and u; where its motion is prescribed, only U and sᵀ pᴬ.
#[derive(Clone, Copy)]
struct JointFactor<R: Real> {
    u_a: Force<R>,
    d_inv: R,
    u: R,
}

/// The three passes; each coordinate's torque or its acceleration is `given`.
#[inline(always)]
pub(super) fn sweep<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: impl Fn(usize) -> Prescribed<R>,
) -> Result<JointResult<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
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

    let mut v = PerBody::<_, B>::from(v_0);
    let mut poses = PerBody::<_, B>::from(Xform::IDENTITY);
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    for i in 0..B {
        let Some(link) = robot.link(i) else {
            break;
        };
        let x = link.xform(turns);
        let v_i = link.plus_motion(x * v.parent(D::CHAIN, link.parent), turns, &state.qd);
        let inertia = body_inertia(effects, i, &link);
        let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
        if E::VELOCITY_PRODUCTS {
            c = link.plus_velocity_product(Motion::ZERO, turns, &state.qd, v_i);
            pa = inertia.force(Motion::ZERO, v_i); // v ×* I v
        }
        if E::WRENCH {
            let mut pose = Xform::IDENTITY;
            if E::BODY_POSE {
                pose = x * poses.parent(D::CHAIN, link.parent);
                poses.push(D::CHAIN, pose);
            }
            pa -= body_wrench(effects, i, &link, &pose, v_i);
        }
        if E::GYROSCOPIC_ROTORS
            && E::VELOCITY_PRODUCTS
            && let Some(parent) = bodies.get_mut(link.parent)
        {
            let rate = entry(&state.qd, link.idx_v());
            let couple = gyroscopic(effects, &link, v_i.ang, rate, R::ZERO);
            parent.pa.ang += x.rot.transpose_mul(couple);
        }
        v.push(D::CHAIN, v_i);
        let (ia, carried) = (inertia.into(), Magnitude::from(&inertia));
        let _ = bodies.push(Body {
            link,
            x,
            c,
            ia,
            carried,
            pa,
        });
    }

    let mut handles: Vec<JointFactor<R>, V> = Vec::new(); // a stack: the last one made is the first used
    let mut inner = bodies.as_mut_slice();
    while let Some((body, rest)) = core::mem::take(&mut inner).split_last_mut() {
        let (mut ia, mut pa) = (body.ia, body.pa);
        let mut pivots = PivotCheck::of(body.carried);
        for (k, joint) in body.link.coordinates().enumerate().rev() {
            let s = body.link.subspace(turns, k);
            let u_a = ia.along(&s);
            let handle = match given(joint) {
                Prescribed::Torque(tau) => {
                    let mut d = s.dot(u_a);
                    effects.add_inertia(joint, &mut d);
                    pivots.check((&body.link, k), turns, (u_a, d), joint)?;
                    let d_inv = R::ONE / d;
                    let u = tau - joint_torque(effects, &body.link, state, joint) - s.dot(pa);
                    if E::GYROSCOPIC_ROTORS {
                        // A rotor feels and bears q̈ on the parent's side of the joint. Written twice:
                        // a sum that may be made or not costs scenes without rotors 18 instructions.
                        let u_a = u_a + rotor_force(effects, &body.link);
                        ia = ia.minus_outer(u_a, d_inv);
                        pa += u_a * (u * d_inv);
                        JointFactor { u_a, d_inv, u }
                    } else {
                        ia = ia.minus_outer(u_a, d_inv);
                        pa += u_a * (u * d_inv);
                        JointFactor { u_a, d_inv, u }
                    }
                }
                Prescribed::Acceleration(qdd) => {
                    let (d_inv, u) = (R::ZERO, s.dot(pa));
                    if E::GYROSCOPIC_ROTORS {
                        let u_a = u_a + rotor_force(effects, &body.link);
                        pa += u_a * qdd;
                        JointFactor { u_a, d_inv, u }
                    } else {
                        pa += u_a * qdd;
                        JointFactor { u_a, d_inv, u }
                    }
                }
            };
            let _ = handles.push(handle);
        }
        if let Some(parent) = rest.get_mut(body.link.parent) {
            pa += ia.times(body.c);
            parent.ia += ia.at_parent(&body.x);
            parent.carried += body.carried.at_parent(body.x.pos);
            parent.pa += body.x.transpose_mul(pa);
        }
        inner = rest;
    }

    let mut response = JointResult::ZERO;
    let mut a = PerBody::<_, B>::from(a_0);
    for body in &bodies {
        let carried = body.x * a.parent(D::CHAIN, body.link.parent) + body.c;
        // What is free of its parent does not feel it: what falls with all its joints at rest stays so exactly.
        let free = D::KINDS.has(JointKind::Free) && is_free(&body.link, effects, &given);
        let mut a_i = if free { Motion::ZERO } else { carried };
        for (k, joint) in body.link.coordinates().enumerate() {
            let Some(JointFactor { u_a, d_inv, u }) = handles.pop() else {
                break;
            };
            let s = body.link.subspace(turns, k);
            let (tau, qdd) = match given(joint) {
                Prescribed::Torque(tau) => (tau, (u - a_i.dot(u_a)) * d_inv),
                Prescribed::Acceleration(qdd) => {
                    let (mut tau, mut rotor) = (a_i.dot(u_a) + s.dot(u_a) * qdd + u, R::ZERO);
                    if E::GYROSCOPIC_ROTORS {
                        tau -= s.dot(rotor_force(effects, &body.link)) * qdd;
                    }
                    effects.add_inertia(joint, &mut rotor);
                    tau += rotor * qdd + joint_torque(effects, &body.link, state, joint);
                    (tau, qdd)
                }
            };
            a_i = s.add_scaled_to(a_i, qdd);
            response.set(joint, tau, qdd);
        }
        if free {
            let [ang, lin] = [a_i.ang - carried.ang, a_i.lin - carried.lin].map(R::Vec3::array);
            for (joint, &qdd) in body.link.coordinates().zip(ang.iter().chain(&lin)) {
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
    link: &LinkView<'_, R>,
    effects: &E,
    given: &impl Fn(usize) -> Prescribed<R>,
) -> bool
where
    E: Effect<R, B, V>,
{
    matches!(link.kind(), JointKind::Free)
        && link.coordinates().all(|joint| {
            let mut inertia = R::ZERO;
            effects.add_inertia(joint, &mut inertia);
            matches!(given(joint), Prescribed::Torque(_)) & (inertia == R::ZERO)
        })
}
