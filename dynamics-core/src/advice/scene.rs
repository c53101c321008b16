//! Advice on a scene: friction that drives, inertia and masses below zero, gears without rotors.

use super::{Advice, AdvisedJoint};
use crate::effects::{Declared, Effect, JointState, call_hook, load_friction};
use crate::model::Model;
use crate::scalar::Real;
use crate::spatial::SpatialInertia;

/// Speeds at which friction is asked, rad/s or m/s: beyond and within the width of a smooth sign.
const SPEEDS: [f64; 4] = [1.0, 10.0, 0.05, 1e-3];
/// A torque that a gear transmits, N·m or N.
const LOAD: f64 = 1.0;

impl<R: Real, const B: usize, const Q: usize, const V: usize> Model<R, B, Q, V> {
    /// Advice on a scene that no machine has: a list of words with numbers, empty for most scenes.
    /// Never a refusal.
    ///
    /// | advice | given where |
    /// |---|---|
    /// | [`Advice::DrivingFriction`] | what the scene adds to a joint's torque with its speed, at rest otherwise, drives the joint |
    /// | [`Advice::NegativeArmature`] | the inertia that it adds at a joint is negative |
    /// | [`Advice::NegativePayload`] | a payload has a negative mass |
    /// | [`Advice::NoRotorInertia`] | it has the friction of gears and no inertia at the joint |
    ///
    /// The values of a scene are no part of its type, so that the compiler does not find them.
    /// Effects of your own are asked as those of the library. Not for a tick.
    ///
    /// ```
    /// use dynamics_core::effects::{RIGID_BODY, Viscous};
    /// use dynamics_core::{model::Robot, robots::Ur5e};
    /// assert_eq!(Ur5e::MODEL.advice_on(&(RIGID_BODY, Viscous([0.5; 6]))).count(), 0);
    /// let scene = (RIGID_BODY, Viscous([0.5, 0.5, -0.5, 0.5, 0.5, 0.5]));
    /// let words: Vec<String> = Ur5e::MODEL.advice_on(&scene).map(|advice| advice.to_string()).collect();
    /// assert_eq!(words, [
    ///     "joint 2 (`forearm`): at 1 rad/s or m/s the friction of the scene is -0.50 N·m or N: it drives the joint in place of \
    ///      braking it; no coefficient of friction is negative",
    /// ]);
    /// ```
    pub fn advice_on<E: Effect<R, B, V>>(&self, scene: &E) -> impl Iterator<Item = Advice> {
        let names = self.coordinate_names();
        let joint = move |number: usize| AdvisedJoint { number, body: names.get(number).copied() };
        let of_joints = (0..V).flat_map(move |k| of_joint(scene, joint(k)));
        let of_bodies = self.links.iter().enumerate().filter_map(|(i, link)| {
            let mut load = SpatialInertia::ZERO;
            if const { &E::PAYLOAD }.get(i) == Some(&true) {
                call_hook!(E::ADDED_INERTIA.add, scene, i, &mut load);
            }
            let mass = load.mass.to_f64();
            (mass < 0.0).then_some(Advice::NegativePayload { body: link.name, mass })
        });
        of_joints.chain(of_bodies)
    }
}

/// Advice on a scene at one joint.
fn of_joint<R: Real, E, const B: usize, const V: usize>(
    scene: &E,
    joint: AdvisedJoint,
) -> impl Iterator<Item = Advice>
where
    E: Effect<R, B, V>,
{
    let inertia = scene.inertia(joint.number).map(R::to_f64);
    let negative = inertia
        .filter(|inertia| *inertia < 0.0)
        .map(|inertia| Advice::NegativeArmature { joint, inertia });
    let missing = E::LOAD_DEPENDENT && inertia.unwrap_or_default() == 0.0;
    let missing = missing.then_some(Advice::NoRotorInertia { joint });
    let driving = SPEEDS.into_iter().flat_map(|speed| [speed, -speed]);
    let driving = driving.filter_map(|speed| {
        let torque = friction::<R, E, B, V>(scene, joint.number, speed)?;
        let drives = torque * speed < 0.0;
        drives.then_some(Advice::DrivingFriction { joint, speed, torque })
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
