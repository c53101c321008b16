//! moteus: torque and state over CAN FD.
//!
//! # Source
//! mjbots/moteus, `docs/protocol/can.md` (identifiers, subframes, example) and
//! `docs/protocol/registers.md` (registers, their integer mappings, fault codes), which earlier
//! were sections A.1 and A.2 of `docs/reference.md`; section "Torque Control" of the latter.
//!
//! A command has 24 bytes and its reply 20: the bus and the frame type must be CAN FD. A frame type
//! of classic CAN refuses a command ([`CanError::Length`]). [`embedded_can::Frame`] does not say
//! whether the data phase has its own bit rate: set that in the HAL (1 Mbit/s, data 5 Mbit/s from
//! the factory). CAN FD has no lengths between 8, 12, 16, 20, 24, 32, 48 and 64: commands are
//! padded by NOP (0x50). `can.prefix` of the controller must be 0.
//!
//! After power-up a position is known within a turn of the shaft that the controller measures; then
//! the controller counts its turns itself. The shaft of the mapping is that one:
//! `motor_position.rotor_to_output_ratio` is 1.

use core::f32::consts::TAU;

use embedded_can::{ExtendedId, Frame};

use super::frame::{self, CanError};
use super::joint::{CanJoint, Report};
use super::turns::ShaftTurns;
use crate::{EncoderMapping, MappingError};

mod multiplex;

use multiplex::{NOP, Registers};

const MODE: u32 = 0x000;
const POSITION: u32 = 0x001;
const VELOCITY: u32 = 0x002;
const TORQUE: u32 = 0x003;
const FAULT: u32 = 0x00f;
/// Reads mode as int8, position, velocity and torque as f32, and the fault as int8.
const QUERY: [u8; 6] = [0x11, 0x00, 0x1f, 0x01, 0x11, 0x0f];

/// The mode of a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Mode {
    /// No power to the motor; faults are cleared.
    Stopped,
    /// No power to the motor until it was stopped, because of [`ControllerState::fault`].
    Fault,
    /// The mode in which torque is commanded.
    Position,
    /// No command came for the time of the watchdog.
    Timeout,
    /// Another mode, by its number.
    Other(u8),
}

/// The reply of a controller, mapped to the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerState {
    /// The mode of the controller.
    pub mode: Mode,
    /// The position of the joint, rad.
    pub position: f32,
    /// The velocity of the joint, rad/s.
    pub velocity: f32,
    /// The torque of the joint, N·m.
    pub torque: f32,
    /// The fault code, 32 and above in [`Mode::Fault`]; in other modes 96 and above name what
    /// limits the output, and 0 is nothing.
    pub fault: u8,
}

/// One joint's moteus controller.
///
/// ```
/// use embedded_can::{ExtendedId, Frame};
/// use joint_drivers::{JointMapping, JointRange, can::FdFrame, moteus::{Mode, Moteus}};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Continuous, 5e-3)?;
/// let mut joint = Moteus::new(1, 0, 10.0, mapping)?;
/// let command: FdFrame = joint.set_torque(-0.25)?;
/// assert_eq!(command.data().len(), 24);
/// // The reply of the protocol's own example.
/// let data = [0x24, 4, 0, 0x0a, 0, 0x50, 0, 0, 1, 0x70, 0xff, 0x23, 0x0d, 0x18, 0x14, 0];
/// let state = joint.reply(&FdFrame::new(ExtendedId::new(0x100).unwrap(), &data).unwrap())?;
/// assert_eq!((state.mode, state.fault), (Mode::Position, 0));
/// assert!((state.position.to_degrees() - 2.88).abs() < 1e-5 && (state.torque + 1.44).abs() < 1e-6);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moteus {
    id: u8,
    host: u8,
    most: f32,
    turns: ShaftTurns,
}

impl Moteus {
    /// The controller `id`, 1 to 127, that replies to the host `host`, 0 to 127, and delivers at
    /// most `most` N·m at the joint.
    ///
    /// # Errors
    /// [`CanError::Node`], [`CanError::Torque`].
    pub fn new(id: u8, host: u8, most: f32, mapping: EncoderMapping) -> Result<Self, CanError> {
        if id == 0 || id > 127 || host > 127 {
            return Err(CanError::Node);
        }
        frame::check_most(most, mapping.mapping())?;
        Ok(Self { id, host, most, turns: ShaftTurns::in_turns(mapping) })
    }

