//! AS5600: a magnetic absolute encoder of 12 bits on I²C.
//!
//! # Source
//! ams, AS5600 data sheet v1-06 (2018-06-20): device address 0x36 (section "I²C Interface"), registers RAW ANGLE
//! 0x0C/0x0D and STATUS 0x0B (figure 21, register map), bits MD, ML and MH of STATUS (figures 21 and 23).
//!
//! RAW ANGLE covers one turn whatever start, stop and range are programmed. The two registers are read in two
//! transfers: the data sheet does not say whether the address pointer stops at the high byte of RAW ANGLE if it came
//! there by itself (section "Automatic Increment of the Address Pointer").
//!
//! I²C has no checksum: a bit that is wrong on the bus is not detected, except all ones, which no STATUS has.

use core::fmt;

use embedded_hal::i2c::{Error, ErrorKind, I2c};
use motion_control::CurrentTick;

use crate::{EncoderType, JointEncoder, JointMapping, MultiTurnEncoder};

/// The 7-bit address of the device, which cannot be changed.
pub const ADDRESS: u8 = 0x36;
/// The register STATUS.
pub const STATUS: u8 = 0x0b;
/// The high byte of the register RAW ANGLE.
pub const RAW_ANGLE: u8 = 0x0c;
/// Counts per turn.
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
    /// No magnet was detected.
    MagnetAbsent,
    /// The magnet is too weak or too far away.
    MagnetTooWeak,
    /// The magnet is too strong or too near.
    MagnetTooStrong,
    /// The status is impossible, too weak and too strong: the bytes are not those of an AS5600.
    Status(u8),
}

impl fmt::Display for As5600Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(kind) => write!(out, "the encoder's bus failed: {kind}"),
            Self::MagnetAbsent => out.write_str("the encoder detects no magnet"),
            Self::MagnetTooWeak => out.write_str("the encoder's magnet is too weak"),
            Self::MagnetTooStrong => out.write_str("the encoder's magnet is too strong"),
            Self::Status(status) => write!(out, "the encoder's status {status:#04x} is impossible"),
        }
    }
}

impl core::error::Error for As5600Error {}

/// One joint's AS5600.
///
/// ```
/// use embedded_hal_mock::eh1::i2c::{Mock, Transaction};
/// use joint_drivers::{JointMapping, as5600::{As5600, As5600Error}};
/// let bus = Mock::new(&[Transaction::write_read(0x36, vec![0x0b], vec![0x30])]);
/// let mut encoder = As5600::new(bus, JointMapping::IDENTITY);
/// assert_eq!(encoder.read(), Err(As5600Error::MagnetTooWeak));
/// encoder.release().done();
/// ```
#[derive(Debug)]
pub struct As5600<Bus> {
    pub(crate) bus: Bus,
    turns: MultiTurnEncoder<BITS>,
    mapping: JointMapping,
}

impl<Bus> As5600<Bus> {
    /// An encoder that has not been read yet; the first angle of its shaft lies within half a turn of zero.
    pub const fn new(bus: Bus, mapping: JointMapping) -> Self {
        Self::near(bus, mapping, 0)
    }

    /// An encoder whose first angle lies within half a turn of `turns` whole turns of its shaft.
    pub const fn near(bus: Bus, mapping: JointMapping, turns: i32) -> Self {
        Self {
            bus,
            turns: MultiTurnEncoder::near(turns),
            mapping,
        }
    }

    /// The joint's angle in rad at the last reading.
    pub fn angle(&self) -> f32 {
        self.mapping.joint_position(self.turns.angle())
    }

    /// The bus.
    pub fn release(self) -> Bus {
        self.bus
    }

    /// Takes the two bytes of RAW ANGLE, of which the upper four bits are not part of the angle.
    pub(crate) fn accept(&mut self, bytes: [u8; 2]) -> f32 {
        self.turns.update(u16::from_be_bytes(bytes));
        self.angle()
    }
}

impl<Bus: I2c> As5600<Bus> {
    /// Whether the magnet is placed well.
    ///
    /// # Errors
    /// [`As5600Error`].
    pub fn check_magnet(&mut self) -> Result<(), As5600Error> {
        let mut status = [0];
        self.bus
            .write_read(ADDRESS, &[STATUS], &mut status)
            .map_err(bus_error)?;
        decode_status(status[0])
    }

    /// The joint's angle in rad without a check of the magnet: 5 bytes on the bus, 0.11 ms at 400 kHz.
    ///
    /// # Errors
    /// [`As5600Error::Bus`]; the count of turns is then unchanged.
    pub fn read_angle(&mut self) -> Result<f32, As5600Error> {
        let mut raw = [0; 2];
        self.bus
            .write_read(ADDRESS, &[RAW_ANGLE], &mut raw)
            .map_err(bus_error)?;
        Ok(self.accept(raw))
    }

    /// The joint's angle in rad, after a check of the magnet: 9 bytes on the bus, 0.2 ms at 400 kHz.
    ///
    /// # Errors
    /// [`As5600Error`]; the count of turns is then unchanged.
    pub fn read(&mut self) -> Result<f32, As5600Error> {
        self.check_magnet()?;
        self.read_angle()
    }
}

impl<Bus> EncoderType for As5600<Bus> {
    type Error = As5600Error;
    type Age = CurrentTick;
}

impl<Bus: I2c> JointEncoder for As5600<Bus> {
    fn sample(&mut self) -> Result<(), As5600Error> {
        self.read().map(|_| ())
    }

    fn position(&self) -> f32 {
        self.angle()
    }
}

/// What the register STATUS says of the magnet.
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
