//! AS5600: a magnetic absolute encoder of 12 bits on I²C.
//!
//! # Source
//! ams, AS5600 data sheet v1-06 (2018-06-20): device address 0x36 (section "I²C Interface"),
//! registers RAW ANGLE 0x0C/0x0D and STATUS 0x0B (figure 21, register map), bits MD, ML and MH of
//! STATUS (figures 21 and 23).
//!
//! RAW ANGLE covers one turn whatever start, stop and range are programmed. The two registers are
//! read in two transfers: the data sheet does not say whether the address pointer stops at the high
//! byte of RAW ANGLE if it came there by itself (section "Automatic Increment of the Address
//! Pointer").
//!
//! I²C has no checksum: a bit that is wrong on the bus is not detected, except all ones, which no
//! STATUS has.

use core::fmt;

use embedded_hal::i2c::{Error, ErrorKind, I2c};
use motion_control::{limits::Fault, motion::CurrentTick};

use super::multi_turn::MultiTurnEncoder;
use crate::{EncoderMapping, EncoderType, JointEncoder, LostTurn, MappingError};

/// The 7-bit address of the device, which cannot be changed.
pub const ADDRESS: u8 = 0x36;
/// The register STATUS.
pub const STATUS: u8 = 0x0b;
/// The high byte of the register RAW ANGLE.
pub const RAW_ANGLE: u8 = 0x0c;
/// The number of counts in a turn of the shaft.
pub const COUNTS: u16 = 1 << BITS;
const BITS: u32 = 12;

/// STATUS: the gain is at its minimum, the magnet too strong.
const MH: u8 = 1 << 3;
/// STATUS: the gain is at its maximum, the magnet too weak.
const ML: u8 = 1 << 4;
/// STATUS: a magnet was detected.
const MD: u8 = 1 << 5;

/// The reason why there is no angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum As5600Error {
    /// The bus reported an error.
    Bus(ErrorKind),
    /// The encoder has detected no magnet.
    MagnetAbsent,
    /// The magnet is too weak or too far away.
    MagnetTooWeak,
    /// The magnet is too strong or too near.
    MagnetTooStrong,
    /// The status is impossible, too weak and too strong: the bytes are not those of an AS5600.
    Status(u8),
    /// The count does not say where the joint is, until [`As5600::place_near`].
    LostTurn,
}

impl fmt::Display for As5600Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(kind) => write!(out, "the encoder's bus failed: {kind}"),
            Self::MagnetAbsent => out.write_str("the encoder detects no magnet"),
            Self::MagnetTooWeak => out.write_str("the encoder's magnet is too weak"),
            Self::MagnetTooStrong => out.write_str("the encoder's magnet is too strong"),
            Self::Status(status) => write!(out, "the encoder's status {status:#04x} is impossible"),
            Self::LostTurn => LostTurn.fmt(out),
        }
    }
}

impl core::error::Error for As5600Error {}

/// One joint's AS5600.
///
/// ```
/// use embedded_hal_mock::eh1::i2c::{Mock, Transaction};
/// use joint_drivers::{JointMapping, JointRange, as5600::{As5600, As5600Error}};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Continuous, 5e-3)?;
/// let bus = Mock::new(&[Transaction::write_read(0x36, vec![0x0b], vec![0x30])]);
/// let mut encoder = As5600::new(bus, mapping);
/// assert_eq!(encoder.read(), Err(As5600Error::MagnetTooWeak));
/// encoder.release().done();
/// # Ok::<(), joint_drivers::MappingError>(())
/// ```
#[derive(Debug)]
pub struct As5600<Bus> {
    pub(crate) bus: Bus,
    pub(crate) turns: MultiTurnEncoder<BITS>,
}

impl<Bus> As5600<Bus> {
    /// An encoder that has not been read yet; the first angle is where the mapping says that the
    /// joint can be.
    pub const fn new(bus: Bus, mapping: EncoderMapping) -> Self {
        Self { bus, turns: MultiTurnEncoder::new(mapping) }
    }

    /// The joint's angle in rad at the last reading.
    pub fn angle(&self) -> f32 {
        self.turns.position()
    }

    /// Sets the joint's turn, as [`MultiTurnEncoder::place_near`] does.
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    pub fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.turns.place_near(position)
    }

    /// Returns the bus to its owner.
    pub fn release(self) -> Bus {
        self.bus
    }

    /// Takes the two bytes of RAW ANGLE, of which the upper four bits are not part of the angle.
    pub(crate) fn accept<E: Error>(
        &mut self,
        read: Result<(), E>,
        bytes: [u8; 2],
    ) -> Result<f32, As5600Error> {
        if let Err(error) = read {
            self.turns.missed(1);
            return Err(bus_error(error));
        }
        let update = self.turns.update(u16::from_be_bytes(bytes));
        update.map_err(|LostTurn| As5600Error::LostTurn)?;
        Ok(self.angle())
    }
}

impl<Bus: I2c> As5600<Bus> {
    /// Whether the magnet is placed well.
    ///
    /// # Errors
    /// [`As5600Error`].
    pub fn check_magnet(&mut self) -> Result<(), As5600Error> {
        let mut status = [0];
        let read = self.bus.write_read(ADDRESS, &[STATUS], &mut status);
        read.map_err(bus_error)?;
        decode_status(status[0])
    }

    /// The joint's angle in rad without a check of the magnet: 5 bytes on the bus, 0.11 ms at 400
    /// kHz.
    ///
    /// # Errors
    /// [`As5600Error::Bus`], [`As5600Error::LostTurn`]; the count of turns is then unchanged.
    pub fn read_angle(&mut self) -> Result<f32, As5600Error> {
        let mut raw = [0; 2];
        let read = self.bus.write_read(ADDRESS, &[RAW_ANGLE], &mut raw);
        self.accept(read, raw)
    }

    /// The joint's angle in rad, after a check of the magnet: 9 bytes on the bus, 0.2 ms at 400
    /// kHz.
    ///
    /// # Errors
    /// [`As5600Error`]; the count of turns is then unchanged.
    pub fn read(&mut self) -> Result<f32, As5600Error> {
        let magnet = self.check_magnet();
        magnet.inspect_err(|_| self.turns.missed(1))?;
        self.read_angle()
    }
}

impl<Bus> EncoderType for As5600<Bus> {
    type Error = As5600Error;
    type Age = CurrentTick;

    fn missed(&mut self, ticks: u32) {
        self.turns.missed(ticks);
    }

    fn fault(error: &As5600Error, joint: usize) -> Fault {
        match error {
            As5600Error::LostTurn => Fault::LostTurn { joint },
            _ => Fault::Encoder { joint },
        }
    }
}

impl<Bus: I2c> JointEncoder for As5600<Bus> {
    fn sample(&mut self) -> Result<(), As5600Error> {
        self.read().map(|_| ())
    }

    fn position(&self) -> f32 {
        self.angle()
    }
}

/// The magnet's state according to the register STATUS.
///
/// # Errors
/// [`As5600Error`].
pub const fn decode_status(status: u8) -> Result<(), As5600Error> {
    match (status & MD != 0, status & ML != 0, status & MH != 0) {
        (_, true, true) => Err(As5600Error::Status(status)),
        (false, _, _) => Err(As5600Error::MagnetAbsent),
        (true, true, false) => Err(As5600Error::MagnetTooWeak),
        (true, false, true) => Err(As5600Error::MagnetTooStrong),
        (true, false, false) => Ok(()),
    }
}

pub(crate) fn bus_error<E: Error>(error: E) -> As5600Error {
    As5600Error::Bus(error.kind())
}
