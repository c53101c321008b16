//! The configuration of a motion controller.

use crate::estimate::ObserverConfig;
use crate::limits::{ConfigError, ConfigParameter};
use crate::motion::ResumeConfig;
use crate::safety::SupervisorConfig;
use dynamics_core::scalar::Real;

/// The parameters of a [`MotionController`](super::MotionController): those of the arm and of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionControllerConfig<R, const V: usize> {
    /// Limits, the length of a tick, and the durations of the reactions to a fault.
    pub supervisor: SupervisorConfig<R, V>,
    /// Bandwidth ω_o of the observer, rad/s, about ten times that of the feedback.
    pub observer_bandwidth: R,
    /// Rate λ at which the speed of a held arm decays, 1/s: q̈ = −λ q̇. About ω_n of the feedback; with 2 ζ ω_n a fast arm
    /// needs more torque than it has.
    pub decay_rate: R,
    /// The greatest distance of a joint from its reference for
    /// [`MotionController::reset`](super::MotionController::reset), rad or m.
    pub restart_distance: R,
}

impl<R: Real, const V: usize> MotionControllerConfig<R, V> {
    /// Checks that every number is within its range and that every limit allows some motion or torque.
    ///
    /// # Errors
    /// [`ConfigError`]; if a limit is wrong, with the joint, the limit and its value.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.supervisor.check()?;
        self.observer().check()?;
        self.resume().check()?;
        ConfigParameter::RestartDistance.require(self.restart_distance >= R::ZERO)
    }

    pub(super) fn observer(&self) -> ObserverConfig<R> {
        ObserverConfig {
            bandwidth: self.observer_bandwidth,
            tick: self.supervisor.tick,
        }
    }

    pub(super) fn resume(&self) -> ResumeConfig<R> {
        ResumeConfig {
            tick: self.supervisor.tick,
            decay_rate: self.decay_rate,
            ticks: self.supervisor.reentry_ticks,
        }
    }
}
