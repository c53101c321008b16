//! The joint of a controller on CAN.

use embedded_can::Frame;

use super::frame::CanError;
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