    /// Takes the joint to be at `position` rad or m: the next reply is within half a turn of the
    /// shaft from there.
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    pub fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.turns.place_near(position)
    }

    /// Notes this many ticks without a reply: the controller may have lost its supply, and its turns.
    pub fn missed(&mut self, ticks: u32) {
        self.turns.missed(ticks);
    }

    /// A torque in N·m at the joint, limited to the greatest, and a query of the state; NaN becomes
    /// zero torque.
    ///
    /// Position mode with the scales of the gains kp and kd at 0, and the torque as feed-forward.
    /// The integral gain `servo.pid_position.ki`, which these scales leave as it is, must be
    /// configured as 0. Without a further command the controller enters [`Mode::Timeout`] after the
    /// time that it is configured with.
    ///
    /// # Errors
    /// [`CanError::Length`]: the frame type is not CAN FD.
    pub fn set_torque<F: Frame>(&self, torque: f32) -> Result<F, CanError> {
        let torque = frame::limit(torque, self.most);
        let at_shaft = self.turns.mapping.mapping().shaft_torque(torque);
        let [t0, t1, t2, t3] = at_shaft.map_err(|_| CanError::NotFinite)?.to_le_bytes();
        let [q0, q1, q2, q3, q4, q5] = QUERY;
        self.frame(&[
            // int8: mode = 10, position.
            0x01, 0x00, 10, //
            // int8: position command = −128, "the present one"; velocity command = 0.
            0x02, 0x20, 0x80, 0, //
            // f32: feed-forward torque.
            0x0d, 0x22, t0, t1, t2, t3, //
            // int8: scales of kp and kd = 0.
            0x02, 0x23, 0, 0, //
            q0, q1, q2, q3, q4, q5, NOP,
        ])
    }

    /// Stops the controller, which takes the power from the motor and clears faults, and queries
    /// the state.
    ///
    /// # Errors
    /// [`CanError::Length`]: the frame type is not CAN FD.
    pub fn stop<F: Frame>(&self) -> Result<F, CanError> {
        let [q0, q1, q2, q3, q4, q5] = QUERY;
        self.frame(&[0x01, 0x00, 0, q0, q1, q2, q3, q4, q5, NOP, NOP, NOP])
    }

    /// Queries the state without a command. The query alone fits into a frame of classic CAN; its
    /// reply does not.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn query<F: Frame>(&self) -> Result<F, CanError> {
        self.frame(&QUERY)
    }

    /// The state in a reply, mapped to the joint; registers may have any of the four types and any
    /// order. In the first one the joint is where the mapping says that it can be.
    ///
    /// # Errors
    /// [`CanError`]: another node or host, a remote frame, a frame that is short or has an unknown
    /// subframe, a register that was refused or is missing, a quantity that is not finite.
    pub fn reply<F: Frame>(&mut self, frame: &F) -> Result<ControllerState, CanError> {
        if frame::raw(frame.id()) != u32::from(self.id) << 8 | u32::from(self.host) {
            return Err(CanError::Identifier);
        }
        if frame.is_remote_frame() {
            return Err(CanError::Remote);
        }
        self.state(&Registers::of_reply(frame.data())?)
    }

    fn state(&mut self, registers: &Registers) -> Result<ControllerState, CanError> {
        let not_finite = |_| CanError::NotFinite;
        let of = |value: Option<f32>, register| value.ok_or(CanError::Missing(register));
        let turns = of(registers.position, POSITION)?;
        let per_second = of(registers.velocity, VELOCITY)?;
        let torque = of(registers.torque, TORQUE)?;
        let mode = match number(of(registers.mode, MODE)?)? {
            0 => Mode::Stopped,
            1 => Mode::Fault,
            10 => Mode::Position,
            11 => Mode::Timeout,
            other => Mode::Other(other),
        };
        let [position, _] = self.turns.follow(turns)?;
        let mapping = self.turns.mapping.mapping();
        Ok(ControllerState {
            mode,
            position,
            velocity: mapping.velocity(per_second * TAU).map_err(not_finite)?,
            torque: mapping.torque(torque).map_err(not_finite)?,
            fault: number(of(registers.fault, FAULT)?)?,
        })
    }

    /// A frame to the controller that requests a reply.
    fn frame<F: Frame>(&self, data: &[u8]) -> Result<F, CanError> {
        let id = 0x8000 | u32::from(self.host) << 8 | u32::from(self.id);
        frame::frame(ExtendedId::new(id).ok_or(CanError::Node)?, data)
    }
}

impl CanJoint for Moteus {
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
        self.stop()
    }

    fn report<F: Frame>(&mut self, frame: &F) -> Result<Report, CanError> {
        let state = self.reply(frame)?;
        Ok(Report {
            position: Some(state.position),
            delivers: Some(match state.mode {
                Mode::Position => Ok(()),
                Mode::Fault => Err(CanError::Fault(state.fault.into())),
                _ => Err(CanError::NotReady),
            }),
        })
    }
}

/// A small whole number, as modes and fault codes are in all types.
fn number(value: f32) -> Result<u8, CanError> {
    let number = value as u8;
    if f32::from(number) == value { Ok(number) } else { Err(CanError::Unknown(number)) }
}
