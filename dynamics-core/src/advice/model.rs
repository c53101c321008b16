//! Advice on the description of a robot.

use super::{Advice, torques, units};
use crate::model::{ImpossibleInertia, Link, Model, impossible};
use crate::scalar::{Matrix, Real, Vector};

impl<R: Real, const B: usize, const Q: usize, const V: usize> Model<R, B, Q, V> {
    /// Advice on a description that looks like another unit, is impossible, or asks more of the
    /// motors than they have: a list of words with numbers, empty for most robots. Never a refusal.
    ///
    /// | advice | given where |
    /// |---|---|
    /// | [`Advice::MassesInGrams`] | mass over the cube of the reach is above 2,000 kg/m³ (of published robots 3 to 130), and most of it in bodies denser than a solid sphere of steel |
    /// | [`Advice::LengthsInMillimetres`] | the reach is above 20 m, and mass over its cube below 0.01 kg/m³ |
    /// | [`Advice::ImpossibleInertia`] | a principal moment of a body is negative, or exceeds the sum of the two others, by more than 0.001 of the largest |
    /// | [`Advice::InertiasInMillimetres`] | most bodies have a radius of gyration above ten reaches (0.03 to 0.74) |
    /// | [`Advice::InertiaInMillimetres`] | one has one above three reaches, and less than 0.01 kg/m³ for its cube |
    /// | [`Advice::InertiasAboutJoints`] | of every body with a far centre of mass the inertia about that would still be one after m d² is taken off |
    /// | [`Advice::InertiaAboutJoint`] | of one body the same, and it is wider than what lies between its joints |
    /// | [`Advice::PositionsInDegrees`], [`Advice::PositionInDegrees`] | most limits of rotation, or some, are beyond four turns (of published robots up to 1.6) |
    /// | [`Advice::SpeedsInDegrees`], [`Advice::SpeedInDegrees`] | most limits of angular speed are above 60 rad/s (up to 32), or one is, and 20 times the next |
    /// | [`Advice::TorqueLimitsFarAbove`] | every limit is more than 20 times what holds all that the joint moves, stretched out |
    /// | [`Advice::GravityBeyondTorque`] | gravity along −z needs more torque than the limit, at a configuration within the limits |
    ///
    /// Limits that are infinite, zero or a power of ten of 100 or more stand for none.
    ///
    /// # Cost
    /// Some µs on a host; for a joint whose limit is below its weight stretched out, up to 36 times
    /// the number of joints before and after it evaluations of [`rnea`](crate::algorithms::rnea()).
    /// Not for a tick.
    ///
    /// ```
    /// use dynamics_core::advice::Advice;
    /// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
    /// use dynamics_core::robots::Ur5e;
    /// assert_eq!(Ur5e::MODEL.advice().count(), 0);
    ///
    /// // 2,000 g on 0.5 m, taken for kilograms.
    /// const PENDULUM: ArmModel<f64, 1> = Model::new("pendulum", [
    ///     Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2000.0).com([0.0, 0.0, -0.5]),
    /// ]);
    /// assert!(matches!(PENDULUM.advice().next(), Some(Advice::MassesInGrams { mass: 2000.0, .. })));
    /// ```
    pub fn advice(&self) -> impl Iterator<Item = Advice> + '_ {
        let bodies = self.links.iter().filter_map(impossible_body);
        bodies.chain(units::of(self)).chain(torques::of(self))
    }

    /// The name of the body of each velocity coordinate.
    ///
    /// ```
    /// use dynamics_core::{model::Robot, robots::A1Leg};
    /// assert_eq!(A1Leg::MODEL.coordinate_names().len(), 3); // the foot is fixed
    /// ```
    pub fn coordinate_names(&self) -> [&'static str; V] {
        let mut names = [""; V];
        for link in &self.links {
            let (_, count) = link.joint.kind.coordinates();
            for name in names.iter_mut().skip(link.idx_v).take(count) {
                *name = link.name;
            }
        }
        names
    }
}

/// By how much of its largest moment an inertia may be impossible without a word: the rounding of a
/// description's digits.
const ROUNDING: f64 = 1e-3;

/// The impossible inertia of a body, in the frame of its description.
fn impossible_body<R: Real>(link: &Link<R>) -> Option<Advice> {
    let found = impossible::<R, true>(&link.inertia, ROUNDING)?;
    let [x, y, z] = found.axis.map(R::from_f64);
    let axis = link.to_joint_frame.transpose() * R::Vec3::new(x, y, z);
    Some(Advice::ImpossibleInertia {
        body: link.name,
        found: ImpossibleInertia { axis: axis.array().map(R::to_f64), ..found },
    })
}
