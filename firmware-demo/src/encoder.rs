//! A magnetic 14-bit angle encoder of the AS5047P type on SPI.
//!
//! ams OSRAM, AS5047P data sheet (2016), figures 13 to 18: 16-bit frames, mode 1, bit 15 of each
//! makes its parity even, bit 14 of a command reads, bit 14 of an answer reports an error.
//!
//! A frame answers the command of the frame before, with the angle latched when that one ended. One frame a tick is
//! read, and the angle is one tick old: the observer extrapolates by one tick
//! ([`dynamics_core::control::Observer::update_delayed`]), which costs no transfers. A second frame for the present
//! angle would cost six transfers per tick on the bus, 10 µs and more at the 10 MHz that the part supports.

use core::f32::consts::TAU;
use core::fmt;

use dynamics_core::control::MultiTurnEncoder;
use embedded_hal::spi::{Error, ErrorKind, SpiDevice};

/// Counts per turn.
pub const COUNTS: u16 = 1 << BITS;
/// The angle of one count, rad.
pub const RESOLUTION: f32 = TAU / COUNTS as f32;
const BITS: u32 = 14;
const MASK: u16 = COUNTS - 1;
/// Read ANGLECOM (0x3FFF): the angle with the encoder's own dynamic error compensation.
pub(crate) const READ_ANGLE: u16 = with_parity(READ | 0x3fff);
/// Read ERRFL (0x0001), which clears it.
pub(crate) const READ_ERRORS: u16 = with_parity(READ | 0x0001);
const READ: u16 = 1 << 14;
pub(crate) const ERROR: u16 = 1 << ERROR_BIT;
const ERROR_BIT: u32 = 14;

/// The reason why a frame contains no angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameError {
    /// The bus reported an error.
    Bus(ErrorKind),
    /// The frame's parity is odd.
    Parity,
    /// The encoder reports an error of the previous frame.
    Flag,
}

impl fmt::Display for FrameError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(kind) => write!(out, "the encoder's bus failed: {kind}"),
            Self::Parity => out.write_str("the parity of the encoder's frame is odd"),
            Self::Flag => out.write_str("the encoder reports an error of the frame before"),
        }
    }
}

impl core::error::Error for FrameError {}

/// One joint's encoder: counts, direction and zero are those of the joint.
#[derive(Debug)]
pub struct Encoder<Spi> {
    spi: Spi,
    turns: MultiTurnEncoder<BITS>,
}

impl<Spi: SpiDevice> Encoder<Spi> {
    /// An encoder that has not been read yet; its first angle lies within half a turn of zero.
    pub fn new(spi: Spi) -> Self {
        Self {
            spi,
            turns: MultiTurnEncoder::new(),
        }
    }

    /// Makes the next answer an angle: clears the encoder's error flags, requests the angle, and drops both answers,
    /// which belong to earlier commands.
    ///
    /// Without it the first answer after power-up is undefined. Errors are reported by [`Self::read`].
    #[cold]
    pub fn start(&mut self) {
        for command in [READ_ERRORS, READ_ANGLE] {
            let _ = self.spi.transfer_in_place(&mut command.to_be_bytes());
        }
    }

    /// The joint's angle in rad, over all turns, at the end of the previous frame, one tick ago.
    ///
    /// After an error the encoder is restarted at once, with two more frames, so that every error costs one angle.
    ///
    /// # Errors
    /// [`FrameError`]; the count of turns is then unchanged.
    #[inline(always)]
    pub fn read(&mut self) -> Result<f32, FrameError> {
        let mut frame = READ_ANGLE.to_be_bytes();
        let sent = self.spi.transfer_in_place(&mut frame);
        let answer = match sent {
            Ok(()) => decode(u16::from_be_bytes(frame)),
            Err(error) => Err(FrameError::Bus(error.kind())),
        };
        match answer {
            Ok(raw) => {
                self.turns.update(raw);
                Ok(self.turns.angle())
            }
            Err(error) => {
                self.start();
                Err(error)
            }
        }
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
    // One branch for both, which almost no frame takes.
    if (parity(frame) | frame >> ERROR_BIT) & 1 == 0 {
        return Ok(frame & MASK);
    }
    Err(if parity(frame) & 1 != 0 {
        FrameError::Parity
    } else {
        FrameError::Flag
    })
}

/// The answer with a 14-bit angle, as sent by a simulated encoder.
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

/// A 15-bit frame with the bit that makes its parity even.
pub(crate) const fn with_parity(frame: u16) -> u16 {
    let low = frame & 0x7fff;
    low | (parity(low) << 15)
}

/// A frame's parity in bit 0, odd for 1: folded, since the part has no instruction that counts bits.
#[inline(always)]
const fn parity(frame: u16) -> u16 {
    let byte = frame ^ (frame >> 8);
    let digit = byte ^ (byte >> 4);
    let pair = digit ^ (digit >> 2);
    pair ^ (pair >> 1)
}
