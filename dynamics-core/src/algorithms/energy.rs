//! Kinetic and potential energy.
//!
//! Featherstone, RBDA (2008), (2.67): T = Σ ½ v·I v; U = −Σ m g·c in a uniform field g.

use core::borrow::Borrow;

use super::momentum::mass_and_first_moment;
use super::tree_pass::per_body;
use crate::effects::{Declared, Effect, add_inertia, base_given, body_inertia, field, rotor_force};
use crate::model::RobotModel;
use crate::scalar::{Real, Vector};
use crate::state::{Configuration, RobotState, entry};

/// The kinetic energy T, J.
///
/// ```text
/// T = ½ Σ_i v_iᵀ I_i v_i
/// ```
///
/// It includes the bodies, a payload of the scene, and rotors by their inertia at the joints: on a
/// base at rest it is ½ q̇ᵀ M q̇, with M under the same effects. On a base with a given motion it
/// is that of the moving bodies.
///
/// # Cost
/// O(B): some 115 flops for each revolute joint.
///
/// # Source
/// RBDA (2008), (2.67).
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::kinetic_energy, model::Robot, robots::Ur5e, state::State};
/// let turning = State { qd: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
/// let twice = State { qd: turning.qd.map(|qd| 2.0 * qd), ..turning };
/// let energy = |state| kinetic_energy(&Ur5e::MODEL, state, &());
/// assert_eq!(energy(&twice), 4.0 * energy(&turning));
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn kinetic_energy<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> R
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let mut twice = R::ZERO;
    let mut v = per_body(robot, base_given(effects).0);
    for (i, link) in robot.links().enumerate() {
        let v_i = link.xform(turns) * v.parent(&link);
        if E::GYROSCOPIC_ROTORS {
            // I (ω_z + ρ q̇)² − I ω_z², less the square of ρ q̇, which `inertia` has.
            let rotor = rotor_force(effects, &link) * entry(&state.qd, link.idx_v());
            twice += v_i.dot(rotor + rotor);
        }
        let v_i = link.plus_motion(v_i, turns, &state.qd);
        twice += v_i.dot(body_inertia(effects, i, &link) * v_i);
        for k in link.coordinates() {
            let (mut rotor, qd) = (R::ZERO, entry(&state.qd, k));
            add_inertia(effects, k, &mut rotor);
            twice += rotor * qd * qd;
        }
        v.push(v_i);
    }
    twice * R::from_f64(0.5)
}

/// The potential energy U in the field of the effects, J; zero at the height of the base's origin.
///
/// ```text
/// U = −Σ_i m_i gᵀ c_i
/// ```
///
/// It includes the bodies and a payload, but not springs at the joints.
///
/// # Cost
/// O(B): some 110 flops for each revolute joint.
///
/// # Source
/// RBDA (2008), section 5.3, for a uniform field.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::potential_energy, effects::Gravity, model::Robot, robots::Ur5e};
/// let energy = |lift| potential_energy(&Ur5e::MODEL, &[0.0, lift, 0.0, 0.0, 0.0, 0.0], &Gravity::EARTH);
/// assert!(energy(-1.57_f64) > energy(0.0) + 50.0); // upright
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn potential_energy<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    effects: &E,
) -> R
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    -field(effects).dot(mass_and_first_moment(robot, trig, effects).1)
}
