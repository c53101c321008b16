//! A magnetic 14-bit angle encoder of the AS5047P type on SPI.
//!
//! ams OSRAM, AS5047P data sheet (2016), figures 13 to 18: 16-bit frames, mode 1, bit 15 of each
//! makes its parity even, bit 14 of a command reads, bit 14 of an answer reports an error.

use core::f32::consts::TAU;

use dynamics_core::control::TurnCounter;
use embedded_hal::spi::SpiDevice;

/// Counts per turn.
pub const COUNTS: u16 = 1 << BITS;
const BITS: u32 = 14;
const MASK: u16 = COUNTS - 1;
/// Read ANGLECOM (0x3FFF): the angle with the encoder's own dynamic error compensation.
const READ_ANGLE: u16 = with_parity(READ | 0x3fff);
const READ: u16 = 1 << 14;
const ERROR: u16 = 1 << 14;

/// Why a frame holds no angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameError {
    /// The bus reported an error.
    Bus,
    /// The frame's parity is odd.
    Parity,
    /// The encoder reports an error of the frame before.
    Flag,
}

/// One joint's encoder: counts, direction and zero are those of the joint.
#[derive(Debug)]
pub struct Encoder<Spi> {
    spi: Spi,
    turns: TurnCounter<BITS>,
}

impl<Spi: SpiDevice> Encoder<Spi> {
    /// An encoder that has not been read yet; its first angle lies within half a turn of zero.
    pub fn new(spi: Spi) -> Self {
        Self {
            spi,
            turns: TurnCounter::new(),
        }
    }

    /// The joint's angle in rad, turns included.
    ///
    /// The frame answers the command of the read before: the angle is that of the chip select
    /// that ended it, one tick ago at most.
    ///
    /// # Errors
    /// [`FrameError`]; the count of turns is then as it was.
    #[inline(always)]
    pub fn read(&mut self) -> Result<f32, FrameError> {
        let mut frame = READ_ANGLE.to_be_bytes();
        self.spi
            .transfer_in_place(&mut frame)
            .map_err(|_| FrameError::Bus)?;
        let raw = decode(u16::from_be_bytes(frame))?;
        self.turns.update(raw);
        Ok(self.turns.angle())
    }
}

/// The 14-bit angle in an answer.
///
/// # Errors
/// Odd parity, or the encoder's error flag.
///
/// ```
/// use firmware_demo::encoder::{FrameError, decode, encode};
/// assert_eq!(decode(encode(8191)), Ok(8191));
/// assert_eq!(decode(encode(8191) ^ 1), Err(FrameError::Parity));
/// ```
#[inline(always)]
pub fn decode(frame: u16) -> Result<u16, FrameError> {
    if !frame.count_ones().is_multiple_of(2) {
        return Err(FrameError::Parity);
    }
    if frame & ERROR != 0 {
        return Err(FrameError::Flag);
    }
    Ok(frame & MASK)
}

/// The answer that holds a 14-bit angle: what a simulated encoder sends.
pub const fn encode(raw: u16) -> u16 {
    with_parity(raw & MASK)
}

/// The raw count nearest to an angle in rad.
pub fn quantise(angle: f32) -> u16 {
    let counts = angle * (f32::from(COUNTS) / TAU);
    let nearest = if counts < 0.0 {
        counts - 0.5
    } else {
        counts + 0.5
    };
    (nearest as i32 & i32::from(MASK)) as u16
}

const fn with_parity(frame: u16) -> u16 {
    let low = frame & 0x7fff;
    low | ((low.count_ones() as u16 & 1) << 15)
}
