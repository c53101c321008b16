//! The joint of a controller on CAN.

use embedded_can::Frame;

use super::frame::CanError;
use crate::MappingError;
use crate::drives::pd::SetpointAt;

/// A motor controller on CAN that measures its joint and takes torques.
pub trait CanJoint {
    /// The frame of a torque, N·m or N at the joint; that of zero torque for NaN.
    ///
    /// # Errors
    /// [`CanError::Length`].
    fn command<F: Frame>(&self, torque: f32) -> Result<F, CanError>;

    /// The joint's values from a frame.
    ///
    /// # Errors
    /// [`CanError::Identifier`] for a frame of another joint; else the frame is wrong.
    fn report<F: Frame>(&mut self, frame: &F) -> Result<Report, CanError>;

    /// Notes ticks without a position: the controller may have lost its supply, and its turns with
    /// it, which is [`CanError::LostTurn`] until [`Self::place_near`].
    fn missed(&mut self, ticks: u32);

    /// Takes the joint to be at `position` rad or m: the next one is within half a turn of the shaft
    /// from there.
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    fn place_near(&mut self, position: f32) -> Result<(), MappingError>;

    /// The frame that clears the faults of the controller.
    ///
    /// # Errors
    /// [`CanError::Length`]. [`CanError::Unknown`]: there is no such frame.
    fn clear_errors<F: Frame>(&self) -> Result<F, CanError> {
        Err(CanError::Unknown(0))
    }

    /// The frame that makes the present position the zero of the controller: send it while it
    /// delivers no torque. The next position is where the mapping says that the joint can be.
    ///
    /// # Errors
    /// [`CanError::Length`]. [`CanError::Unknown`]: there is no such frame; nothing is changed.
    fn set_zero<F: Frame>(&mut self) -> Result<F, CanError> {
        Err(CanError::Unknown(0))
    }

    /// Takes a frame that is no joint's report, and returns whether it is one of this joint: the
    /// value of a register.
    fn learn<F: Frame>(&mut self, frame: &F) -> bool {
        let _ = frame;
        false
    }
}

/// A motor controller on CAN with a spring and a damper of its own: [`crate::mit::Drive`].
pub trait PdCanJoint: CanJoint {
    /// The frame of a spring, a damper and the torque that makes their sum that of the setpoint.
    ///
    /// # Errors
    /// [`CanError::Length`].
    fn pd_command<F: Frame>(&self, setpoint: &SetpointAt) -> Result<F, CanError>;
}

/// A joint's values from a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// The joint's position, rad or m.
    pub position: Option<f32>,
    /// Whether the controller delivers torques, or why it does not: [`CanError::NotReady`],
    /// [`CanError::Fault`] and others.
    pub delivers: Option<Result<(), CanError>>,
}
