//! ODrive: torque and estimates over CAN, protocol CANSimple.
//!
//! # Source
//! ODrive firmware 0.5, `docs/can-protocol.rst` and `docs/_static/can-protocol.csv` of
//! odriverobotics/ODrive: the 11-bit identifier is node << 5 | command, with nodes up to 0x3F; all
//! values are little-endian; a message is requested by a remote frame with its identifier. Units
//! (rev, rev/s, N·m), states, modes and Get_Torques (0x1C), which 0.5 does not have: the CAN
//! database of firmware 0.6.10, as odrive-can documents it ("odrive-cansimple-0.6.10 interface").
//!
//! After power-up the position of an axis with an absolute encoder is known within a turn of its
//! motor; then the axis counts the turns itself.
//!
//! Nodes with extended identifiers are not supported. Only the errors and the state of the
//! heartbeat are decoded, which both versions have in the same place.

use core::f32::consts::TAU;

use embedded_can::{Frame, Id, StandardId};

use super::frame::{self, CanError};
use super::joint::{CanJoint, Report};
use super::turns::ShaftTurns;
use crate::{EncoderMapping, MappingError};

const HEARTBEAT: u16 = 0x01;
const ESTOP: u16 = 0x02;
const SET_AXIS_STATE: u16 = 0x07;
const GET_ENCODER_ESTIMATES: u16 = 0x09;
const SET_CONTROLLER_MODE: u16 = 0x0b;
const SET_INPUT_TORQUE: u16 = 0x0e;
const CLEAR_ERRORS: u16 = 0x18;
const GET_TORQUES: u16 = 0x1c;
/// All data messages of an axis have 8 bytes.
const LENGTH: usize = 8;

/// The state of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AxisState {
    /// No power to the motor.
    Idle,
    /// Torque is delivered as commanded.
    ClosedLoopControl,
    /// Another state, by its number: calibrations, searches, homing.
    Other(u8),
}

impl AxisState {
    const fn number(self) -> u8 {
        match self {
            Self::Idle => 1,
            Self::ClosedLoopControl => 8,
            Self::Other(number) => number,
        }
    }

    const fn from_number(number: u8) -> Self {
        match number {
            1 => Self::Idle,
            8 => Self::ClosedLoopControl,
            other => Self::Other(other),
        }
    }
}

/// The messages of an ODrive, mapped to the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reply {
    /// The axis is alive.
    Heartbeat {
        /// A bit for each error; zero without one. The bits of firmware 0.5 and 0.6 differ.
        errors: u32,
        /// The state of the axis.
        state: AxisState,
    },
    /// The reply to Get_Encoder_Estimates.
    Estimates {
        /// The position of the joint, rad.
        position: f32,
        /// The velocity of the joint, rad/s.
        velocity: f32,
    },
    /// Get_Torques, of firmware 0.6; firmware 0.5 has another message of this number, which it
    /// sends only on request.
    Torques {
        /// The torque that the controller aims at, N·m.
        target: f32,
        /// The torque that the motor delivers, N·m.
        estimate: f32,
    },
}

/// One joint's ODrive axis.
///
/// ```
/// use embedded_can::Frame;
/// use joint_drivers::{JointMapping, JointRange, can::FdFrame, odrive::{ODrive, Reply}};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(2.0), 5e-3)?;
/// let mut axis = ODrive::new(3, 10.0, mapping)?;
/// let command: FdFrame = axis.set_torque(1.5)?;
/// assert_eq!(command.data(), [0x00, 0x00, 0xc0, 0x3f]);
/// let request: FdFrame = axis.request_estimates()?;
/// let reply = FdFrame::new(request.id(), &[0, 0, 0, 0x3f, 0, 0, 0, 0]).unwrap();
/// let expected = Reply::Estimates { position: core::f32::consts::PI, velocity: 0.0 };
/// assert_eq!(axis.reply(&reply)?, expected);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ODrive {
    node: u8,
    most: f32,
    turns: ShaftTurns,
}

impl ODrive {
    /// The axis of node `node`, 0 to 0x3F, that delivers at most `most` N·m at the joint.
    ///
    /// # Errors
    /// [`CanError::Node`], [`CanError::Torque`].
    pub fn new(node: u8, most: f32, mapping: EncoderMapping) -> Result<Self, CanError> {
        if node > 0x3f {
            return Err(CanError::Node);
        }
        frame::check_most(most, mapping.mapping())?;
        Ok(Self { node, most, turns: ShaftTurns::in_turns(mapping) })
    }

