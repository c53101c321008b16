//! AS5047P: a magnetic absolute encoder of 14 bits on SPI.
//!
//! # Source
//! ams OSRAM, AS5047P data sheet (2016), figures 13 to 18: 16-bit frames, SPI mode 1, bit 15 of
//! each makes its parity even, bit 14 of a command reads, bit 14 of an answer reports an error.
//!
//! A frame answers the command of the frame before, with the angle latched when that one ended. One
//! frame a tick is read, and the angle is one tick old: the observer extrapolates by one tick
//! ([`motion_control::estimate::Observer::update_delayed`]), which costs no transfers. A second
//! frame for the present angle would cost six transfers per tick on the bus of six joints, 10 µs
//! and more at the 10 MHz that the part supports.

use core::f32::consts::TAU;
use core::fmt;

use embedded_hal::spi::{Error, ErrorKind, SpiDevice};
use motion_control::{limits::Fault, motion::PreviousTick};

use super::multi_turn::{MultiTurnEncoder, PreviousCount};
use crate::{EncoderMapping, EncoderType, JointEncoder, LostTurn, MappingError};

/// The number of counts in a turn of the shaft.
pub const COUNTS: u16 = 1 << BITS;
/// The angle of one count, rad.
pub const RESOLUTION: f32 = TAU / COUNTS as f32;
const BITS: u32 = 14;
const MASK: u16 = COUNTS - 1;
/// The command that reads ANGLECOM (0x3FFF): the angle with the encoder's own dynamic error
/// compensation.
pub const READ_ANGLE: u16 = with_parity(READ | 0x3fff);
/// The command that reads ERRFL (0x0001), which clears it.
pub const READ_ERRORS: u16 = with_parity(READ | 0x0001);
const READ: u16 = 1 << 14;
/// The bit of an answer that reports an error of the frame before.
pub const ERROR: u16 = 1 << ERROR_BIT;
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
    /// The count does not say where the joint is, until [`As5047p::place_near`].
    LostTurn,
}

impl fmt::Display for FrameError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(kind) => write!(out, "the encoder's bus failed: {kind}"),
            Self::Parity => out.write_str("the parity of the encoder's frame is odd"),
            Self::Flag => out.write_str("the encoder reports an error of the frame before"),
            Self::LostTurn => LostTurn.fmt(out),
        }
    }
}

impl core::error::Error for FrameError {}

/// One joint's AS5047P.
///
/// ```
/// use embedded_hal_mock::eh1::spi::{Mock, Transaction};
/// use joint_drivers::{JointMapping, JointRange, as5047p::{As5047p, READ_ANGLE, encode}};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Continuous, 5e-3)?;
/// let (angle, answer) = (READ_ANGLE.to_be_bytes().to_vec(), encode(4096).to_be_bytes().to_vec());
/// let spi = Mock::new(&[
///     Transaction::transaction_start(),
///     Transaction::transfer_in_place(angle, answer),
///     Transaction::transaction_end(),
/// ]);
/// let mut encoder = As5047p::new(spi, mapping);
/// assert_eq!(encoder.read(), Ok(core::f32::consts::FRAC_PI_2));
/// encoder.release().done();
/// # Ok::<(), joint_drivers::MappingError>(())
/// ```
#[derive(Debug)]
pub struct As5047p<Spi> {
    pub(crate) spi: Spi,
    turns: MultiTurnEncoder<BITS>,
}

impl<Spi> As5047p<Spi> {
    /// An encoder that has not been read yet; the first angle is where the mapping says that the
    /// joint can be.
    pub const fn new(spi: Spi, mapping: EncoderMapping) -> Self {
        Self { spi, turns: MultiTurnEncoder::new(mapping) }
    }

    /// The joint's angle in rad at the last good frame.
    #[inline(always)]
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
    pub fn release(self) -> Spi {
        self.spi
    }

    /// Takes the angle of a frame, or says what was before one that is not the joint's. With
    /// [`Self::accept_otherwise`] the part that the blocking and the asynchronous form share.
    #[inline(always)]
    pub(crate) fn accept<E: Error>(
        &mut self,
        sent: &Result<(), E>,
        frame: [u8; 2],
    ) -> Result<(), PreviousCount> {
        let frame = u16::from_be_bytes(frame);
        // It is taken before it is examined: one branch for all checks, and both loads side by
        // side.
        let (before, missing) = self.turns.follow(frame);
        if sent.is_ok() && (u32::from(wrong(frame)) | missing) == 0 { Ok(()) } else { Err(before) }
    }

