//! The configuration of a reaction to contacts.

use crate::limits::MotionLimits;
use crate::limits::{ConfigError, ConfigParameter};
use dynamics_core::scalar::Real;

/// How an arm reacts to a contact. Each ends with the arm held by a stop of category 2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ContactResponse<R> {
    /// The arm is decelerated: a stop of category 2.
    Stop,
    /// The reference stops and goes back along its path, from rest where the arm is. The gap from there to the newest point
    /// of the path fades over the whole retraction.
    Retract {
        /// How far from the newest point of the path, rad or m: the sum over the path of the steps of the joint that moves
        /// most. The points are apart by a fraction 1/(N − 1) of it.
        distance: R,
        /// Greatest speed and acceleration of the reference in the retraction, of all joints.
        limits: MotionLimits<R>,
    },
    /// The arm follows the contact: the reference is the estimate of the joints with q̈ = −d q̇, so that feedback is zero
    /// and the law is left with gravity, friction and damping. The law must produce q̈, with the inertia of the arm: one of
    /// gravity and friction alone leaves the arm undamped up to the speed limit of the supervisor.
    ///
    /// An arm that is released comes to rest only if the friction that its law leaves out is larger than the error of its
    /// gravity: let the law compensate a share of the friction in [`ContactPhase::Floating`](super::ContactPhase::Floating).
    Float {
        /// d, 1/s.
        damping: R,
        /// The speed of a joint beyond which it is decelerated as in a hold, rad/s or m/s.
        speed: R,
    },
}

/// The parameters of a [`ContactReaction`](super::ContactReaction).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactReactionConfig<R> {
    /// The reaction.
    pub response: ContactResponse<R>,
    /// Consecutive ticks without a contact after which the arm may be reset.
    pub release_ticks: u32,
}

impl<R: Real> ContactReactionConfig<R> {
    /// Checks that every number is finite and greater than zero; a limit of acceleration may be infinite.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::ReleaseTicks.require(self.release_ticks > 0)?;
        match self.response {
            ContactResponse::Stop => Ok(()),
            ContactResponse::Retract { distance, limits } => {
                ConfigParameter::RetractDistance.positive(distance)?;
                ConfigParameter::RetractLimit.positive(limits.velocity)?;
                ConfigParameter::RetractLimit.require(limits.acceleration > R::ZERO)
            }
            ContactResponse::Float { damping, speed } => {
                ConfigParameter::FloatDamping.positive(damping)?;
                ConfigParameter::FloatSpeed.positive(speed)
            }
        }
    }
}
