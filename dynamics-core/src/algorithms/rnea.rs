//! Inverse dynamics: the recursive Newton-Euler algorithm in link coordinates.
//!
//! Featherstone & Orin (2000), equations (3) to (8); RBDA (2008), table 5.1:
//!
//! ```text
//! v_i = ⁱX_λ(i) v_λ(i) + S_i q̇_i                                   (3)
//! a_i = ⁱX_λ(i) a_λ(i) + S_i q̈_i + S̊_i q̇_i + v_i × S_i q̇_i         (4)
//! f_i = I_i a_i + v_i ×* I_i v_i − fˣ_i + Σ_{λ(j)=i} ʲX_iᵀ f_j     (5), (6), (7)
//! τ_i = S_iᵀ f_i                                                   (8)
//! ```
//!
//! Bias, gravity torque and full torque are computed by the same function with different effects.

use heapless::Vec;

use super::rotors::rotor;
use super::tree_pass::{PerBody, Topology, inward, per_body};
use crate::effects::{
    Declared, Effect, base_motion, body_inertia, body_wrench, joint_torques, load_frictions,
};
use crate::model::{JointCoordinate, LinkView, RobotModel};
use crate::scalar::{Matrix, Real};
use crate::spatial::{Force, Motion, Xform};
use crate::state::{JointTrig, State};

/// The results of the outward pass for the inward one.
struct Body<R: Real> {
    x: Xform<R>,
    f: Force<R>,
    rotor_tau: R,
}

/// τ by the two passes, each fᵢ of which `transmitted` sees.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rnea<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    mut transmitted: impl FnMut(usize, Force<R>),
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let (v_0, a_0) = base_motion(effects);
    let (mut v, mut a) = (per_body(robot, v_0), per_body(robot, a_0));
    let mut poses = per_body(robot, Xform::IDENTITY);
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let x = link.xform(turns);
        let v_i = velocity(effects, &link, x * v.parent(&link), turns, state); // (3)
        let a_parent = x * a.parent(&link);
        let a_i = acceleration(effects, &link, a_parent, v_i, turns, state); // (4)
        let mut f = net_force(effects, i, &link, a_i, v_i); // (5)
        f -= external_force(effects, i, &link, &x, &mut poses, v_i); // (6)
        let mut rotor_tau = R::ZERO;
        if E::GYROSCOPIC_ROTORS {
            let (couple, tau) = rotor(effects, &link, a_parent, v_i, state);
            if let Some(parent) = bodies.get_mut(link.parent) {
                parent.f.ang += x.rot.transpose_mul(couple);
            }
            rotor_tau = tau;
        }
        v.push(v_i);
        a.push(a_i);
        let _ = bodies.push(Body { x, f, rotor_tau });
    }

    let mut tau = [R::ZERO; V];
    let mut bodies = inward(&mut bodies);
    while let Some((body, inner)) = bodies.next() {
        let Some(link) = robot.link(inner.len()) else {
            break;
        };
        transmitted(inner.len(), body.f);
        link.project(turns, body.f, &mut tau); // (8)
        joint_torques(effects, &link, state, &mut tau);
        if E::GYROSCOPIC_ROTORS
            && let Some(tau) = tau.get_mut(link.idx_v())
        {
            *tau += body.rotor_tau;
        }
        load_frictions(effects, &link, state, &mut tau);
        if let Some(parent) = inner.get_mut(link.parent) {
            parent.f += body.x.transpose_mul(body.f); // (7)
        }
    }
    tau
}

/// vᵢ from X v_λ; zero if no effect needs velocities. Featherstone & Orin (3).
#[cfg_attr(optimised, inline(always))]
pub(super) fn velocity<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    _: &E,
    link: &LinkView<'_, R>,
    v: Motion<R>,
    turns: &[JointCoordinate<R>],
    state: &State<R, Q, V>,
) -> Motion<R>
where
    E: Effect<R, B, V>,
{
    if const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY } {
        link.plus_motion(v, turns, &state.qd)
    } else {
        Motion::ZERO
    }
}

/// aᵢ from X a_parent: S q̈ with [`crate::effects::Inertia`], S̊ q̇ + v × S q̇ with
/// [`crate::effects::Coriolis`]. Featherstone & Orin (4).
#[cfg_attr(optimised, inline(always))]
pub(super) fn acceleration<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    _: &E,
    link: &LinkView<'_, R>,
    mut a: Motion<R>,
    v_i: Motion<R>,
    turns: &[JointCoordinate<R>],
    state: &State<R, Q, V>,
) -> Motion<R>
where
    E: Effect<R, B, V>,
{
    if E::ACCELERATIONS {
        a = link.plus_motion(a, turns, &state.qdd);
    }
    if E::VELOCITY_PRODUCTS {
        a = link.plus_velocity_product(a, turns, &state.qd, v_i);
    }
    a
}

/// Iᵢ aᵢ + vᵢ ×* Iᵢ vᵢ, as far as the effects need it. Featherstone & Orin (5).
#[cfg_attr(optimised, inline(always))]
fn net_force<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    i: usize,
    link: &LinkView<'_, R>,
    a_i: Motion<R>,
    v_i: Motion<R>,
) -> Force<R>
where
    E: Effect<R, B, V>,
{
    if !const { E::FIELD | E::BASE_MOTION | E::ACCELERATIONS | E::VELOCITY_PRODUCTS } {
        return Force::ZERO;
    }
    let inertia = body_inertia(effects, i, link);
    if E::VELOCITY_PRODUCTS { inertia.force(a_i, v_i) } else { inertia * a_i }
}

/// fˣ, the wrench of the environment on body `i`; zero if no effect has one. Featherstone & Orin
/// (6).
#[cfg_attr(optimised, inline(always))]
pub(crate) fn external_force<R: Real, E, T: Topology, const B: usize, const V: usize>(
    effects: &E,
    i: usize,
    link: &LinkView<'_, R>,
    x: &Xform<R>,
    poses: &mut PerBody<Xform<R>, T, B>,
    v_i: Motion<R>,
) -> Force<R>
where
    E: Effect<R, B, V>,
{
    if !E::WRENCH {
        return Force::ZERO;
    }
    let mut pose = Xform::IDENTITY;
    if E::BODY_POSE {
        pose = *x * poses.parent(link);
        poses.push(pose);
    }
    body_wrench(effects, i, link, &pose, v_i)
}
