//! Advice on a scene: friction that drives, inertia and masses below zero, gears without rotors.

use dynamics_core::advice::AdvisedJoint;
use dynamics_core::effects::{Declared, Effect, JointState, load_friction, payload_mass};
use dynamics_core::model::Model;
use dynamics_core::scalar::Real;

use super::NumberAdvice;

/// Speeds at which friction is asked, rad/s or m/s: beyond and within the width of a smooth sign.
const SPEEDS: [f64; 4] = [1.0, 10.0, 0.05, 1e-3];
/// A torque that a gear transmits, N·m or N.
const LOAD: f64 = 1.0;

/// Advice on a scene of a robot.
pub(super) fn of<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    scene: &E,
) -> impl Iterator<Item = NumberAdvice>
where
    E: Effect<R, B, V>,
{
    let names = model.coordinate_names();
    let joint = move |number: usize| AdvisedJoint { number, body: names.get(number).copied() };
    let of_joints = (0..V).flat_map(move |k| of_joint(scene, joint(k)));
    let of_bodies = model.links.iter().enumerate().filter_map(|(i, link)| {
        let mass = payload_mass(scene, i).to_f64();
        (mass < 0.0).then_some(NumberAdvice::NegativePayload { body: link.name, mass })
    });
    of_joints.chain(of_bodies)
}

/// Advice on a scene at one joint.
fn of_joint<R: Real, E, const B: usize, const V: usize>(
    scene: &E,
    joint: AdvisedJoint,
) -> impl Iterator<Item = NumberAdvice>
where
    E: Effect<R, B, V>,
{
    let inertia = scene.inertia(joint.number).map(R::to_f64);
    let negative = inertia
        .filter(|inertia| *inertia < 0.0)
        .map(|inertia| NumberAdvice::NegativeArmature { joint, inertia });
    let missing = E::LOAD_DEPENDENT && inertia.unwrap_or_default() == 0.0;
    let missing = missing.then_some(NumberAdvice::NoRotorInertia { joint });
    let driving = SPEEDS.into_iter().flat_map(|speed| [speed, -speed]);
    let driving = driving.filter_map(|speed| {
        let torque = friction::<R, E, B, V>(scene, joint.number, speed)?;
        let drives = torque * speed < 0.0;
        drives.then_some(NumberAdvice::DrivingFriction { joint, speed, torque })
    });
    let first = driving.into_iter().next();
    [first, negative, missing].into_iter().flatten()
}

/// The torque that a scene adds at a joint for a speed, N·m or N, where that is more than rounding:
/// of the torques without load, and of a gear that transmits one.
fn friction<R: Real, E, const B: usize, const V: usize>(
    scene: &E,
    joint: usize,
    speed: f64,
) -> Option<f64>
where
    E: Effect<R, B, V>,
{
    let torque = |speed: f64| {
        let mut tau = R::ZERO;
        let at = JointState::new(R::ZERO, R::from_f64(speed));
        scene.torque(joint, at, &mut tau);
        tau.to_f64()
    };
    let gear = |load: f64| {
        let mut tau = R::from_f64(load);
        let at = JointState::new(R::ZERO, R::from_f64(speed));
        load_friction(scene, joint, at, &mut tau);
        tau.to_f64() - load
    };
    let rest = torque(0.0);
    let rounding = 4.0 * R::EPSILON.to_f64();
    let shares = [(torque(speed) - rest, rest.abs()), (gear(LOAD), LOAD), (gear(-LOAD), LOAD)];
    let mut stated = shares.into_iter().filter(|(torque, of)| torque.abs() > rounding * of);
    stated
        .clone()
        .find(|(torque, _)| torque * speed < 0.0)
        .or_else(|| stated.next())
        .map(|(torque, _)| torque)
}
