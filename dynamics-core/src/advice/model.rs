//! Advice on the description of a robot.

use super::{Advice, torques, units};
use crate::model::Model;
use crate::scalar::Real;

impl<R: Real, const B: usize, const Q: usize, const V: usize> Model<R, B, Q, V> {
    /// What of the description looks like another unit, or asks more of the motors than they have: a list of words with
    /// numbers, empty for most robots. Never a refusal.
    ///
    /// | advice | given where |
    /// |---|---|
    /// | [`Advice::MassesInGrams`] | mass over the cube of the reach is above 2,000 kg/m³ (of published robots 3 to 130), and most of it in bodies denser than a solid sphere of steel |
    /// | [`Advice::LengthsInMillimetres`] | the reach is above 20 m, and mass over its cube below 0.01 kg/m³ |
    /// | [`Advice::InertiasInMillimetres`] | most bodies have a radius of gyration above ten reaches (0.03 to 0.74) |
    /// | [`Advice::InertiasAboutJoints`] | of every body with a far centre of mass the inertia about that would still be one after m d² is taken off |
    /// | [`Advice::PositionsInDegrees`] | most limits of rotation are beyond four turns (of published robots up to 1.6) |
    /// | [`Advice::SpeedsInDegrees`] | most limits of angular speed are above 60 rad/s (up to 32) |
    /// | [`Advice::TorqueLimitsFarAbove`] | every limit is more than 20 times what holds all that the joint moves, stretched out |
    /// | [`Advice::GravityBeyondTorque`] | gravity along −z needs more torque than the limit, at a configuration within the limits |
    ///
    /// Limits that are infinite, zero or a power of ten of 100 or more stand for none.
    ///
    /// # Cost
    /// Some µs on a host; for a joint whose limit is below its weight stretched out, up to 36 times the number of
    /// joints before and after it evaluations of [`rnea`](crate::algorithms::rnea()). Not for a tick.
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
        units::of(self)
            .into_iter()
            .flatten()
            .chain(torques::of(self))
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
