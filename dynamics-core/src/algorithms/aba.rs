//! Forward dynamics: the articulated-body algorithm in link coordinates.
//!
//! Featherstone, RBDA (2008), table 7.1; Featherstone & Orin (2000), section 3.2:
//!
//! ```text
//! c_i  = S̊_i q̇_i + v_i × S_i q̇_i
//! Iᴬ_i = I_i + Σ_{λ(j)=i} ʲX_iᵀ Iᵃ_j ʲX_i    pᴬ_i = v_i ×* I_i v_i − fˣ_i + Σ_{λ(j)=i} ʲX_iᵀ pᵃ_j
//! U_i  = Iᴬ_i S_i      D_i = S_iᵀ U_i        u_i  = τ_i − S_iᵀ pᴬ_i
//! Iᵃ_i = Iᴬ_i − U_i D_i⁻¹ U_iᵀ               pᵃ_i = pᴬ_i + Iᵃ_i c_i + U_i D_i⁻¹ u_i
//! a′_i = ⁱX_λ(i) a_λ(i) + c_i
//! q̈_i  = D_i⁻¹ (u_i − U_iᵀ a′_i)             a_i  = a′_i + S_i q̈_i
//! ```
//!
//! A joint of several degrees of freedom is eliminated a coordinate at a time, which is the same as
//! by its block D. Nothing is eliminated where [`hybrid_dynamics`](super::hybrid_dynamics()) prescribes a
//! coordinate's motion, RBDA section 9.2. A revolute joint without inertia of its own leaves zeros
//! in row and column z of Iᵃ; of robots with a free joint they are left out.

use heapless::Vec;

use super::pivot_check::{Magnitude, PivotCheck};
use super::prescribed::{JointFactor, prescribed_factor, prescribed_torque};
use super::rnea::external_force;
use super::rotors::with_rotor;
use super::tree_pass::{Passed, per_body};
use super::{JointResult, NotPositiveDefinite, Prescribed};
use crate::effects::{
    Declared, Effect, add_inertia, base_motion, body_inertia, gyroscopic, joint_state,
    joint_torque, transmitted,
};
use crate::model::{JointKind, LinkView, RobotModel};
use crate::scalar::{Matrix, Real};
use crate::spatial::inertia::ArticulatedInertia;
use crate::spatial::{Force, Motion, MotionSubspace, Xform};
use crate::state::{JointTrig, State, entry};

/// The data of a body that the outward passes and the inward pass share.
struct Body<R: Real> {
    x: Xform<R>,
    c: Motion<R>,
    ia: ArticulatedInertia<R>,
    magnitude: Magnitude<R>,
    pa: Force<R>,
}

/// q̈ and τ by the three passes of table 7.1; each coordinate's torque or its acceleration is
/// `given`.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn aba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: impl Fn(usize) -> Prescribed<R>,
) -> Result<JointResult<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let (v_0, a_0) = base_motion(effects);
    let mut bodies = Vec::new();
    outward_velocities(robot, trig, state, effects, v_0, &mut bodies);
    let mut factors = Vec::new();
    inward_inertias(robot, &mut bodies, trig, state, effects, &given, &mut factors)?;
    Ok(outward_accelerations(robot, &bodies, trig, state, effects, &given, a_0, &mut factors))
}

/// Pass 1: vᵢ, cᵢ = v × S q̇ + S̊ q̇, and, of each body alone, Iᴬ = I and pᴬ = v ×* I v − fˣ.
#[cfg_attr(optimised, inline(always))]
fn outward_velocities<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    v_0: Motion<R>,
    bodies: &mut Vec<Body<R>, B>,
) where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    // Not in one pattern, which costs the A1 1.5 % of its cycles.
    let mut v = per_body(robot, v_0);
    let mut poses = per_body(robot, Xform::IDENTITY);
    for i in 0..B {
        let Some(link) = robot.link(i) else {
            break;
        };
        let x = link.xform(turns);
        let v_i = link.plus_motion(x * v.parent(&link), turns, &state.qd);
        let inertia = body_inertia(effects, i, &link);
        let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
        if E::VELOCITY_PRODUCTS {
            c = link.plus_velocity_product(Motion::ZERO, turns, &state.qd, v_i);
            pa = inertia.bias_force(v_i);
        }
        if E::WRENCH {
            pa -= external_force(effects, i, &link, &x, &mut poses, v_i);
        }
        if E::GYROSCOPIC_ROTORS
            && E::VELOCITY_PRODUCTS
            && let Some(parent) = bodies.get_mut(link.parent)
        {
            let rate = entry(&state.qd, link.idx_v());
            let couple = gyroscopic(effects, &link, v_i.ang, rate, R::ZERO);
            parent.pa.ang += x.rot.transpose_mul(couple);
        }
        v.push(v_i);
        let (ia, magnitude) = (inertia.into(), Magnitude::from(&inertia));
        let _ = bodies.push(Body { x, c, ia, magnitude, pa });
    }
}

