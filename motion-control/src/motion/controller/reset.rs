//! The start of an arm that is stopped, at power-up or after a fault.

use core::fmt;

use super::{MeasurementAge, MotionController};
use crate::limits::Mode;
use crate::reference::Reference;
use dynamics_core::scalar::Real;

/// The reason why a stopped arm is not restarted. Joints are numbered from 0.
///
/// ```
/// use motion_control::ResetError;
/// assert_eq!(ResetError::TooFar { joint: 2 }.to_string(), "joint 2: it is too far from its reference");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ResetError {
    /// The arm is not stopped, nor held by a stop of category 2.
    NotStopped,
    /// There was no measurement in the last tick.
    NoMeasurement,
    /// There is a contact, or there was one too recently: see [`ContactReaction`](crate::ContactReaction).
    Contact,
    /// The joint is outside its bounds: [`BackOff`](crate::BackOff) leads it back, or a person moves it.
    OutOfBounds {
        /// The joint.
        joint: usize,
    },
    /// A joint is further than the restart distance from the point at which its trajectory continues.
    TooFar {
        /// The joint.
        joint: usize,
    },
}

impl fmt::Display for ResetError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotStopped => out.write_str("the arm is not stopped"),
            Self::NoMeasurement => out.write_str("there was no measurement in the last tick"),
            Self::Contact => out.write_str("there is a contact, or there was one too recently"),
            Self::OutOfBounds { joint } => write!(out, "joint {joint}: it is outside its bounds"),
            Self::TooFar { joint } => {
                write!(out, "joint {joint}: it is too far from its reference")
            }
        }
    }
}

impl core::error::Error for ResetError {}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Whether the last tick had a measurement, which need not be within the bounds.
    pub(crate) fn measured(&self) -> bool {
        !self.dead_reckoning & self.observer.started()
    }

    /// Starts a stopped arm, at power-up or after a fault: clears the fault and leads the arm onto its trajectory.
    ///
    /// The brake holds until the torque that keeps the arm at rest is reached, a few ticks later. An arm that is held
    /// by a stop of category 2 stays under power.
    ///
    /// # Errors
    /// [`ResetError`]; the controller is then unchanged.
    pub fn reset<T: Reference<R, V>>(&mut self, trajectory: &T) -> Result<(), ResetError> {
        let stands = self.supervisor.stands();
        if !matches!(self.supervisor.mode(), Mode::Stopped) & !stands {
            return Err(ResetError::NotStopped);
        }
        if !self.measured() {
            return Err(ResetError::NoMeasurement);
        }
        if let Some(joint) = self.supervisor.outside(&self.observer.estimate().q) {
            return Err(ResetError::OutOfBounds { joint });
        }
        if !self.supervisor.knows_positions() {
            return Err(ResetError::NoMeasurement);
        }
        let goal = trajectory.at(self.clock).q;
        let mut joints = goal.iter().zip(&self.observer.estimate().q);
        let near = |(goal, q): (&R, &R)| (*goal - *q).abs() <= self.restart_distance;
        if let Some(joint) = joints.position(|joint| !near(joint)) {
            return Err(ResetError::TooFar { joint });
        }
        if stands {
            self.supervisor.release();
            self.resume.start(self.observer.estimate(), self.clock);
            self.reference.qdd = [R::ZERO; V];
        } else {
            self.restart();
        }
        Ok(())
    }

    /// Clears a stop; the reference begins at the estimated position.
    pub(crate) fn restart(&mut self) {
        self.supervisor.reset();
        self.resume.start(self.observer.estimate(), self.clock);
        self.reference.qdd = [R::ZERO; V];
    }
}