    /// Takes the joint to be at `position` rad or m: the next estimate is within half a turn of the
    /// motor from there.
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    pub fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.turns.place_near(position)
    }

    /// Notes this many ticks without a reply: the axis may have lost its supply, and its turns.
    pub fn missed(&mut self, ticks: u32) {
        self.turns.missed(ticks);
    }

    /// Set_Input_Torque: a torque in N·m at the joint, limited to the greatest; NaN becomes zero
    /// torque.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn set_torque<F: Frame>(&self, torque: f32) -> Result<F, CanError> {
        let torque = frame::limit(torque, self.most);
        let at_motor = self.turns.mapping.mapping().shaft_torque(torque);
        let at_motor = at_motor.map_err(|_| CanError::NotFinite)?;
        self.frame(SET_INPUT_TORQUE, &at_motor.to_le_bytes())
    }

    /// Set_Controller_Mode: torque control, with the input passed through.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn set_torque_mode<F: Frame>(&self) -> Result<F, CanError> {
        self.frame(SET_CONTROLLER_MODE, &[1, 0, 0, 0, 1, 0, 0, 0])
    }

    /// The frame Set_Axis_State.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn set_state<F: Frame>(&self, state: AxisState) -> Result<F, CanError> {
        self.frame(SET_AXIS_STATE, &[state.number(), 0, 0, 0])
    }

    /// Estop: the axis is disarmed with an error.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn stop<F: Frame>(&self) -> Result<F, CanError> {
        self.frame(ESTOP, &[])
    }

    /// The frame Clear_Errors.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn clear_errors<F: Frame>(&self) -> Result<F, CanError> {
        self.frame(CLEAR_ERRORS, &[0])
    }

    /// A request of Get_Encoder_Estimates, which the axis also sends every 10 ms by itself if
    /// nothing else was configured.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn request_estimates<F: Frame>(&self) -> Result<F, CanError> {
        self.remote(GET_ENCODER_ESTIMATES)
    }

    /// A request of Get_Torques.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn request_torques<F: Frame>(&self) -> Result<F, CanError> {
        self.remote(GET_TORQUES)
    }

    /// The estimate of a frame, mapped to the joint. In the first estimate the joint is where the
    /// mapping says that it can be.
    ///
    /// # Errors
    /// [`CanError::Identifier`] for another node or message, [`CanError::Remote`],
    /// [`CanError::Short`], [`CanError::NotFinite`].
    pub fn reply<F: Frame>(&mut self, frame: &F) -> Result<Reply, CanError> {
        let Id::Standard(id) = frame.id() else {
            return Err(CanError::Identifier);
        };
        if id.as_raw() >> 5 != u16::from(self.node) {
            return Err(CanError::Identifier);
        }
        if frame.is_remote_frame() {
            return Err(CanError::Remote);
        }
        let data = frame.data();
        let floats = || Ok([frame::float(data, 0)?, frame::float(data, 4)?]);
        let not_finite = |_| CanError::NotFinite;
        match id.as_raw() & 0x1f {
            HEARTBEAT => {
                let [e0, e1, e2, e3, state, _, _, _] = frame::bytes::<LENGTH>(data, 0)?;
                Ok(Reply::Heartbeat {
                    errors: u32::from_le_bytes([e0, e1, e2, e3]),
                    state: AxisState::from_number(state),
                })
            }
            GET_ENCODER_ESTIMATES => floats().and_then(|[turns, per_second]| {
                let [position, _] = self.turns.follow(turns)?;
                let velocity =
                    self.turns.mapping.mapping().velocity(per_second * TAU).map_err(not_finite)?;
                Ok(Reply::Estimates { position, velocity })
            }),
            GET_TORQUES => floats().and_then(|[target, estimate]| {
                let target = self.turns.mapping.mapping().torque(target).map_err(not_finite)?;
                let estimate = self.turns.mapping.mapping().torque(estimate).map_err(not_finite)?;
                Ok(Reply::Torques { target, estimate })
            }),
            _ => Err(CanError::Identifier),
        }
    }

    fn frame<F: Frame>(&self, command: u16, data: &[u8]) -> Result<F, CanError> {
        frame::frame(self.id(command)?, data)
    }

    fn remote<F: Frame>(&self, command: u16) -> Result<F, CanError> {
        F::new_remote(self.id(command)?, LENGTH).ok_or(CanError::Length(LENGTH))
    }

    fn id(&self, command: u16) -> Result<StandardId, CanError> {
        StandardId::new(u16::from(self.node) << 5 | command).ok_or(CanError::Node)
    }
}

/// The axis is to send its estimates and its heartbeat by itself, at least once a tick and in its
/// ride-through.
impl CanJoint for ODrive {
    fn command<F: Frame>(&self, torque: f32) -> Result<F, CanError> {
        self.set_torque(torque)
    }

    fn missed(&mut self, ticks: u32) {
        self.missed(ticks);
    }

    fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.place_near(position)
    }

    fn clear_errors<F: Frame>(&self) -> Result<F, CanError> {
        self.clear_errors()
    }

    fn report<F: Frame>(&mut self, frame: &F) -> Result<Report, CanError> {
        let (mut position, mut delivers) = (None, None);
        match self.reply(frame)? {
            Reply::Estimates { position: at, .. } => position = Some(at),
            Reply::Heartbeat { errors, state } => {
                delivers = Some(match state {
                    _ if errors != 0 => Err(CanError::Fault(errors)),
                    AxisState::ClosedLoopControl => Ok(()),
                    _ => Err(CanError::NotReady),
                });
            }
            Reply::Torques { .. } => {}
        }
        Ok(Report { position, delivers })
    }
}