    /// Takes what a transfer brought that was not accepted: a function of its own, so that the
    /// usual frame has no case for it.
    #[cold]
    #[inline(never)]
    pub(crate) fn accept_otherwise<E: Error>(
        &mut self,
        sent: Result<(), E>,
        frame: [u8; 2],
        before: PreviousCount,
    ) -> Result<(), FrameError> {
        self.turns.back(before);
        let sent = sent.map_err(|error| FrameError::Bus(error.kind()));
        match sent.and_then(|()| decode(u16::from_be_bytes(frame))) {
            Ok(raw) => {
                let update = self.turns.update(raw);
                update.map_err(|LostTurn| FrameError::LostTurn)
            }
            Err(error) => {
                self.turns.missed(1);
                Err(error)
            }
        }
    }
}

impl<Spi: SpiDevice> As5047p<Spi> {
    /// Makes the next answer an angle: clears the encoder's error flags, requests the angle, and
    /// drops both answers, which belong to earlier commands.
    ///
    /// Without it the first answer after power-up is undefined. Errors are reported by
    /// [`Self::read`].
    #[cold]
    pub fn start(&mut self) {
        for command in [READ_ERRORS, READ_ANGLE] {
            let _ = self.spi.transfer_in_place(&mut command.to_be_bytes());
        }
    }

    /// The joint's angle in rad at the end of the previous frame, one tick ago.
    ///
    /// After an error the encoder is restarted at once, with two more frames, so that every error
    /// costs one angle.
    ///
    /// # Errors
    /// [`FrameError`]; the count of turns is then unchanged.
    #[inline(always)]
    pub fn read(&mut self) -> Result<f32, FrameError> {
        let mut frame = READ_ANGLE.to_be_bytes();
        let sent = self.spi.transfer_in_place(&mut frame);
        if let Err(before) = self.accept(&sent, frame) {
            self.read_otherwise(sent, frame, before)?;
        }
        Ok(self.angle())
    }

    #[cold]
    #[inline(never)]
    fn read_otherwise(
        &mut self,
        sent: Result<(), Spi::Error>,
        frame: [u8; 2],
        before: PreviousCount,
    ) -> Result<(), FrameError> {
        let accepted = self.accept_otherwise(sent, frame, before);
        if !matches!(accepted, Ok(()) | Err(FrameError::LostTurn)) {
            self.start();
        }
        accepted
    }
}

impl<Spi> EncoderType for As5047p<Spi> {
    type Error = FrameError;
    type Age = PreviousTick;

    fn missed(&mut self, ticks: u32) {
        self.turns.missed(ticks);
    }

    fn fault(error: &FrameError, joint: usize) -> Fault {
        match error {
            FrameError::LostTurn => Fault::LostTurn { joint },
            _ => Fault::Encoder { joint },
        }
    }
}

impl<Spi: SpiDevice> JointEncoder for As5047p<Spi> {
    fn start(&mut self) {
        As5047p::start(self);
    }

    #[inline(always)]
    fn sample(&mut self) -> Result<(), FrameError> {
        self.read().map(|_| ())
    }

    #[inline(always)]
    fn position(&self) -> f32 {
        self.angle()
    }
}

/// The 14-bit angle in an answer.
///
/// # Errors
/// Odd parity, or the encoder's error flag.
///
/// ```
/// use joint_drivers::as5047p::{FrameError, decode, encode};
/// assert_eq!(decode(encode(8191)), Ok(8191));
/// assert_eq!(decode(encode(8191) ^ 1), Err(FrameError::Parity));
/// ```
#[inline(always)]
pub fn decode(frame: u16) -> Result<u16, FrameError> {
    if wrong(frame) == 0 {
        return Ok(frame & MASK);
    }
    Err(if parity(frame) & 1 != 0 { FrameError::Parity } else { FrameError::Flag })
}

/// Whether a frame has a wrong parity or the error flag, in bit 0: one branch for both, which
/// almost no frame takes.
#[inline(always)]
const fn wrong(frame: u16) -> u16 {
    (parity(frame) | frame >> ERROR_BIT) & 1
}

/// The answer with a 14-bit angle, as sent by a simulated encoder.
pub const fn encode(raw: u16) -> u16 {
    with_parity(raw & MASK)
}

/// The raw count nearest to an angle in rad; 0 for NaN.
pub fn quantise(angle: f32) -> u16 {
    let counts = angle * (f32::from(COUNTS) / TAU);
    let nearest = if counts < 0.0 { counts - 0.5 } else { counts + 0.5 };
    (nearest as i32 & i32::from(MASK)) as u16
}

/// A 15-bit frame with the bit that makes its parity even.
pub const fn with_parity(frame: u16) -> u16 {
    let low = frame & 0x7fff;
    low | (parity(low) << 15)
}

/// A frame's parity in bit 0, odd for 1: folded, since a Cortex-M has no instruction that counts
/// bits.
#[inline(always)]
const fn parity(frame: u16) -> u16 {
    let byte = frame ^ (frame >> 8);
    let digit = byte ^ (byte >> 4);
    let pair = digit ^ (digit >> 2);
    pair ^ (pair >> 1)
}
