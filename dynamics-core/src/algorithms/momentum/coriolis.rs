//! The generalised momentum M q̇ and the transposed Coriolis product Cᵀ q̇, in one outward and one
//! inward pass.
//!
//! De Luca & Mattone, "Actuator failure detection and isolation using generalized momenta" (2003):
//! the rate of p = M q̇ contains no acceleration. hᶜ_i is the momentum of body i and all its
//! descendants, about the origin of body i. In the body's frame, the force f_i that joint i
//! transmits is its rate ḣᶜ_i + v_i ×* hᶜ_i; with τ_i = S_iᵀ f_i and p_i = S_iᵀ hᶜ_i follows ṗ_i =
//! τ_i + (v_i × S_i + S̊_i)ᵀ hᶜ_i, for joints of every kind.

use core::borrow::Borrow;

use heapless::Vec;

use crate::algorithms::tree_pass::{inward, per_body};
use crate::effects::{Declared, Effect, base_given, body_inertia, rotor_force};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Configuration, RobotState, entry};

/// The generalised momentum and the velocity products in its rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumAndCoriolis<R: Real, const V: usize> {
    /// The generalised momentum p = M q̇, N·m·s at a revolute joint, N·s at a prismatic one.
    pub p: [R; V],
    /// Cᵀ q̇ = Ṁ q̇ − C q̇, N·m or N.
    pub ct_qd: [R; V],
}

/// The results of the outward pass for the inward one.
struct Body<R: Real> {
    rot: R::Mat3,
    v: Motion<R>,
    h: Force<R>,
    /// ρ I z·ω_λ, what the velocity of the parent adds to the momentum of a rotor.
    rotor: R,
}

/// The generalised momentum p = M q̇ and the transposed Coriolis product Cᵀ q̇, in joint
/// coordinates, N·m·s and N·m.
///
/// Together they are the model of an observer that estimates external torques without
/// accelerations:
///
/// ```text
/// ṗ    = τ + Cᵀ q̇ − g(q)
/// p_i  = S_iᵀ hᶜ_i      c_i = (v_i × S_i + S̊_i)ᵀ hᶜ_i
/// hᶜ_i = I_i v_i + Σ_{λ(j)=i} ʲX_iᵀ hᶜ_j
/// ```
///
/// with c = Cᵀ q̇.
///
/// C is any matrix with Ṁ = C + Cᵀ whose product with q̇ is the vector of velocity products, such
/// as that of the Christoffel symbols: Cᵀ q̇ = Ṁ q̇ − C q̇ is the same for all of them. If q̇ is
/// the derivative of q, it is ∂T/∂q, the derivative of the kinetic energy. At spherical, planar and
/// free joints q̇ is the velocity in the body's frame, not a derivative of q, and Cᵀ q̇ is what the
/// first equation states: with it, the equation holds for every joint.
///
/// M is that of [`crba`](crate::algorithms::crba()) under the same effects: payloads are part of
/// both results; an armature, which is constant, only of p. Neither depends on the effects
/// [`Inertia`](crate::effects::Inertia) and [`Coriolis`](crate::effects::Coriolis). On a base of
/// given motion, p = ∂T/∂q̇ includes that motion, and the first equation holds with the torques
/// under the same motion. A non-finite input gives a non-finite output.
///
/// # Shape
/// V and V.
///
/// # Cost
/// O(B): some 160 flops for each revolute joint.
///
/// # Source
/// De Luca & Mattone (2003); Haddadin, De Luca & Albu-Schäffer, "Robot collisions: a survey"
/// (2017), section V.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{MomentumAndCoriolis, kinetic_energy, momentum_and_coriolis, rnea};
/// use dynamics_core::{effects::Coriolis, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [0.5, -1.0, 2.0, 0.3, 0.0, 1.0], ..State::at([0.3_f64; 6]) };
/// let MomentumAndCoriolis { p, ct_qd } = momentum_and_coriolis(&Ur5e::MODEL, &state, &());
/// let power = |x: [f64; 6]| -> f64 { x.iter().zip(state.qd).map(|(x, qd)| x * qd).sum() };
/// assert!((power(p) - 2.0 * kinetic_energy(&Ur5e::MODEL, &state, &())).abs() < 1e-13);
/// let c_qd = rnea(&Ur5e::MODEL, &state, &(Coriolis,));
/// assert!(c_qd[1] != ct_qd[1] && (power(c_qd) - power(ct_qd)).abs() < 1e-13); // both are half of q̇ᵀ Ṁ q̇
/// ```
#[doc(alias = "momentum observer")]
#[doc(alias = "generalized momentum")]
#[doc(alias = "transposed Coriolis matrix")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn momentum_and_coriolis<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> MomentumAndCoriolis<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let mut velocities = per_body(robot, base_given(effects).0);
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let x = link.xform(turns);
        let v_parent = x * velocities.parent(&link);
        let v = link.plus_motion(v_parent, turns, &state.qd);
        let h = body_inertia(effects, i, &link) * v;
        let mut rotor = R::ZERO;
        if E::GYROSCOPIC_ROTORS {
            rotor = v_parent.dot(rotor_force(effects, &link));
        }
        velocities.push(v);
        let _ = bodies.push(Body { rot: x.rot, v, h, rotor });
    }

    let (mut p, mut ct_qd) = ([R::ZERO; V], [R::ZERO; V]);
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        let Some(link) = robot.link(inner.len()) else {
            break;
        };
        let mut h = body.h;
        link.project(turns, h, &mut p);
        link.project_rate(turns, &state.qd, body.v, h, &mut ct_qd);
        for k in link.coordinates() {
            if let Some(p) = p.get_mut(k) {
                if let Some(inertia) = effects.inertia(k) {
                    *p += inertia * entry(&state.qd, k);
                }
                if E::GYROSCOPIC_ROTORS {
                    *p += body.rotor;
                }
            }
        }
        if E::GYROSCOPIC_ROTORS {
            // The parent carries the rotor. (v × S)ᵀ has no component along the rotor's own axis.
            h += rotor_force(effects, &link) * entry(&state.qd, link.idx_v());
        }
        if let Some(parent) = inner.get_mut(link.parent) {
            let (rot, pos) = (body.rot, link.origin(turns));
            parent.h += Xform { rot, pos }.transpose_mul(h);
        }
    }
    MomentumAndCoriolis { p, ct_qd }
}
