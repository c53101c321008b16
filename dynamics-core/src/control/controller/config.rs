//! The configuration of a motion controller.

use super::super::{ConfigError, ConfigParameter, ObserverConfig, ResumeConfig, SupervisorConfig};
use crate::scalar::Real;

/// What a [`MotionController`](super::MotionController) has to know of the arm and of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionControllerConfig<R, const V: usize> {
    /// Limits, the length of a tick, and how long each answer to a fault lasts.
    pub supervisor: SupervisorConfig<R, V>,
    /// Bandwidth ω_o of the observer, rad/s, ten times that of the feedback or so.
    pub observer_bandwidth: R,
    /// Rate λ at which the speed of a held arm decays, 1/s: q̈ = −λ q̇. About ω_n of the feedback; with 2 ζ ω_n a fast arm
    /// needs more torque than it has.
    pub decay_rate: R,
    /// How far from its reference a joint may be for [`MotionController::reset`](super::MotionController::reset), rad or m.
    pub restart_distance: R,
}

impl<R: Real, const V: usize> MotionControllerConfig<R, V> {
    /// Checks that every number lies in its range and that every limit allows something.
    ///
    /// # Errors
    /// [`ConfigError`]: its source names the joint, if a limit is wrong.
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