/// Pass 2: Iᴬ and pᴬ of every articulated body, and U, D and u of every coordinate.
#[cfg_attr(optimised, inline(always))]
fn inward_inertias<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    bodies: &mut [Body<R>],
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: &impl Fn(usize) -> Prescribed<R>,
    factors: &mut Vec<JointFactor<R>, V>,
) -> Result<(), NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    // Robots on a fixed base keep the bits of the rule that has no exception.
    let floating = D::KINDS.has(JointKind::Free) && robot.model().kinds().has(JointKind::Free);
    // Not by `inward`, which costs 1.5 % of the UR5e's cycles here.
    let (mut inertias, mut magnitudes, mut forces) = (Passed::NONE, Passed::NONE, Passed::NONE);
    let mut left = bodies;
    while let Some((body, inner)) = core::mem::take(&mut left).split_last_mut() {
        let Some(link) = robot.link(inner.len()) else {
            break;
        };
        let (mut ia, mut pa) = (*inertias.onto(&body.ia), *forces.onto(&body.pa));
        let magnitude = magnitudes.onto(&body.magnitude);
        // What remains of Iᴬ when a joint turns freely about z.
        let mut about_z = None;
        if link.has_several() {
            let mut pivots = PivotCheck::of(*magnitude);
            for (k, joint) in link.coordinates().enumerate().rev() {
                let (at, of) = ((&link, k, joint), (&ia, &mut pa, &mut pivots));
                let factor = factor(at, trig, state, effects, given(joint), of)?;
                if matches!(given(joint), Prescribed::Torque(_)) {
                    ia = ia.minus_outer(factor.u_a, factor.d_inv);
                }
                let _ = factors.push(factor);
            }
        } else if let Some(joint) = link.coordinates().next() {
            let (at, mut pivots) = ((&link, 0, joint), PivotCheck::of(*magnitude));
            let of = (&ia, &mut pa, &mut pivots);
            let factor = factor(at, trig, state, effects, given(joint), of)?;
            if matches!(given(joint), Prescribed::Torque(_)) {
                let s = link.unit_subspace(&trig.coordinates, 0);
                let alone = matches!(s, MotionSubspace::RevoluteZ);
                if floating && alone && effects.inertia(joint).is_none() {
                    about_z = Some(ia.free_about_z(factor.u_a, factor.d_inv));
                } else {
                    ia = ia.minus_outer(factor.u_a, factor.d_inv);
                }
            }
            let _ = factors.push(factor);
        }
        if let (i, Some(parent)) = (inner.len(), inner.get_mut(link.parent)) {
            // Iᵃ c after the update of Iᴬ: pᵃ = pᴬ + Iᵃ c + U D⁻¹ u.
            let (ia_c, ia) = match about_z {
                Some(ia) => (ia.times_across(body.c), ia.at_parent(&body.x)),
                None => (ia.times(body.c), ia.at_parent(&body.x)),
            };
            pa += ia_c;
            inertias.add(&link, i, &mut parent.ia, ia);
            let of_parent = &mut parent.magnitude;
            magnitudes.add(&link, i, of_parent, magnitude.at_parent(body.x.pos));
            forces.add(&link, i, &mut parent.pa, body.x.transpose_mul(pa));
        }
        left = inner;
    }
    Ok(())
}

