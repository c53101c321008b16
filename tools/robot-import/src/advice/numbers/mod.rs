//! Numbers of a robot or of a scene that machines do not have: advice, never a refusal.
//!
//! A description in grams, millimetres or degrees is a correct one of another machine: it compiles
//! and runs, and its torques are wrong by a factor of thousands. [`Advise::advice`] on a robot and
//! [`Advise::advice_on`] a scene compare the numbers with those of machines, and name the number,
//! the reason and what to do. They are for a test or another program on the host; that on a
//! controller's configuration is `motion_control::motion::MotionControllerConfig::advice`.
//!
//! ```
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model};
//! const LIMITS: JointLimits<f64> = JointLimits { lower: -90.0, upper: 90.0, velocity: 2.0, torque: 20.0 };
//! const ARM: ArmModel<f64, 2> = Model::new("arm", [
//!     Body::new("upper", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.15, 0.0, 0.0]).limits(LIMITS),
//!     Body::new("fore", 0, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.3, 0.0, 0.0]).mass(1.0).com([0.1, 0.0, 0.0])
//!         .limits(LIMITS),
//! ]);
//! use robot_import::advice::numbers::Advise;
//! let words: Vec<String> = ARM.advice().map(|advice| advice.to_string()).collect();
//! assert_eq!(words, [
//!     "joint 0 (`upper`): a position limit of 90 rad is 14.3 turns, and most joints of the robot have such: limits are in \
//!      rad, these look like degrees; divide them by 57.3",
//! ]);
//! ```

mod model;
mod scene;
#[cfg(test)]
mod tests;
mod torques;
mod units;
mod words;

use dynamics_core::advice::{Advice, AdvisedJoint};
use dynamics_core::model::ImpossibleInertia;

pub use model::Advise;

/// A number that machines do not have, with what it is compared with. SI units.
///
/// [`Display`](std::fmt::Display) says what it is, why it is remarkable and what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NumberAdvice {
    /// A limit looks like degrees.
    Limit(Advice),
    /// The masses look like grams: no arm has so much mass within its reach.
    MassesInGrams {
        /// The robot's name.
        robot: &'static str,
        /// The mass that its joints move, kg.
        mass: f64,
        /// The distance from the first joint to the farthest centre of mass, along the bodies, m.
        reach: f64,
    },
    /// The lengths look like millimetres.
    LengthsInMillimetres {
        /// The robot's name.
        robot: &'static str,
        /// The mass that its joints move, kg.
        mass: f64,
        /// The distance from the first joint to the farthest centre of mass, along the bodies, m.
        reach: f64,
    },
    /// The inertias look like kg·mm² or g·mm²: the masses would be farther from their centres than
    /// the robot is long.
    InertiasInMillimetres {
        /// The body with the largest radius of gyration.
        body: &'static str,
        /// Its radius of gyration, m.
        gyration: f64,
        /// The robot's reach, m.
        reach: f64,
    },
    /// The inertia of one body looks like kg·mm² or g·mm²: its mass would be farther from its
    /// centre than the robot is long, and thinner than air.
    InertiaInMillimetres {
        /// The body.
        body: &'static str,
        /// Its radius of gyration, m.
        gyration: f64,
        /// The robot's reach, m.
        reach: f64,
    },
    /// No distribution of mass has a body's inertia, by more than the rounding of its digits.
    ImpossibleInertia {
        /// The body.
        body: &'static str,
        /// The impossible inertia, in the frame of the description.
        found: ImpossibleInertia,
    },
    /// The inertias look like those about the joints in place of the centres of mass.
    InertiasAboutJoints {
        /// A body of which m d², with the distance d of its centre of mass, is the largest share of
        /// its inertia.
        body: &'static str,
        /// The body's largest moment of inertia as described, kg·m².
        inertia: f64,
        /// m d², kg·m².
        shift: f64,
    },
    /// The inertia of one body looks like that about its joint in place of its centre of mass: it
    /// is wider than what lies between its joints.
    InertiaAboutJoint {
        /// The body.
        body: &'static str,
        /// Its largest moment of inertia as described, kg·m².
        inertia: f64,
        /// m d² of the distance d of its centre of mass, kg·m².
        shift: f64,
    },
    /// Every limit of torque is far above what the joint needs: it limits nothing.
    TorqueLimitsFarAbove {
        /// The joint whose limit is the fewest times its need.
        joint: AdvisedJoint,
        /// The limit, N·m or N.
        limit: f64,
        /// The torque or force that holds all bodies that the joint moves, stretched out
        /// horizontally, N·m or N.
        needed: f64,
    },
    /// Within the limits of the positions there is a configuration in which the limit of torque
    /// does not hold the robot's weight.
    GravityBeyondTorque {
        /// The joint.
        joint: AdvisedJoint,
        /// The greatest torque of gravity that was found, N·m or N.
        needed: f64,
        /// The limit, N·m or N.
        limit: f64,
    },
    /// The friction of a scene drives a joint: its power is negative.
    DrivingFriction {
        /// The joint.
        joint: AdvisedJoint,
        /// A speed, rad/s or m/s.
        speed: f64,
        /// The torque that the scene adds at this speed, N·m or N.
        torque: f64,
    },
    /// The inertia that a scene adds at a joint is negative.
    NegativeArmature {
        /// The joint.
        joint: AdvisedJoint,
        /// The inertia, kg·m² or kg.
        inertia: f64,
    },
    /// The payload of a scene has a negative mass.
    NegativePayload {
        /// The body that carries it.
        body: &'static str,
        /// The mass, kg.
        mass: f64,
    },
    /// A scene has the friction of a joint's gear and no inertia of its rotor.
    NoRotorInertia {
        /// The joint.
        joint: AdvisedJoint,
    },
}

impl NumberAdvice {
    /// Whether the advice is that numbers are in another unit than that of the library.
    pub fn is_about_units(&self) -> bool {
        match self {
            Self::Limit(advice) => advice.is_about_units(),
            Self::MassesInGrams { .. }
            | Self::LengthsInMillimetres { .. }
            | Self::InertiasInMillimetres { .. }
            | Self::InertiaInMillimetres { .. }
            | Self::InertiasAboutJoints { .. }
            | Self::InertiaAboutJoint { .. } => true,
            _ => false,
        }
    }

    /// The joint that it is about; none of an advice on the robot or a body.
    pub fn joint(&self) -> Option<AdvisedJoint> {
        match *self {
            Self::Limit(advice) => advice.joint(),
            Self::DrivingFriction { joint, .. }
            | Self::NegativeArmature { joint, .. }
            | Self::NoRotorInertia { joint }
            | Self::TorqueLimitsFarAbove { joint, .. }
            | Self::GravityBeyondTorque { joint, .. } => Some(joint),
            _ => None,
        }
    }
}
