//! Advice on the description of a robot.

#[cfg(doc)]
use dynamics_core::advice::Advice;
use dynamics_core::effects::Effect;
use dynamics_core::model::{Link, Model, impossible};
use dynamics_core::scalar::{Matrix, Real, Vector};

use super::{NumberAdvice, scene, torques, units};

/// Advice on a robot of B bodies with Q positions and V velocities, and on its scenes.
pub trait Advise<R: Real, const B: usize, const Q: usize, const V: usize> {
    /// Advice on a description that looks like another unit, is impossible, or asks more of the
    /// motors than they have: a list of words with numbers, empty for most robots. Never a refusal.
    ///
    /// | advice | given where |
    /// |---|---|
    /// | [`NumberAdvice::MassesInGrams`] | mass over the cube of the reach is above 2,000 kg/m³ (of published robots 3 to 130), and most of it in bodies denser than a solid sphere of steel |
    /// | [`NumberAdvice::LengthsInMillimetres`] | the reach is above 20 m, and mass over its cube below 0.01 kg/m³ |
    /// | [`NumberAdvice::ImpossibleInertia`] | a principal moment of a body is negative, or exceeds the sum of the two others, by more than 0.001 of the largest |
    /// | [`NumberAdvice::InertiasInMillimetres`] | most bodies have a radius of gyration above ten reaches (0.03 to 0.74) |
    /// | [`NumberAdvice::InertiaInMillimetres`] | one has one above three reaches, and less than 0.01 kg/m³ for its cube |
    /// | [`NumberAdvice::InertiasAboutJoints`] | of every body with a far centre of mass the inertia about that would still be one after m d² is taken off |
    /// | [`NumberAdvice::InertiaAboutJoint`] | of one body the same, and it is wider than what lies between its joints |
    /// | [`Advice::PositionsInDegrees`], [`Advice::PositionInDegrees`] | most limits of rotation, or some, are beyond four turns (of published robots up to 1.6) |
    /// | [`Advice::SpeedsInDegrees`], [`Advice::SpeedInDegrees`] | most limits of angular speed are above 60 rad/s (up to 32), or one is, and 20 times the next |
    /// | [`NumberAdvice::TorqueLimitsFarAbove`] | every limit is more than 20 times what holds all that the joint moves, stretched out |
    /// | [`NumberAdvice::GravityBeyondTorque`] | gravity along −z needs more torque than the limit, at a configuration within the limits |
    ///
    /// Limits that are infinite, zero or a power of ten of 100 or more stand for none.
    ///
    /// # Cost
    /// Some µs on a host; for a joint whose limit is below its weight stretched out, up to 36 times
    /// the number of joints before and after it evaluations of [`rnea`](dynamics_core::algorithms::rnea()).
    /// Not for a tick.
    ///
    /// ```
    /// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
    /// use dynamics_core::robots::Ur5e;
    /// use robot_import::advice::numbers::{Advise, NumberAdvice};
    /// assert_eq!(Ur5e::MODEL.advice().count(), 0);
    ///
    /// // 2,000 g on 0.5 m, taken for kilograms.
    /// const PENDULUM: ArmModel<f64, 1> = Model::new("pendulum", [
    ///     Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2000.0).com([0.0, 0.0, -0.5]),
    /// ]);
    /// assert!(matches!(PENDULUM.advice().next(), Some(NumberAdvice::MassesInGrams { mass: 2000.0, .. })));
    /// ```
    fn advice(&self) -> impl Iterator<Item = NumberAdvice> + '_;

    /// Advice on a scene that no machine has: a list of words with numbers, empty for most scenes.
    /// Never a refusal.
    ///
    /// | advice | given where |
    /// |---|---|
    /// | [`NumberAdvice::DrivingFriction`] | what the scene adds to a joint's torque with its speed, at rest otherwise, drives the joint |
    /// | [`NumberAdvice::NegativeArmature`] | the inertia that it adds at a joint is negative |
    /// | [`NumberAdvice::NegativePayload`] | a payload has a negative mass |
    /// | [`NumberAdvice::NoRotorInertia`] | it has the friction of gears and no inertia at the joint |
    ///
    /// The values of a scene are no part of its type, so that the compiler does not find them.
    /// Effects of your own are asked as those of the library. Not for a tick.
    ///
    /// ```
    /// use dynamics_core::effects::{RIGID_BODY, Viscous};
    /// use dynamics_core::{model::Robot, robots::Ur5e};
    /// use robot_import::advice::numbers::Advise;
    /// assert_eq!(Ur5e::MODEL.advice_on(&(RIGID_BODY, Viscous([0.5; 6]))).count(), 0);
    /// let scene = (RIGID_BODY, Viscous([0.5, 0.5, -0.5, 0.5, 0.5, 0.5]));
    /// let words: Vec<String> = Ur5e::MODEL.advice_on(&scene).map(|advice| advice.to_string()).collect();
    /// assert_eq!(words, [
    ///     "joint 2 (`forearm`): at 1 rad/s or m/s the friction of the scene is -0.50 N·m or N: it drives the joint in place of \
    ///      braking it; no coefficient of friction is negative",
    /// ]);
    /// ```
    fn advice_on<E: Effect<R, B, V>>(&self, scene: &E) -> impl Iterator<Item = NumberAdvice>;
}

impl<R: Real, const B: usize, const Q: usize, const V: usize> Advise<R, B, Q, V>
    for Model<R, B, Q, V>
{
    fn advice(&self) -> impl Iterator<Item = NumberAdvice> + '_ {
        let bodies = self.links.iter().filter_map(impossible_body);
        bodies.chain(units::of(self)).chain(torques::of(self))
    }

    fn advice_on<E: Effect<R, B, V>>(&self, scene: &E) -> impl Iterator<Item = NumberAdvice> {
        scene::of(self, scene)
    }
}

/// By how much of its largest moment an inertia may be impossible without a word: the rounding of a
/// description's digits.
const ROUNDING: f64 = 1e-3;

/// The impossible inertia of a body, in the frame of its description.
fn impossible_body<R: Real>(link: &Link<R>) -> Option<NumberAdvice> {
    let mut found = impossible::<R, true>(&link.inertia, ROUNDING)?;
    let [x, y, z] = found.axis.map(R::from_f64);
    let axis = link.to_joint_frame.transpose() * R::Vec3::new(x, y, z);
    found.axis = axis.array().map(R::to_f64);
    Some(NumberAdvice::ImpossibleInertia { body: link.name, found })
}
