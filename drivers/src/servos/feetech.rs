//! STS3215 and its relatives: servos on Feetech's half-duplex serial bus, six of which move the
//! SO-101.
//!
//! # Source
//! Feetech, "Communication Protocol User Manual", sections 1.1 to 1.3 (packets, instructions,
//! examples 1 to 8), and "Magnetic encoder STS servo, memory table", in public copies; the signs of
//! position (bit 15) and duty (bit 10) also in Feetech's SCServo SDK (`SMS_STS.cpp`). Addresses:
//! mode 0x21, torque enable 0x28, goal position 0x2A, goal duty 0x2C (in the position mode the time
//! of the motion), present position 0x38. Low byte first; 4096 counts per turn.
//!
//! The duties need the servos in mode 2, PWM; the positions in mode 0. The mode is in the EPROM:
//! set it with Feetech's tool, or by [`Servos::write`]. In mode 0 a servo of one turn goes from its
//! count to its goal without passing from 4095 to 0: a goal on the other side of that seam is
//! refused. A range with the seam in it needs another offset (address 0x1F) of the servo, or its
//! multi-turn form ([`Servos::with_turns`]). The register of speed is not read: its unit depends on
//! a setting of the servo, and a controller's observer estimates the velocity from positions.
//!
//! At 1 Mbit/s, reading the positions of six servos takes 62 bytes, 0.62 ms, and setting six duties
//! 26 bytes, 0.26 ms, without the pauses before the replies: a control loop of 500 Hz has room for
//! both, one of 1 kHz does not.

use embedded_io::{Read, ReadReady, Write};
use motion_control::{limits::Fault, motion::CurrentTick};

use crate::encoder_mapping::floor;
use crate::{
    EncoderMapping, EncoderType, JointEncoders, JointError, JointRange, LostTurn, MappingError,
    MultiTurnEncoder,
};

#[cfg(feature = "async")]
mod asynch;
mod error;
mod packet;
mod reply;

pub use error::FeetechError;
use error::port_error;
pub use packet::{BROADCAST, Packet, Parser, Reply};
use reply::{next_reply, parameters};

/// The number of counts in a turn of the shaft.
pub const COUNTS: u16 = 1 << BITS;
const BITS: u32 = 12;
/// The address of the torque switch: 1 on, 0 off.
pub const TORQUE_ENABLE: u8 = 0x28;
/// The address of the goal position.
pub const GOAL_POSITION: u8 = 0x2a;
/// The address of the goal duty.
pub const GOAL_DUTY: u8 = 0x2c;
/// The address of the present position.
pub const PRESENT_POSITION: u8 = 0x38;
/// A position below zero, and the greatest position of a servo in its multi-turn form.
const POSITION_SIGN: u16 = 1 << 15;
const MOST_COUNTS: f32 = 32_767.0;
/// A duty below zero, and the greatest duty, in thousandths.
const DUTY_SIGN: u16 = 1 << 10;
const FULL_DUTY: f32 = 1000.0;
/// The most bytes that are skipped in search of a reply.
const MOST_NOISE: usize = 64;

