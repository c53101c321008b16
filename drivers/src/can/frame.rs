//! CAN frames: what classic CAN and CAN FD allow, and a frame of up to 64 bytes.

use core::fmt;

use embedded_can::{ErrorKind, ExtendedId, Frame, Id, StandardId};

use crate::joint::{DriveFault, DriveFaultKind};

/// The reason why a frame was not made, or is not a reply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CanError {
    /// The identity of the node or of the host is outside the protocol's range.
    Node,
    /// The greatest torque is not above zero, or not finite.
    Torque,
    /// The frame type does not hold this many bytes: `embedded_can::Frame::new` returned `None`. Or
    /// a reply has this many, more than it should.
    Length(usize),
    /// The identifier is that of another node, another host or another message.
    Identifier,
    /// The frame is a remote frame: a request, not a reply.
    Remote,
    /// The frame ends before its last field.
    Short,
    /// A quantity is NaN or infinite, or is so after the mapping to the joint.
    NotFinite,
    /// A subframe or a value that the protocol does not have.
    Unknown(u8),
    /// A register that the reply should contain is missing.
    Missing(u32),
    /// The bus reported an error.
    Bus(ErrorKind),
    /// The bus has no room for the frame, which would be sent late.
    Full,
    /// No position came since the last tick.
    NoReply,
    /// The node delivers no torque, without a fault of its own.
    NotReady,
    /// The node delivers no torque, because of the fault or the errors of this number.
    Fault(u32),
    /// The node delivers no torque, since a part of it is too hot.
    OverTemperature(Component),
    /// The node delivers no torque, since its supply has too much voltage.
    OverVoltage,
    /// The node delivers no torque, since its supply has too little voltage.
    UnderVoltage,
    /// The node delivers no torque, since a phase has had too much current.
    OverCurrent,
    /// The node delivers no torque, since it was overloaded or did not turn under load.
    Overload,
    /// The node delivers no torque, since no command came for the time of its watchdog.
    LostCommunication,
    /// The node delivers no torque, since its encoder failed or is not calibrated.
    Encoder,
    /// The drive may have lost its turns with its supply, until the joint is placed.
    LostTurn,
    /// The position is at the end of its scale, or beyond.
    Range,
    /// The node has another scale than expected in this register.
    Scale(u8),
    /// The node is in another control mode than that of the commands, of this number.
    Mode(u8),
    /// The node takes or sends frames that cannot be told apart from those of another joint's node:
    /// one number twice, or a host that is another's number.
    Clash,
    /// The node refused to read or write a register.
    Register {
        /// The number of the register.
        register: u32,
        /// The node's error number.
        code: u32,
    },
}

/// A part of a node that can be too hot.
///
/// ```
/// use joint_drivers::can::{CanError, Component};
/// let error = CanError::OverTemperature(Component::Motor);
/// assert_eq!(error.to_string(), "the node's motor is too hot");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The power stage.
    Drive,
    /// The winding.
    Motor,
}

impl CanError {
    /// What was seen and what to do, for the log of a robot with such a joint. A number that the
    /// error has is not in it.
    ///
    /// ```
    /// use joint_drivers::can::CanError;
    /// assert!(CanError::Mode(2).words().contains("store 1 (MIT) in register 10"));
    /// ```
    #[cold]
    pub const fn words(&self) -> &'static str {
        use CanError::*;
        match self {
            NoReply => "its drive does not answer: its number, a second drive of it, plug, supply",
            Identifier => {
                "frames came, none from its drive: its number, its host's (ESC_ID, MST_ID)"
            }
            Full => "no room: no drive takes frames, or fewer places than joints (see Outbox)",
            Bus(ErrorKind::Acknowledge) => "no drive acknowledges: supply, cable, bit rate",
            Bus(ErrorKind::Overrun) => "more frames than a tick can take: who else sends?",
            Bus(ErrorKind::Other) => "the bus is off: bit rate, 120 Ω at both ends, ground",
            Bus(_) => "frames are destroyed: bit rate, 120 Ω at both ends, one number twice",
            Scale(21) => "its register PMAX is not the program's: state the drive's there",
            Scale(22) => "its register VMAX is not the program's: of a 48 V motor?",
            Scale(_) => "its register TMAX is not the program's: is it this joint's motor?",
            Mode(_) => "its drive is in another control mode: store 1 (MIT) in register 10",
            Missing(_) => "its drive does not say this register: another maker, or old firmware?",
            NotReady => "its drive is not enabled: its supply came back, or another program did it",
            OverTemperature(Component::Motor) => "its motor is too hot: let it cool, load it less",
            OverTemperature(Component::Drive) => "its drive is too hot: let it cool, load it less",
            OverVoltage => {
                "too much voltage, of a braking arm: a brake resistor; a start clears it"
            }
            UnderVoltage => "too little voltage: its supply's limit, thin wires; a start clears it",
            OverCurrent => "a phase had too much current: blocked, shorted? A start clears it",
            Overload => "it was overloaded: blocked, too heavy? A start clears it",
            LostCommunication => {
                "it missed its commands: is its TIMEOUT too short? A start clears it"
            }
            LostTurn => {
                "its drive lost its turns: start the program with it at home, or place_near"
            }
            Range => "its position is at the end of the drive's scale: turn it back, set its zero",
            Encoder => "its encoder failed or is not calibrated: use the maker's tool",
            Fault(_) => "its drive reports a fault of this number: a start clears it",
            Clash => "impossible: its number or its host's is that of another joint's drive",
            Remote | Length(_) | Short => "no answer of its protocol: who else sends?",
            Node | Torque => "impossible: its number, its scale or its greatest torque",
            _ => "a frame has what its protocol does not have: who else sends on this bus?",
        }
    }
}

