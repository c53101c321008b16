//! The parts in which the protocols of the makers differ.

use embedded_can::{Frame, Id, StandardId};

use crate::can::frame::{self, CanError};

/// The protocol of a maker, with the identity of one drive.
pub trait Protocol: Sized {
    /// The last count of all quantities but the position.
    const TOP: u16 = 4095;
    /// Whether there is a frame that clears faults.
    const CLEARS: bool = true;
    /// The part of a turn of the output from which a drive counts after its start, at least.
    const START: f32 = 1.0;
    /// The angle after which the count of positions begins again, if it is not the scale.
    const PERIOD: Option<f32> = None;

    /// The drive `id` that replies to `host`.
    ///
    /// # Errors
    /// [`CanError::Node`].
    fn new(id: u8, host: u16) -> Result<Self, CanError>;

    /// The number of the drive.
    fn id(&self) -> u8;

    /// A frame without quantities: seven bytes 0xFF and the number of the request.
    ///
    /// # Errors
    /// [`CanError::Length`].
    fn special<F: Frame>(&self, special: Special) -> Result<F, CanError> {
        standard(self.id().into(), &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, special as u8])
    }

    /// The frame of all quantities: 16, 12, 12, 12 and 12 bits, the high ones first.
    ///
    /// # Errors
    /// [`CanError::Length`].
    fn command<F: Frame>(&self, counts: &Counts) -> Result<F, CanError> {
        let &Counts { position, velocity, kp, kd, torque } = counts;
        let all = u64::from(position) << 48
            | u64::from(velocity) << 36
            | u64::from(kp) << 24
            | u64::from(kd) << 12
            | u64::from(torque);
        standard(self.id().into(), &all.to_be_bytes())
    }

    /// The message of a frame.
    ///
    /// # Errors
    /// [`CanError`].
    fn decode<F: Frame>(&self, frame: &F) -> Result<Feedback, CanError>;

    /// The registers of the greatest position, velocity and torque, if the drive has them.
    const SCALES: Option<[u8; 3]> = None;

    /// The register of the control mode, and its number for MIT mode, if the drive has one.
    const MODE: Option<(u8, u32)> = None;

    /// The frame that reads a register.
    ///
    /// # Errors
    /// [`CanError::Length`]. [`CanError::Unknown`]: the protocol has no registers.
    fn read_register<F: Frame>(&self, register: u8) -> Result<F, CanError> {
        Err(CanError::Unknown(register))
    }

    /// A register in a reply, with its four bytes.
    ///
    /// # Errors
    /// [`CanError`].
    fn register<F: Frame>(&self, frame: &F) -> Result<(u8, [u8; 4]), CanError> {
        let _ = frame;
        Err(CanError::Identifier)
    }
}

/// The request of a frame without quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Special {
    Clear = 0xfb,
    Enable = 0xfc,
    Disable = 0xfd,
    Zero = 0xfe,
}

/// The counts of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    pub position: u16,
    pub velocity: u16,
    pub kp: u16,
    pub kd: u16,
    pub torque: u16,
}

/// The message of a drive, in counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feedback {
    State {
        /// Position, velocity, torque.
        counts: [u16; 3],
        /// °C.
        motor: Option<f32>,
        /// °C.
        drive: Option<f32>,
        status: Option<Result<(), CanError>>,
    },
    Status(Result<(), CanError>),
}

/// The data of a frame, if its identifier is the right one.
pub(super) fn data<F: Frame>(frame: &F, is_own: bool) -> Result<[u8; 8], CanError> {
    if !is_own {
        return Err(CanError::Identifier);
    }
    if frame.is_remote_frame() {
        return Err(CanError::Remote);
    }
    let data = frame.data();
    let length = CanError::Length(data.len());
    let short = if data.len() < 8 { CanError::Short } else { length };
    <[u8; 8]>::try_from(data).map_err(|_| short)
}

/// Whether an identifier is this one of 11 bits.
pub(super) fn is_standard(id: Id, own: u16) -> bool {
    matches!(id, Id::Standard(id) if id.as_raw() == own)
}

/// A frame with an identifier of 11 bits.
pub(super) fn standard<F: Frame>(id: u16, data: &[u8; 8]) -> Result<F, CanError> {
    frame::frame(StandardId::new(id).ok_or(CanError::Node)?, data)
}

/// 16, 12 and 12 bits, the high ones first.
pub(super) fn unpack([p1, p0, v, both, t, ..]: [u8; 7]) -> [u16; 3] {
    let [v, both, t] = [v, both, t].map(u16::from);
    [u16::from_be_bytes([p1, p0]), v << 4 | both >> 4, (both & 0x0f) << 8 | t]
}