/// U, D and u of a coordinate, and pᴬ + U D⁻¹ u.
#[cfg_attr(optimised, inline(always))]
fn factor<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    (link, k, joint): (&LinkView<'_, R>, usize, usize),
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: Prescribed<R>,
    (ia, pa, pivots): (&ArticulatedInertia<R>, &mut Force<R>, &mut PivotCheck<R>),
) -> Result<JointFactor<R>, NotPositiveDefinite>
where
    E: Effect<R, B, V>,
{
    let s = link.unit_subspace(&trig.coordinates, k);
    let u_a = ia.along(&s);
    let tau = match given {
        Prescribed::Torque(tau) => tau,
        Prescribed::Acceleration(qdd) => {
            return Ok(prescribed_factor(effects, link, s, u_a, qdd, pa));
        }
    };
    let mut d = s.dot(u_a);
    add_inertia(effects, joint, &mut d);
    pivots.check((link, k), &trig.coordinates, (u_a, d), joint)?;
    let d_inv = R::ONE / d;
    let tau = transmitted(effects, joint, joint_state(link, state, joint), tau);
    let u = tau - joint_torque(effects, link, state, joint) - s.dot(*pa);
    let u_a = with_rotor(effects, link, u_a);
    *pa += u_a * (u * d_inv);
    Ok(JointFactor { u_a, d_inv, u })
}

/// Pass 3: q̈ᵢ = D⁻¹ (u − Uᵀ a′) with a′ = X a_λ + c, and aᵢ = a′ + S q̈. The factors are used in
/// reverse order.
#[cfg_attr(optimised, inline(always))]
#[allow(
    clippy::too_many_arguments,
    reason = "what the other two passes have left, and what they had"
)]
fn outward_accelerations<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    bodies: &[Body<R>],
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: &impl Fn(usize) -> Prescribed<R>,
    a_0: Motion<R>,
    factors: &mut Vec<JointFactor<R>, V>,
) -> JointResult<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let mut joints = JointResult::ZERO;
    let mut a = per_body(robot, a_0);
    for (body, link) in bodies.iter().zip(robot.links()) {
        let a_parent = body.x * a.parent(&link) + body.c;
        let mut a_i = a_parent;
        if link.has_several() {
            let free = D::KINDS.has(JointKind::Free) && is_free(&link, effects, given);
            if free {
                a_i = Motion::ZERO;
            }
            for (k, joint) in link.coordinates().enumerate() {
                let Some(factor) = factors.pop() else {
                    break;
                };
                let (tau, qdd) = accelerated(
                    (&link, k, joint),
                    trig,
                    state,
                    effects,
                    given,
                    (&factor, &mut a_i),
                );
                joints.set(joint, tau, qdd);
            }
            if free {
                joints.set_relative(&link, a_i, a_parent);
            }
        } else if let (Some(joint), Some(factor)) = (link.coordinates().next(), factors.last()) {
            let (tau, qdd) =
                accelerated((&link, 0, joint), trig, state, effects, given, (factor, &mut a_i));
            joints.set(joint, tau, qdd);
            let _ = factors.pop();
        }
        a.push(a_i);
    }
    joints
}

/// Torque and acceleration of a coordinate, and a + S q̈.
#[cfg_attr(optimised, inline(always))]
fn accelerated<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    (link, k, joint): (&LinkView<'_, R>, usize, usize),
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: &impl Fn(usize) -> Prescribed<R>,
    (factor, a): (&JointFactor<R>, &mut Motion<R>),
) -> (R, R)
where
    E: Effect<R, B, V>,
{
    let (s, &JointFactor { u_a, d_inv, u }) = (link.unit_subspace(&trig.coordinates, k), factor);
    let (tau, qdd) = match given(joint) {
        Prescribed::Torque(tau) => (tau, (u - a.dot(u_a)) * d_inv),
        Prescribed::Acceleration(qdd) => {
            let load = a.dot(u_a) + s.dot(u_a) * qdd + u;
            (prescribed_torque(effects, link, state, joint, s, load, qdd), qdd)
        }
    };
    *a = s.add_scaled_to(*a, qdd);
    (tau, qdd)
}

/// Whether a body is decoupled from its parent: no constraint, no prescribed motion, no inertia at
/// the joint.
///
/// The body's acceleration is then independent of the parent's; without it free fall is exact.
#[cfg_attr(optimised, inline(always))]
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
            add_inertia(effects, joint, &mut inertia);
            matches!(given(joint), Prescribed::Torque(_)) & (inertia == R::ZERO)
        })
}