/// The servos of `N` joints on one port.
///
/// The port returns an error or zero bytes if none comes within its time limit, which is at least
/// the servos' return delay: without a limit a servo that is unplugged blocks the caller for ever.
/// By [`ReadReady`] replies that came too late for an earlier request are found and dropped.
///
/// ```
/// # use embedded_io::{ErrorType, Read, ReadReady, Write};
/// # struct Uart(&'static [u8], Vec<u8>);
/// # impl ErrorType for Uart { type Error = core::convert::Infallible; }
/// # impl Read for Uart {
/// #     fn read(&mut self, into: &mut [u8]) -> Result<usize, Self::Error> { self.0.read(into) }
/// # }
/// # impl ReadReady for Uart { fn read_ready(&mut self) -> Result<bool, Self::Error> { Ok(false) } }
/// # impl Write for Uart {
/// #     fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> { self.1.extend(bytes); Ok(bytes.len()) }
/// #     fn flush(&mut self) -> Result<(), Self::Error> { Ok(()) }
/// # }
/// use joint_drivers::{Direction, JointMapping, JointRange, feetech::Servos};
/// // The joint is at zero in the middle of the servo's turn.
/// let middle = JointMapping::new(core::f32::consts::PI, Direction::Forward, 1.0)?;
/// let middle = middle.with_range(JointRange::Within { lower: -2.0, upper: 2.0 }, 5.0 * 2e-3)?;
/// # let uart = Uart(&[0xff, 0xff, 1, 4, 0, 0, 0x0c, 0xee, 0xff, 0xff, 2, 4, 0, 0, 0x08, 0xf1], Vec::new());
/// let mut servos = Servos::new(uart, [1, 2], [middle; 2])?;
/// let [first, second] = servos.positions()?; // counts 3072 and 2048
/// assert!((first - core::f32::consts::FRAC_PI_2).abs() < 1e-6 && second.abs() < 1e-6);
/// servos.set_duties(&[0.1, -0.1])?;
/// assert!(servos.release().1.ends_with(&[0x83, 0x2c, 2, 1, 100, 0, 2, 100, 4, 0x77]));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Servos<Port, const N: usize> {
    port: Port,
    has_echo: bool,
    has_turns: bool,
    ids: [u8; N],
    mappings: [EncoderMapping; N],
    counters: [MultiTurnEncoder<BITS>; N],
    /// The counts that each servo's own count lacks to that of its counter, since it replied.
    offsets: [Option<i32>; N],
}

impl<Port, const N: usize> Servos<Port, N> {
    /// The servos `ids`, 0 to 253, each with the mapping from its 0 rad (count 0) to its joint; the
    /// first position of each is where its mapping says that the joint can be.
    ///
    /// # Errors
    /// [`FeetechError::Id`].
    pub fn new(
        port: Port,
        ids: [u8; N],
        mappings: [EncoderMapping; N],
    ) -> Result<Self, FeetechError> {
        for (place, id) in ids.iter().enumerate() {
            if *id >= BROADCAST || ids.iter().take(place).any(|other| other == id) {
                return Err(FeetechError::Id(*id));
            }
        }
        Ok(Self {
            port,
            has_echo: false,
            has_turns: false,
            ids,
            mappings,
            counters: mappings.map(MultiTurnEncoder::new),
            offsets: [None; N],
        })
    }

    /// The same servos on a port that receives what it sends, as on one wire without a switch.
    pub fn with_echo(mut self) -> Self {
        self.has_echo = true;
        self
    }

    /// The same servos in their multi-turn form, with both angle limits at 0: a goal is within
    /// ±32,767 counts instead of one turn.
    pub fn with_turns(mut self) -> Self {
        self.has_turns = true;
        self
    }

    /// As [`MultiTurnEncoder::place_near`], of the joint at a place, and nothing for one that there
    /// is not.
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    pub fn place_near(&mut self, joint: usize, position: f32) -> Result<(), MappingError> {
        let joints = self.counters.iter_mut().zip(&mut self.offsets);
        if let Some((counter, offset)) = joints.into_iter().nth(joint) {
            counter.place_near(position)?;
            *offset = None;
        }
        Ok(())
    }

    /// Returns the port to its owner.
    pub fn release(self) -> Port {
        self.port
    }

    fn request(&self) -> Result<Packet, FeetechError> {
        Packet::sync_read(&self.ids, PRESENT_POSITION, 2)
    }

    /// The position of a joint from the register of its servo, rad.
    fn position(&mut self, joint: usize, register: [u8; 2]) -> Result<f32, FeetechError> {
        let counts = from_sign(u16::from_le_bytes(register), POSITION_SIGN);
        let counter = &mut self.counters[joint];
        self.offsets[joint] = None;
        let update = counter.update(counts as u16);
        update.map_err(|LostTurn| FeetechError::LostTurn { joint })?;
        self.offsets[joint] = Some(counter.counts().wrapping_sub(i32::from(counts)));
        Ok(counter.position())
    }

    /// Takes what the exchange of a joint brought: of the joints from a failed one on there is no
    /// reading.
    fn accept(
        &mut self,
        joint: usize,
        register: Result<[u8; 2], FeetechError>,
    ) -> Result<f32, JointError<FeetechError>> {
        let position = register.and_then(|register| self.position(joint, register));
        position.map_err(|error| {
            let from = match error {
                FeetechError::LostTurn { .. } => joint + 1,
                _ => joint,
            };
            let unread = self.counters.iter_mut().skip(from);
            unread.for_each(|counter| counter.missed(1));
            JointError { joint, error }
        })
    }

