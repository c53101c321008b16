//! The torques behind the gears, from those of the motors: the inverse of friction in proportion to
//! the load.

use crate::effects::{Effect, all_transmitted, joint_state, load_friction};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::State;

/// The torques that the gears transmit while their motors supply `tau`, N·m or N.
///
/// The part of `tau` that is left for all other effects at the joint, after friction in proportion
/// to the transmitted torque ([`LoadFriction`](crate::effects::LoadFriction)): τ of x = τ + a |τ| +
/// b τ, in closed form. In a scene without such friction it is `tau` itself. An observer of
/// external torques takes it as the torque of the drives, since a contact loads the gear as gravity
/// does, and the friction then includes what the contact adds to it:
///
/// ```
/// use dynamics_core::algorithms::{rnea, transmitted_torque};
/// use dynamics_core::effects::{Gravity, LoadFriction, Width};
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// let gears = LoadFriction { driving: [0.25_f64; 6], backdriving: [0.2; 6], width: Width::new(0.01) };
/// let state = State { qd: [0.5; 6], ..State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]) };
/// let (load, tau) = (
///     rnea(&Ur5e::MODEL, &state, &Gravity::EARTH),
///     rnea(&Ur5e::MODEL, &state, &(Gravity::EARTH, gears)),
/// );
/// let found = transmitted_torque(&Ur5e::MODEL, &state, &tau, &gears);
/// assert!(found.iter().zip(load).all(|(found, load)| (found - load).abs() < 1e-14));
/// ```
///
/// Not finite where the load drives a gear that it cannot turn (a back-driving friction μ₂ of 1 or
/// more).
///
/// # Cost
/// Some 16 flops and a division a joint in a scene with such friction; else none.
///
/// # Source
/// Duclusaud, Passault, Padois & Ly, "Extended friction models for the physics simulation of servo
/// actuators" (2025).
#[doc(alias = "gear efficiency")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn transmitted_torque<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    all_transmitted(robot, state, effects, tau)
}

/// The torques that the motors must supply, N·m or N, where that of all else at their joints is
/// `tau`: with the effects at joints, friction, and the gears' in proportion to the load.
///
/// One pass of inverse dynamics then gives the torque of gravity and that of friction:
///
/// ```
/// use dynamics_core::algorithms::{motor_torque, rnea};
/// use dynamics_core::effects::{Gravity, LoadFriction, Viscous, Width};
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// let gears = LoadFriction { driving: [0.25_f64; 6], backdriving: [0.2; 6], width: Width::new(0.01) };
/// let friction = (Viscous([2.0; 6]), gears);
/// let state = State { qd: [0.5; 6], ..State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]) };
/// let gravity = rnea(&Ur5e::MODEL, &state, &Gravity::EARTH);
/// let whole = rnea(&Ur5e::MODEL, &state, &(Gravity::EARTH, friction.0, friction.1));
/// assert_eq!(motor_torque(&Ur5e::MODEL, &state, &gravity, &friction), whole);
/// ```
///
/// Effects on bodies and inertias at joints belong to `tau`: here they count for nothing.
///
/// # Cost
/// That of the effects: some 14 flops a joint with friction in proportion to the load.
#[doc(alias = "friction torque")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn motor_torque<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let mut motors = *tau;
    for link in robot.links() {
        for k in link.coordinates() {
            if let Some(tau) = motors.get_mut(k) {
                let at = joint_state(&link, state, k);
                effects.torque(k, at, tau);
                load_friction(effects, k, at, tau);
            }
        }
    }
    motors
}
