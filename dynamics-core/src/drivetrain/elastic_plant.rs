//! The plant with compliant joints, stable at any stiffness.
//!
//! Springs and motors are integrated by backward Euler. With θ̇ at the end of the step eliminated,
//! the torque of the springs there is
//!
//! ```text
//! τ₊ = ((J + h b) (e − h k q̇₊) + h k (J θ̇ + h τ_m)) / D
//! D  = J + h (b + h k)      e = k (θ − q)
//! ```
//!
//! It is linear in the links' q̇₊ = q̇ + h q̈: a torque, and h² k (J + h b) / D on the diagonal of
//! M, which for k → ∞ becomes the rotor's J + h b.

use super::{ElasticJoints, MotorState};
use crate::algorithms::{NotPositiveDefinite, aba};
use crate::effects::{Armature, Effect, Implicit, joint_state, no_load_friction};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::manifold::integrate;
use crate::state::{State, entry};

/// One step of `h` seconds of links and motors under the motors' torques τ_m, N·m or N.
///
/// The step is of first order in h. The links, on which the effects act, are integrated as by
/// [`linearly_implicit`](crate::sim::linearly_implicit). Stiff springs cause no cancellation: k (θ
/// − q) is multiplied by J/D before it is used. Cost: that of `aba`, and a division and 30 flops
/// per joint.
///
/// ```
/// use dynamics_core::effects::RIGID_BODY;
/// use dynamics_core::drivetrain::{ElasticJoints, MotorState, elastic_step};
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// let joints = ElasticJoints { stiffness: [1e7_f64; 6], rotor: [1.0; 6], friction: [20.0; 6] };
/// let mut arm = State::at([0.0, -1.5, 0.0, 0.0, 0.0, 0.0]);
/// let mut motors = MotorState { position: arm.q, velocity: [0.0; 6] };
/// for _ in 0..1000 {
///     elastic_step(&Ur5e::MODEL, &joints, &mut arm, &mut motors, &[0.0; 6], &mut RIGID_BODY.clone(), 1e-3)?;
/// }
/// assert!((arm.q[1] - motors.position[1]).abs() < 1e-4 && arm.is_finite());
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`aba()`]; the states are then left as they were.
pub fn elastic_step<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    joints: &ElasticJoints<R, V>,
    links: &mut State<R, Q, V>,
    motors: &mut MotorState<R, V>,
    tau: &[R; V],
    effects: &mut E,
    h: R,
) -> Result<(), NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let (mut spring, mut diagonal) = ([R::ZERO; V], [R::ZERO; V]);
    let (mut drive, mut gain) = ([R::ZERO; V], [R::ZERO; V]);
    for link in robot.links() {
        for i in link.coordinates() {
            let of = |values| entry::<R>(values, i);
            let (k, inertia) = (of(&joints.stiffness), of(&joints.rotor));
            let damped = inertia + h * of(&joints.friction);
            let (hk, q) = (h * k, joint_state(&link, links, i));
            let d_inv = R::ONE / (damped + h * hk);
            let e = k * (of(&motors.position) - q.q);
            let free = inertia * of(&motors.velocity) + h * of(tau);
            let put = |to: &mut [R; V], x| {
                if let Some(to) = to.get_mut(i) {
                    *to = x;
                }
            };
            put(&mut spring, (damped * (e - hk * q.qd) + hk * free) * d_inv);
            put(&mut diagonal, h * hk * damped * d_inv);
            // θ̇₊ = (J θ̇ + h τ_m − h e + h² k q̇₊) / D
            put(&mut drive, (free - h * e) * d_inv);
            put(&mut gain, h * hk * d_inv);
        }
    }
    no_load_friction::<R, E, B, V>();
    let implicit = Implicit::new(robot, links, effects, h);
    links.qdd = aba(robot, &*links, &spring, &(implicit, Armature(diagonal)))?;
    for (qd, &qdd) in links.qd.iter_mut().zip(&links.qdd) {
        *qd += h * qdd;
    }
    links.q = integrate(robot, &links.q, &links.qd.map(|qd| h * qd));
    for (i, (angle, rate)) in (motors.position.iter_mut()).zip(&mut motors.velocity).enumerate() {
        *rate = entry(&drive, i) + entry(&gain, i) * entry(&links.qd, i);
        *angle += h * *rate;
    }
    for link in robot.links() {
        for k in link.coordinates() {
            effects.advance(k, joint_state(&link, links, k), h);
        }
    }
    Ok(())
}