impl fmt::Display for CanError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node => out.write_str("the identity of a node is outside the protocol's range"),
            Self::Torque => out.write_str("the greatest torque is not a number above zero"),
            Self::Length(bytes) => write!(out, "the frame type does not hold {bytes} bytes"),
            Self::Identifier => out.write_str("the frame is of another node or message"),
            Self::Remote => out.write_str("the frame is a request"),
            Self::Short => out.write_str("the frame ends before its last field"),
            Self::NotFinite => out.write_str("a quantity of the frame is not finite"),
            Self::Unknown(value) => write!(out, "the protocol has no {value:#04x} here"),
            Self::Missing(register) => write!(out, "the reply lacks register {register:#05x}"),
            Self::Bus(kind) => write!(out, "the bus failed: {kind}"),
            Self::Full => out.write_str("the bus has no room for the frame"),
            Self::NoReply => out.write_str("no position came since the last tick"),
            Self::NotReady => out.write_str("the node delivers no torque"),
            Self::Fault(number) => write!(out, "the node reports the fault {number:#x}"),
            Self::OverTemperature(Component::Drive) => {
                out.write_str("the node's power stage is too hot")
            }
            Self::OverTemperature(Component::Motor) => out.write_str("the node's motor is too hot"),
            Self::OverVoltage => out.write_str("the node's supply has too much voltage"),
            Self::UnderVoltage => out.write_str("the node's supply has too little voltage"),
            Self::OverCurrent => out.write_str("a phase of the node has had too much current"),
            Self::Overload => out.write_str("the node was overloaded"),
            Self::LostCommunication => out.write_str("the node has missed its commands"),
            Self::Encoder => out.write_str("the node's encoder failed or is not calibrated"),
            Self::LostTurn => {
                out.write_str("the drive may have lost its turns with its supply: place the joint")
            }
            Self::Range => out.write_str("the position is at the end of its scale"),
            Self::Scale(register) => write!(out, "register {register} has another scale"),
            Self::Mode(mode) => write!(out, "the node is in another control mode, {mode}"),
            Self::Clash => out.write_str("the frames of two nodes cannot be told apart"),
            Self::Register { register, code } => {
                write!(out, "the node refused register {register:#05x} with {code}")
            }
        }
    }
}

impl core::error::Error for CanError {}

impl DriveFault for CanError {
    fn kind(&self) -> DriveFaultKind {
        match self {
            Self::NotReady => DriveFaultKind::NotReady,
            _ => DriveFaultKind::Failed,
        }
    }
}

/// The length of the shortest CAN FD frame that holds `bytes`; `None` above 64.
///
/// # Source
/// ISO 11898-1:2015, coding of the data length code.
///
/// ```
/// use joint_drivers::can::fd_length;
/// assert_eq!([8, 9, 23, 33, 64, 65].map(fd_length), [Some(8), Some(12), Some(24), Some(48), Some(64), None]);
/// ```
pub const fn fd_length(bytes: usize) -> Option<usize> {
    Some(match bytes {
        0..=8 => bytes,
        9..=12 => 12,
        13..=16 => 16,
        17..=20 => 20,
        21..=24 => 24,
        25..=32 => 32,
        33..=48 => 48,
        49..=64 => 64,
        _ => return None,
    })
}

