//! Inverse dynamics of two velocities: the recursive Newton-Euler algorithm for laws that keep the
//! arm passive.
//!
//! De Luca & Ferrajoli, "A modified Newton-Euler method for dynamic computations in robot fault
//! detection and control" (2009); with the symmetric force of a body of Echeandia & Wensing,
//! "Numerical methods to compute the Coriolis matrix and Christoffel symbols for rigid-body
//! systems" (2021).

use core::borrow::Borrow;

use heapless::Vec;

use super::rnea::external_force;
use super::tree_pass::{inward, per_body};
use crate::effects::{
    Declared, Effect, Scene, base_motion, body_inertia, joint_torques, load_frictions, rotor_force,
};
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{BodyCoriolis, Force, Motion, Xform};
use crate::state::{Configuration, RobotState, entry};

/// The results of the outward pass for the inward one.
struct Body<R: Real> {
    rot: R::Mat3,
    f: Force<R>,
    /// The torque at the rotor due to the motion of the parent.
    rotor: R,
}

/// The torque M q̈_r + C(q, q̇) q̇_r + g + F of each motor, N·m or N, under the effects of the
/// scene, by one pass over the tree.
///
/// q, q̇ and q̈_r are those of `state`, `qd_r` is the second velocity. With the effects of a scene
/// switched off, parts remain: under [`Coriolis`](crate::effects::Coriolis) alone the result is
/// C(q, q̇) q̇_r. Friction, springs and external wrenches are those at q and q̇. With q̇_r = q̇ the
/// result is that of [`rnea`](crate::algorithms::rnea()).
///
/// Both velocities v (of q̇) and w (of q̇_r) follow from the base to the tips, as do the
/// accelerations, with a₀ = −g:
///
/// ```text
/// a_i     = ⁱX_λ(i) a_λ(i) + S_i q̈_r,i + (S̊_i + v_i × S_i) q̇_r,i
/// f_i     = I_i a_i + B(I_i, v_i) w_i − fˣ_i + Σ_{λ(j)=i} ʲX_iᵀ f_j      τ_i = S_iᵀ f_i
/// B(I, v) = ½ [(v ×*) I + (I v) ×̄* − I (v ×)]
/// ```
///
/// where (f ×̄*) w = w ×* f. C is that of
/// [`coriolis_matrix`](crate::algorithms::coriolis_matrix()), which states its laws: Ṁ = C + Cᵀ for
/// joints of every kind, and C(q, x) y = C(q, y) x where q̇ is the derivative of q. Both make it
/// the C of a passive law: see `motion_control::law::passivity_based_torque`. On a base of given
/// motion both velocities include that motion.
///
/// A non-finite input gives a non-finite output, which the safety gate of `motion-control` rejects.
///
/// # Shape
/// V.
///
/// # Cost
/// O(B): some 350 flops for each revolute joint, less what no effect needs.
///
/// # Source
/// De Luca & Ferrajoli (2009); Echeandia & Wensing (2021).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{rnea, rnea_two_velocities};
/// use dynamics_core::{effects::Coriolis, model::Robot, robots::Ur5e, state::State};
/// let at = |qd| State { qd, ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]) };
/// let (x, y) = ([0.5, -1.0, 2.0, 0.3, 0.0, 1.0], [0.1, 0.4, 0.0, -2.0, 1.0, 0.0]);
/// let cx_y = rnea_two_velocities(&Ur5e::MODEL, &at(x), &y, &(Coriolis,));
/// let cy_x = rnea_two_velocities(&Ur5e::MODEL, &at(y), &x, &(Coriolis,));
/// let sum: [f64; 6] = core::array::from_fn(|i| x[i] + y[i]);
/// let [c_x, c_y, c_sum] = [x, y, sum].map(|qd| rnea(&Ur5e::MODEL, &at(qd), &(Coriolis,)));
/// for i in 0..6 {
///     assert!((cx_y[i] - cy_x[i]).abs() < 1e-14);
///     assert!((2.0 * cx_y[i] - (c_sum[i] - c_x[i] - c_y[i])).abs() < 1e-13); // C(q, q̇) q̇ is quadratic
/// }
/// ```
#[doc(alias = "modified Newton-Euler")]
#[doc(alias = "Christoffel symbols")]
#[doc(alias = "passivity-based control")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn rnea_two_velocities<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    qd_r: &[R; V],
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let (v_0, a_0) = base_motion(effects);
    let mut velocities = per_body(robot, (v_0, v_0));
    let mut accelerations = per_body(robot, a_0);
    let mut poses = per_body(robot, Xform::IDENTITY);
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let x = link.xform(turns);
        let (mut v, mut w) = (Motion::ZERO, Motion::ZERO);
        if const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY } {
            let (v_parent, w_parent) = velocities.parent(&link);
            v = link.plus_motion(x * v_parent, turns, &state.qd);
            w = link.plus_motion(x * w_parent, turns, qd_r);
        }
        let a_parent = x * accelerations.parent(&link);
        let mut a = a_parent;
        if E::ACCELERATIONS {
            a = link.plus_motion(a, turns, &state.qdd);
        }
        let inertia = body_inertia(effects, i, &link);
        if E::VELOCITY_PRODUCTS {
            a = link.plus_subspace_rate(a, turns, &state.qd, v, qd_r);
        }
        let mut f = inertia * a;
        if E::VELOCITY_PRODUCTS {
            f += BodyCoriolis::new(&inertia, v) * w;
        }
        f -= external_force(effects, i, &link, &x, &mut poses, v);
        let mut rotor = R::ZERO;
        if E::GYROSCOPIC_ROTORS {
            let (axis, k, half) = (rotor_force(effects, &link).ang, link.idx_v(), R::from_f64(0.5));
            let mut couple = R::Vec3::ZERO;
            rotor = a_parent.ang.dot(axis);
            if E::ACCELERATIONS {
                couple += axis * entry(&state.qdd, k);
            }
            if E::VELOCITY_PRODUCTS {
                let both = v.ang * entry(qd_r, k) + w.ang * entry(&state.qd, k);
                couple += both.cross(axis) * half;
                rotor -= v.ang.cross(w.ang).dot(axis) * half;
            }
            if let Some(parent) = bodies.get_mut(link.parent) {
                parent.f.ang += x.rot.transpose_mul(couple);
            }
        }
        velocities.push((v, w));
        accelerations.push(a);
        let _ = bodies.push(Body { rot: x.rot, f, rotor });
    }

    let mut tau = [R::ZERO; V];
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        let Some(link) = robot.link(inner.len()) else {
            break;
        };
        link.project(turns, body.f, &mut tau);
        joint_torques(effects, &link, state, &mut tau);
        if E::GYROSCOPIC_ROTORS
            && let Some(tau) = tau.get_mut(link.idx_v())
        {
            *tau += body.rotor;
        }
        load_frictions(effects, &link, state, &mut tau);
        if let Some(parent) = inner.get_mut(link.parent) {
            let (rot, pos) = (body.rot, link.origin(turns));
            parent.f += Xform { rot, pos }.transpose_mul(body.f);
        }
    }
    tau
}