    fn goal_positions(&self, positions: &[f32; N]) -> Result<Packet, FeetechError> {
        let (least, most) =
            if self.has_turns { (-MOST_COUNTS, MOST_COUNTS) } else { (0.0, f32::from(COUNTS - 1)) };
        let mut goals = [0; N];
        for (joint, goal) in goals.iter_mut().enumerate() {
            let offset = self.offset(joint, positions[joint]);
            let offset = offset.ok_or(FeetechError::Goal { joint })?;
            let exact = self.counters[joint].count_at(positions[joint]) - offset as f32;
            // NaN is in no range.
            if !(exact > least - 0.5 && exact < most + 0.5) {
                return Err(FeetechError::Goal { joint });
            }
            *goal = to_sign(exact, POSITION_SIGN);
        }
        self.goals(GOAL_POSITION, goals)
    }

    /// The counts that the servo's own count lacks to that of its counter for a goal: since its
    /// last reply, or before it if the whole range of the joint is within one turn of the servo.
    fn offset(&self, joint: usize, goal: f32) -> Option<i32> {
        let counter = &self.counters[joint];
        let turns = |position| floor(counter.count_at(position) + 0.5) & !i32::from(COUNTS - 1);
        match (self.mappings[joint].range(), self.offsets[joint]) {
            // Either way round a circle leads to the goal.
            (JointRange::Continuous, _) if !self.has_turns => Some(turns(goal)),
            (JointRange::Within { lower, upper }, None) if !self.has_turns => {
                (turns(lower) == turns(upper)).then_some(turns(lower))
            }
            (_, offset) => offset,
        }
    }

    fn goal_duties(&self, duties: &[f32; N]) -> Result<Packet, FeetechError> {
        let mut goals = [0; N];
        for (joint, goal) in goals.iter_mut().enumerate() {
            let sign = self.mappings[joint].mapping().direction().sign();
            let duty = sign * duties[joint] * FULL_DUTY;
            *goal = to_sign(duty.clamp(-FULL_DUTY, FULL_DUTY), DUTY_SIGN);
        }
        self.goals(GOAL_DUTY, goals)
    }

    fn goals(&self, address: u8, goals: [u16; N]) -> Result<Packet, FeetechError> {
        let each = self.ids.into_iter().zip(goals.map(u16::to_le_bytes));
        Packet::sync_write(address, each)
    }
}

impl<Port: Read + Write + ReadReady, const N: usize> Servos<Port, N> {
    /// The positions of the joints in rad, in one exchange.
    ///
    /// # Errors
    /// [`FeetechError`] of the first servo that did not reply as it should.
    pub fn positions(&mut self) -> Result<[f32; N], FeetechError> {
        self.read_all().map_err(|failed| failed.error)
    }

    /// The positions, or the joint whose servo did not reply; the first if the request could not be
    /// sent.
    fn read_all(&mut self) -> Result<[f32; N], JointError<FeetechError>> {
        let mut sent = self.request().and_then(|request| self.send(&request));
        let mut positions = [0.0; N];
        let mut parser = Parser::new();
        for (joint, position) in positions.iter_mut().enumerate() {
            let register = match core::mem::replace(&mut sent, Ok(())) {
                Ok(()) => self.receive(self.ids[joint], &mut parser),
                Err(error) => Err(error),
            };
            *position = self.accept(joint, register)?;
        }
        Ok(positions)
    }

    /// Sets the goal positions of the joints in rad, in one packet that no servo replies to.
    ///
    /// # Errors
    /// [`FeetechError`]; nothing is sent after [`FeetechError::Goal`].
    pub fn set_positions(&mut self, positions: &[f32; N]) -> Result<(), FeetechError> {
        self.send(&self.goal_positions(positions)?)
    }

