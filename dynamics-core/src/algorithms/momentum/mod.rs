//! Centre of mass and momentum of all bodies together, and the generalised momentum of the joints.
//!
//! Featherstone, RBDA (2008), (2.60); Orin, Goswami & Lee, "Centroidal dynamics of a humanoid
//! robot" (2013).

mod base_velocity;
mod centroidal;
mod coriolis;
mod drift;

pub use base_velocity::base_velocity_from_momentum;
pub use centroidal::{centroidal_matrix, centroidal_momentum};
pub use coriolis::{MomentumAndCoriolis, momentum_and_coriolis};
pub use drift::{MomentumAndDrift, momentum_and_drift};

use core::borrow::Borrow;

use heapless::Vec;

use crate::algorithms::kinematics::frame::Pose;
use crate::algorithms::tree_pass::{inward, per_body};
use crate::effects::{Declared, Effect, base_given, body_inertia, rotor_force};
use crate::model::RobotModel;
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Xform};
use crate::state::{Configuration, JointTrig, RobotState, entry};

/// Mass, centre of mass and its velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CenterOfMass<R: Real> {
    /// The mass of all bodies, kg.
    pub mass: R,
    /// Their centre of mass in base coordinates, m; the base's origin if there is no mass.
    pub position: R::Vec3,
    /// Its velocity in base coordinates, m/s.
    pub velocity: R::Vec3,
}

/// Σ m and Σ m c in base coordinates. Some 110 flops a revolute joint.
#[cfg_attr(optimised, inline(always))]
pub(in crate::algorithms) fn mass_and_first_moment<
    R: Real,
    D,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    effects: &E,
) -> (R, R::Vec3)
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let (mut mass, mut moment) = (R::ZERO, R::Vec3::ZERO);
    let mut at = per_body(robot, Pose::IDENTITY);
    for (i, link) in robot.links().enumerate() {
        let here = at.parent(&link);
        let here = here.transformed_by(&link.xform(&trig.coordinates));
        let inertia = body_inertia(effects, i, &link);
        mass += inertia.mass;
        moment += here.pos * inertia.mass + here.rot * inertia.first_moment;
        at.push(here);
    }
    (mass, moment)
}

/// 1/m; zero if there is no mass.
#[cfg_attr(optimised, inline(always))]
pub(in crate::algorithms) fn reciprocal<R: Real>(mass: R) -> R {
    if mass > R::ZERO { R::ONE / mass } else { R::ZERO }
}

/// The centre of mass of all bodies and a payload, m, its velocity, m/s, and their mass, kg.
///
/// Along the base's axes. On a base of given motion the velocity includes that motion.
///
/// ```text
/// m = Σ_i m_i      c = (1/m) Σ_i m_i c_i      ċ = (1/m) Σ_i m_i ċ_i
/// ```
///
/// # Cost
/// O(B): some 250 flops for each revolute joint.
///
/// # Source
/// Orin, Goswami & Lee (2013), section 2.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::center_of_mass, model::Robot, robots::Ur5e, state::State};
/// let arm = center_of_mass(&Ur5e::MODEL, &State::at([0.0_f64, -1.57, 0.0, 0.0, 0.0, 0.0]), &());
/// assert!(arm.mass > 16.0 && arm.position.z > 0.3);
/// ```
#[doc(alias = "mass_centre")]
#[doc(alias = "CoM")]
#[doc(alias = "COM")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn center_of_mass<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> CenterOfMass<R>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let (mass, moment) = mass_and_first_moment(robot, trig, effects);
    let mass_inv = reciprocal(mass);
    CenterOfMass {
        mass,
        position: moment * mass_inv,
        velocity: momentum(robot, trig.with(state), effects).lin * mass_inv,
    }
}

/// The momentum of all bodies together, about the base's origin and along its axes, N·m·s and N·s.
///
/// Rotors behind gears are part of it if the scene has them as
/// [`crate::effects::GyroscopicRotors`]; what [`crate::effects::Armature`] adds to the diagonal of
/// M is not.
///
/// ```text
/// h = Σ_i ⁱX₀ᵀ I_i v_i
/// ```
///
/// # Shape
/// 6.
///
/// # Cost
/// O(B): some 150 flops for each revolute joint.
///
/// # Source
/// RBDA (2008), (2.60).
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::{center_of_mass, momentum}, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [1.0; 6], ..State::at([0.3_f64; 6]) };
/// let (h, c) = (momentum(&Ur5e::MODEL, &state, &()), center_of_mass(&Ur5e::MODEL, &state, &()));
/// assert!((h.lin - c.velocity * c.mass).length() < 1e-12);
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn momentum<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> Force<R>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let mut v = per_body(robot, base_given(effects).0);
    let mut bodies: Vec<(Xform<R>, usize, Force<R>), B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let x = link.xform(turns);
        let v_i = link.plus_motion(x * v.parent(&link), turns, &state.qd);
        let mut h_i = body_inertia(effects, i, &link) * v_i;
        if E::GYROSCOPIC_ROTORS {
            h_i += rotor_force(effects, &link) * entry(&state.qd, link.idx_v());
        }
        let _ = bodies.push((x, link.parent, h_i));
        v.push(v_i);
    }
    let mut total = Force::ZERO;
    let mut pass = inward(&mut bodies);
    while let Some((&mut (x, parent, h), inner)) = pass.next() {
        let h = x.transpose_mul(h);
        match inner.get_mut(parent) {
            Some(parent) => parent.2 += h,
            None => total += h,
        }
    }
    total
}
