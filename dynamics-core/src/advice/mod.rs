//! Words on a robot's description, a scene or a controller's configuration: advice, never a
//! refusal.
//!
//! A description in grams, millimetres or degrees is a correct one of another machine: it compiles
//! and runs, and its torques are wrong by a factor of thousands.
//! [`Model::advice`](crate::model::Model::advice),
//! [`Model::advice_on`](crate::model::Model::advice_on) a scene and
//! `motion_control::MotionControllerConfig::advice` compare the numbers with those of machines, and
//! name the number, the reason and what to do. They are for a host, a test or the start of a
//! firmware: none of it is in a tick, nor in an image that does not call it.
//!
//! ```
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model};
//! const LIMITS: JointLimits<f64> = JointLimits { lower: -90.0, upper: 90.0, velocity: 2.0, torque: 20.0 };
//! const ARM: ArmModel<f64, 2> = Model::new("arm", [
//!     Body::new("upper", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.15, 0.0, 0.0]).limits(LIMITS),
//!     Body::new("fore", 0, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.3, 0.0, 0.0]).mass(1.0).com([0.1, 0.0, 0.0])
//!         .limits(LIMITS),
//! ]);
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

use crate::model::ImpossibleInertia;
pub use units::{positions_in_degrees, speeds_in_degrees};

/// A joint that an [`Advice`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdvisedJoint {
    /// Its index in q̇.
    pub number: usize,
    /// The name of the body that it moves, where the robot is known.
    pub body: Option<&'static str>,
}

/// A frequency of a control loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Frequency {
    /// The natural frequency ω_n of the feedback.
    Natural,
    /// The rate at which the speed of a held arm decays.
    DecayRate,
    /// The bandwidth of the observer.
    Observer,
}

/// A number that machines do not have, with what it is compared with. SI units.
///
/// [`Display`](core::fmt::Display) says what it is, why it is remarkable and what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Advice {
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
    /// The limits of position look like degrees.
    PositionsInDegrees {
        /// The joint with the farthest limit.
        joint: AdvisedJoint,
        /// The limit, rad.
        limit: f64,
    },
    /// The limit of position of one joint among others looks like degrees.
    PositionInDegrees {
        /// The joint with the farthest limit.
        joint: AdvisedJoint,
        /// The limit, rad.
        limit: f64,
    },
    /// The limits of speed look like degrees per second.
    SpeedsInDegrees {
        /// The joint with the greatest limit.
        joint: AdvisedJoint,
        /// The limit, rad/s.
        limit: f64,
    },
    /// The limit of speed of one joint among others looks like degrees per second.
    SpeedInDegrees {
        /// The joint.
        joint: AdvisedJoint,
        /// The limit, rad/s.
        limit: f64,
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
    /// A tick is far longer than that of a control loop.
    LongTick {
        /// The tick, s.
        tick: f64,
    },
    /// The torque may not change: the joint never gets any.
    ZeroRate {
        /// The joint.
        joint: AdvisedJoint,
        /// Its limit of torque, N·m or N.
        torque: f64,
    },
    /// An arm may be started so far from its trajectory that it is not a restart; it looks like
    /// degrees.
    FarRestart {
        /// The distance, rad or m.
        distance: f64,
    },
    /// A frequency is above half that of the ticks, π / h.
    BeyondNyquist {
        /// Which.
        of: Frequency,
        /// The frequency, rad/s.
        frequency: f64,
        /// π / h, rad/s.
        nyquist: f64,
    },
    /// A frequency of the feedback is not below the bandwidth of the observer, whose velocity it
    /// uses.
    BeyondObserver {
        /// Which.
        of: Frequency,
        /// The frequency, rad/s.
        frequency: f64,
        /// The bandwidth, rad/s.
        bandwidth: f64,
    },
    /// The natural frequency of the feedback is not below the bandwidth of the drive's torque.
    BeyondDrive {
        /// The natural frequency, rad/s.
        frequency: f64,
        /// The bandwidth of the drive, rad/s.
        bandwidth: f64,
    },
    /// A count of the encoder changes the estimated velocity by a large share of the joint's
    /// greatest speed.
    CoarseEncoder {
        /// The joint.
        joint: AdvisedJoint,
        /// The encoder's step Δ, rad or m.
        resolution: f64,
        /// The change of velocity ω_o² h Δ, rad/s or m/s.
        step: f64,
        /// The joint's greatest speed, rad/s or m/s.
        speed: f64,
    },
}

impl Advice {
    /// Whether the advice is that numbers are in another unit than that of the library.
    pub const fn is_about_units(&self) -> bool {
        matches!(
            self,
            Self::MassesInGrams { .. }
                | Self::LengthsInMillimetres { .. }
                | Self::InertiasInMillimetres { .. }
                | Self::InertiaInMillimetres { .. }
                | Self::InertiasAboutJoints { .. }
                | Self::InertiaAboutJoint { .. }
                | Self::PositionsInDegrees { .. }
                | Self::PositionInDegrees { .. }
                | Self::SpeedsInDegrees { .. }
                | Self::SpeedInDegrees { .. }
                | Self::LongTick { .. }
                | Self::FarRestart { .. }
        )
    }

    /// The joint that it is about; none of an advice on the robot or the loop.
    pub const fn joint(&self) -> Option<AdvisedJoint> {
        match *self {
            Self::PositionsInDegrees { joint, .. }
            | Self::PositionInDegrees { joint, .. }
            | Self::SpeedsInDegrees { joint, .. }
            | Self::SpeedInDegrees { joint, .. }
            | Self::DrivingFriction { joint, .. }
            | Self::NegativeArmature { joint, .. }
            | Self::NoRotorInertia { joint }
            | Self::TorqueLimitsFarAbove { joint, .. }
            | Self::GravityBeyondTorque { joint, .. }
            | Self::ZeroRate { joint, .. }
            | Self::CoarseEncoder { joint, .. } => Some(joint),
            _ => None,
        }
    }

    /// The same with the joint's name, from
    /// [`coordinate_names`](crate::model::Model::coordinate_names) or another list of the joints.
    ///
    /// ```
    /// use dynamics_core::advice::{Advice, AdvisedJoint};
    /// let joint = AdvisedJoint { number: 1, body: None };
    /// let advice = Advice::ZeroRate { joint, torque: 9.0 }.named(&["shoulder", "elbow"]);
    /// assert_eq!(
    ///     advice.to_string(),
    ///     "joint 1 (`elbow`): a rate of zero lets its torque never change, although its limit is 9 N·m or N: the joint gets \
    ///      no torque; the rate is a change in a tick, such as half of the limit, or infinite"
    /// );
    /// ```
    #[must_use]
    pub fn named(mut self, names: &[&'static str]) -> Self {
        if let Self::PositionsInDegrees { joint, .. }
        | Self::PositionInDegrees { joint, .. }
        | Self::SpeedsInDegrees { joint, .. }
        | Self::SpeedInDegrees { joint, .. }
        | Self::DrivingFriction { joint, .. }
        | Self::NegativeArmature { joint, .. }
        | Self::NoRotorInertia { joint }
        | Self::TorqueLimitsFarAbove { joint, .. }
        | Self::GravityBeyondTorque { joint, .. }
        | Self::ZeroRate { joint, .. }
        | Self::CoarseEncoder { joint, .. } = &mut self
        {
            joint.body = names.get(joint.number).copied();
        }
        self
    }
}