    /// Sets the duties of the joints, −1 to 1, in one packet that no servo replies to. NaN becomes
    /// zero duty.
    ///
    /// Only the mapping's direction applies: a duty is a share of the supply's voltage.
    ///
    /// # Errors
    /// [`FeetechError`].
    pub fn set_duties(&mut self, duties: &[f32; N]) -> Result<(), FeetechError> {
        self.send(&self.goal_duties(duties)?)
    }

    /// Switches the torque of all servos on or off, one after the other: each confirms it.
    ///
    /// # Errors
    /// [`FeetechError`] of the first servo that did not; to switch off, the others are tried
    /// nevertheless.
    pub fn enable_torque(&mut self, is_on: bool) -> Result<(), FeetechError> {
        let mut result = Ok(());
        for joint in 0..N {
            result = result.and(self.write(self.ids[joint], TORQUE_ENABLE, &[is_on.into()]));
            if is_on {
                result?;
            }
        }
        result
    }

    /// Writes bytes from an address on, and waits for the servo's confirmation.
    ///
    /// # Errors
    /// [`FeetechError`].
    pub fn write(&mut self, id: u8, address: u8, data: &[u8]) -> Result<(), FeetechError> {
        self.send(&Packet::write(id, address, data)?)?;
        self.receive::<0>(id, &mut Parser::new()).map(|[]| ())
    }

    /// Reads `L` bytes from an address on.
    ///
    /// # Errors
    /// [`FeetechError`].
    pub fn read<const L: usize>(&mut self, id: u8, address: u8) -> Result<[u8; L], FeetechError> {
        let length = u8::try_from(L).map_err(|_| FeetechError::TooLong)?;
        self.send(&Packet::read(id, address, length)?)?;
        self.receive(id, &mut Parser::new())
    }

    /// Sends a packet, after bytes that came too late for an earlier one were dropped.
    fn send(&mut self, packet: &Packet) -> Result<(), FeetechError> {
        for _ in 0..MOST_NOISE {
            if !self.port.read_ready().map_err(port_error)? || self.byte()?.is_none() {
                break;
            }
        }
        self.port.write_all(packet.bytes()).map_err(port_error)?;
        self.port.flush().map_err(port_error)?;
        if self.has_echo {
            for sent in packet.bytes() {
                if self.byte()? != Some(*sent) {
                    return Err(FeetechError::Echo);
                }
            }
        }
        Ok(())
    }

    /// The parameters of the next reply.
    fn receive<const L: usize>(
        &mut self,
        id: u8,
        parser: &mut Parser,
    ) -> Result<[u8; L], FeetechError> {
        loop {
            if let Some(reply) = next_reply(self.byte(), parser, id)? {
                return parameters(&reply, id);
            }
        }
    }

    fn byte(&mut self) -> Result<Option<u8>, FeetechError> {
        let mut byte = [0];
        let read = self.port.read(&mut byte).map_err(port_error)?;
        Ok((read > 0).then_some(byte[0]))
    }
}

impl<Port, const N: usize> EncoderType for Servos<Port, N> {
    type Error = FeetechError;
    type Age = CurrentTick;

    fn missed(&mut self, ticks: u32) {
        self.counters.iter_mut().for_each(|counter| counter.missed(ticks));
    }

    fn fault(error: &FeetechError, joint: usize) -> Fault {
        match error {
            FeetechError::LostTurn { .. } => Fault::LostTurn { joint },
            _ => Fault::Encoder { joint },
        }
    }
}

/// No reading of the servos that come after one that did not reply.
impl<Port: Read + Write + ReadReady, const N: usize> JointEncoders<N> for Servos<Port, N> {
    fn start(&mut self) {}

    fn read(&mut self) -> Result<[f32; N], JointError<FeetechError>> {
        self.read_all()
    }
}

/// A number whose sign is one bit above its magnitude.
fn from_sign(bits: u16, sign: u16) -> i16 {
    let magnitude = (bits & (sign - 1)) as i16;
    if bits & sign == 0 { magnitude } else { -magnitude }
}

/// The nearest number, as sign and magnitude; 0 for NaN.
fn to_sign(value: f32, sign: u16) -> u16 {
    let magnitude = (value.abs() + 0.5) as u16;
    if value < 0.0 && magnitude != 0 { magnitude | sign } else { magnitude }
}
