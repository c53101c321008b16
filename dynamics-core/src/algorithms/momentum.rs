//! Mass centre and momentum of all bodies together.
//!
//! Featherstone, RBDA (2008), (2.60); Orin, Goswami & Lee, "Centroidal dynamics of a humanoid robot"
//! (2013).

use heapless::Vec;

use super::frame::Pose;
use super::handed::Handed;
use crate::effects::{Effect, base_given, body_inertia, rotor_force};
use crate::model::Description;
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Xform};
use crate::state::{Posture, State, entry};

/// Mass, centre of mass and its velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassCentre<R: Real> {
    /// The mass of all bodies, kg.
    pub mass: R,
    /// Their centre of mass in base coordinates, m; the base's origin if there is no mass.
    pub position: R::Vec3,
    /// Its velocity in base coordinates, m/s.
    pub velocity: R::Vec3,
}

/// Σ m and Σ m c in base coordinates. Some 110 flops a revolute joint.
#[inline(always)]
pub(super) fn mass_and_moment<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &Posture<R, Q>,
    effects: &E,
) -> (R, R::Vec3)
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let (mut mass, mut moment) = (R::ZERO, R::Vec3::ZERO);
    let mut at = Handed::<_, B>::from(Pose::IDENTITY);
    for (i, node) in robot.nodes().enumerate() {
        let here = at.by(D::CHAIN, node.parent);
        let here = here.beyond(&node.xform(&posture.turns));
        let inertia = body_inertia(effects, i, &node);
        mass += inertia.mass;
        moment += here.pos * inertia.mass + here.rot * inertia.moment;
        at.push(D::CHAIN, here);
    }
    (mass, moment)
}

/// 1/m; zero if there is no mass.
#[inline(always)]
pub(super) fn per<R: Real>(mass: R) -> R {
    if mass > R::ZERO {
        R::ONE / mass
    } else {
        R::ZERO
    }
}

/// The centre of mass of all bodies (and a payload), its velocity, and their mass.
///
/// Base coordinates; m, m/s, kg. On a base of given motion the velocity has a part of it. Cost: O(B);
/// some 250 flops a revolute joint. Errors: none. Source: Orin, Goswami & Lee (2013), section 2.
///
/// ```
/// use dynamics_core::{algorithms::mass_centre, model::Robot, robots::Ur5e, state::State};
/// let arm = mass_centre(&Ur5e::MODEL, &State::at([0.0_f64, -1.57, 0.0, 0.0, 0.0, 0.0]), &());
/// assert!(arm.mass > 16.0 && arm.position.z > 0.3);
/// ```
#[inline(always)]
pub fn mass_centre<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    effects: &E,
) -> MassCentre<R>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    mass_centre_at(robot, &Posture::of(robot, &state.q), state, effects)
}

/// As [`mass_centre`], at a posture whose sines and cosines are at hand; `state.q` is not read.
#[inline(always)]
pub fn mass_centre_at<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &Posture<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
) -> MassCentre<R>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let (mass, moment) = mass_and_moment(robot, posture, effects);
    let per_mass = per(mass);
    MassCentre {
        mass,
        position: moment * per_mass,
        velocity: momentum_at(robot, posture, state, effects).lin * per_mass,
    }
}

/// The momentum of all bodies together: about the base's origin and along its axes, N·m·s and N·s.
///
/// Rotors behind gears are in it if the effects name them as bodies that spin, [`crate::effects::Rotors`]; what
/// [`crate::effects::RotorInertia`] adds to the diagonal of M is not. Cost: O(B); some 150 flops a revolute joint. Errors: none. Source:
/// RBDA (2008), (2.60).
///
/// ```
/// use dynamics_core::{algorithms::{mass_centre, momentum}, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [1.0; 6], ..State::at([0.3_f64; 6]) };
/// let (h, c) = (momentum(&Ur5e::MODEL, &state, &()), mass_centre(&Ur5e::MODEL, &state, &()));
/// assert!((h.lin - c.velocity * c.mass).length() < 1e-12);
/// ```
#[inline(always)]
pub fn momentum<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    effects: &E,
) -> Force<R>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    momentum_at(robot, &Posture::of(robot, &state.q), state, effects)
}

/// As [`momentum`], at a posture whose sines and cosines are at hand; `state.q` is not read.
#[inline(always)]
pub fn momentum_at<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &Posture<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
) -> Force<R>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &posture.turns;
    let mut v = Handed::<_, B>::from(base_given(effects).0);
    let mut bodies: Vec<(Xform<R>, usize, Force<R>), B> = Vec::new();
    for (i, node) in robot.nodes().enumerate() {
        let x = node.xform(turns);
        let v_i = node.plus_motion(x * v.by(D::CHAIN, node.parent), turns, &state.qd);
        let mut h_i = body_inertia(effects, i, &node) * v_i;
        if E::SPINNING {
            h_i += rotor_force(effects, &node) * entry(&state.qd, node.velocity_at());
        }
        let _ = bodies.push((x, node.parent, h_i));
        v.push(D::CHAIN, v_i);
    }
    let mut total = Force::ZERO;
    let mut inner = bodies.as_mut_slice();
    while let Some((&mut (x, parent, h), rest)) = core::mem::take(&mut inner).split_last_mut() {
        let h = x.transpose_mul(h);
        match rest.get_mut(parent) {
            Some(carrier) => carrier.2 += h,
            None => total += h,
        }
        inner = rest;
    }
    total
}