/// A frame with room for `MOST` bytes of data: [`FdFrame`] or [`ClassicFrame`].
///
/// For HALs whose own frame does not implement [`embedded_can::Frame`]: copy identifier and data
/// from one to the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CanFrame<const MOST: usize> {
    id: Id,
    data: [u8; MOST],
    length: u8,
    is_remote: bool,
}

/// A CAN FD data frame of up to 64 bytes, or a remote frame.
///
/// ```
/// use embedded_can::{Frame, StandardId};
/// use joint_drivers::can::FdFrame;
/// let id = StandardId::new(0x101).unwrap();
/// assert_eq!(FdFrame::new(id, &[0x50; 24]).unwrap().data(), [0x50; 24]);
/// assert!(FdFrame::new(id, &[0x50; 23]).is_none()); // no code for this length
/// ```
pub type FdFrame = CanFrame<64>;

/// A frame of up to 8 bytes: of classic CAN, or of CAN FD that needs no more.
///
/// ```
/// use embedded_can::{Frame, StandardId};
/// use joint_drivers::can::ClassicFrame;
/// let id = StandardId::new(0x101).unwrap();
/// assert_eq!(ClassicFrame::new(id, &[0x50; 8]).unwrap().data(), [0x50; 8]);
/// assert!(ClassicFrame::new(id, &[0x50; 12]).is_none());
/// ```
pub type ClassicFrame = CanFrame<8>;

impl<const MOST: usize> Frame for CanFrame<MOST> {
    #[inline]
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        let length = data.len();
        if fd_length(length) != Some(length) {
            return None;
        }
        let mut all = [0; MOST];
        all.get_mut(..length)?.copy_from_slice(data);
        let length = u8::try_from(length).ok()?;
        Some(Self { id: id.into(), data: all, length, is_remote: false })
    }

    /// CAN FD has no remote frames: this is one of classic CAN, of at most 8 bytes.
    fn new_remote(id: impl Into<Id>, dlc: usize) -> Option<Self> {
        let length = u8::try_from(dlc).ok().filter(|dlc| *dlc <= 8)?;
        Some(Self { id: id.into(), data: [0; MOST], length, is_remote: true })
    }

    fn is_extended(&self) -> bool {
        matches!(self.id, Id::Extended(_))
    }

    #[inline]
    fn is_remote_frame(&self) -> bool {
        self.is_remote
    }

    #[inline]
    fn id(&self) -> Id {
        self.id
    }

    /// The length in bytes, not the code of it.
    fn dlc(&self) -> usize {
        self.length.into()
    }

    #[inline]
    fn data(&self) -> &[u8] {
        let length = if self.is_remote { 0 } else { self.length };
        self.data.get(..length.into()).unwrap_or_default()
    }
}

/// A data frame, or the length that the frame type does not hold.
pub(crate) fn frame<F: Frame>(id: impl Into<Id>, data: &[u8]) -> Result<F, CanError> {
    F::new(id, data).ok_or(CanError::Length(data.len()))
}

/// An identifier as a number.
pub(crate) fn raw(id: Id) -> u32 {
    match id {
        Id::Standard(id) => StandardId::as_raw(&id).into(),
        Id::Extended(id) => ExtendedId::as_raw(&id),
    }
}

/// A little-endian f32 at a place of a frame.
pub(crate) fn float(data: &[u8], at: usize) -> Result<f32, CanError> {
    let value = f32::from_le_bytes(bytes(data, at)?);
    if value.is_finite() { Ok(value) } else { Err(CanError::NotFinite) }
}

/// `N` bytes at a place of a frame.
pub(crate) fn bytes<const N: usize>(data: &[u8], at: usize) -> Result<[u8; N], CanError> {
    let rest = data.get(at..).unwrap_or_default();
    rest.first_chunk().copied().ok_or(CanError::Short)
}

/// A torque within ± `most`; zero for NaN.
pub(crate) fn limit(torque: f32, most: f32) -> f32 {
    // Not `f32::clamp`, which panics if the bounds are in the wrong order.
    if torque > most {
        most
    } else if torque < -most {
        -most
    } else if torque.is_nan() {
        0.0
    } else {
        torque
    }
}

/// The mapping's torque limit, checked: at the joint, and finite at the shaft.
pub(crate) fn check_most(most: f32, mapping: &crate::JointMapping) -> Result<(), CanError> {
    let at_shaft = mapping.shaft_torque(most);
    if most > 0.0 && at_shaft.is_ok() { Ok(()) } else { Err(CanError::Torque) }
}
