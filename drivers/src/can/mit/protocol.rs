//! The parts in which the protocols of the makers differ.

use embedded_can::{Frame, Id, StandardId};

use crate::can::frame::{self, CanError};

/// The protocol of one maker, and what a drive of it is from its start.
pub trait Maker: Protocol + Sized {
    /// The last count of all quantities but the position.
    const TOP: u16 = 4095;
    /// The part of a turn of the output from which a drive counts after its start, at least.
    const START: f32 = 1.0;
    /// The angle after which the count of positions begins again, if it is not the scale.
    const PERIOD: Option<f32> = None;

    /// The drive `id` that replies to `host`.
    ///
    /// # Errors
    /// [`CanError::Node`].
    fn new(id: u8, host: u16) -> Result<Self, CanError>;
}

/// The protocol of a drive, with its identity.
pub trait Protocol {
    /// The requests that the protocol does not have.
    const LACKS: &'static [Special] = &[Special::Faults];

    /// The identifiers of the drive.
    fn address(&self) -> Address;

    /// A frame without quantities: six bytes 0xFF and the number of the request.
    ///
    /// # Errors
    /// [`CanError::Length`]. [`CanError::Unknown`]: the protocol has no such request.
    fn special<F: Frame>(&self, special: Special) -> Result<F, CanError> {
        let [high, low] = (special as u16).to_be_bytes();
        if Self::LACKS.contains(&special) {
            return Err(CanError::Unknown(low));
        }
        standard(self.address().id.into(), &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, high, low])
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
        standard(self.address().id.into(), &all.to_be_bytes())
    }

    /// The message of a frame.
    ///
    /// # Errors
    /// [`CanError`].
    fn decode<F: Frame>(&self, frame: &F) -> Result<Feedback, CanError>;
}

/// The identifiers of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Address {
    /// The number of the drive, to which its commands go.
    pub id: u8,
    /// The identifier of its replies; none if both have 29 bits.
    pub host: Option<u16>,
    /// The bits of an identifier by which it knows its commands.
    pub heard: u16,
    /// Whether it has registers, and four bits of its number in a reply.
    pub is_damiao: bool,
}

impl Address {
    /// 11 bits, of another maker than Damiao.
    pub(super) const fn new(id: u8, host: u16) -> Self {
        Self { id, host: Some(host), heard: 0x7ff, is_damiao: false }
    }

    /// Whether the other drive takes a frame of this one or to it, or has the same replies.
    pub(crate) fn is_taken_by(&self, other: &Self) -> bool {
        let (Some(host), Some(others)) = (self.host, other.host) else {
            return self.host == other.host && self.id == other.id;
        };
        let takes = |id: u16| (id ^ u16::from(other.id)) & other.heard == 0;
        let told = if self.is_damiao || other.is_damiao { 0x0f } else { 0xff };
        let is_one = host == others && (self.id ^ other.id) & told == 0;
        takes(self.id.into()) || takes(host) || is_one
    }
}

/// The request of a frame without quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Special {
    Clear = 0xfffb,
    Enable = 0xfffc,
    Disable = 0xfffd,
    Zero = 0xfffe,
    Faults = 0x00fb,
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

/// The data of a frame with this identifier of 11 bits.
pub(super) fn standard_data<F: Frame>(frame: &F, own: u16) -> Result<[u8; 8], CanError> {
    data(frame, matches!(frame.id(), Id::Standard(id) if id.as_raw() == own))
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
