//! RobStride: the drives 00 to 06, by their own protocol with identifiers of 29 bits
//! ([`RobStride`]) or in MIT mode with 11 bits ([`RobStrideMit`]), over classic CAN.
//!
//! Their own protocol has 16 bits for every quantity, and the faults in every reply. In MIT mode a
//! reply has no faults: a drive that fails is noticed only if it stops to reply or if it is asked,
//! by [`CanJoints::read_faults`](crate::CanJoints::read_faults). Prefer the former; a drive has it
//! from the factory.
//!
//! # Source
//! RobStride's manuals of the seven drives of 28 April 2026 (RobStride/Product_Information, commit
//! ba7236bc), chapters 4.1 and 6, in Chinese and in English: in MIT mode "Command 5" reads the
//! faults, and bytes 1 to 4 of its reply are those of chapter 4.1; RobStride/SampleProgram, commit
//! 5f598686, for the order of bits.
//!
//! Drives are numbered 1 to 127, hosts 0 to 255; from the factory 127 and 0xFD.
//!
//! After power-up a drive knows its position within a turn of its output, from 0 to 2π, or from
//! −π to π with its parameter `zero_sta` at 1. A reply repeats after 8π.
//!
//! Public sources disagree:
//!
//! | what | here | other values |
//! |---|---|---|
//! | position | ±12.57 rad: code of the manuals, from firmware 0.0.2.6 | ±4π in their tables; ±12.5 in SampleProgram |
//! | MIT mode: velocity of 02, 03, 04 | 44, 20, 15 rad/s: Chinese manuals | 33: English manuals, LeRobot |
//! | MIT mode: gains of 03 and 04 | 5000 and 100: Chinese manuals | 500 and 5: English manuals, LeRobot |
//! | MIT mode: position of 04 | ±12.57 rad: Chinese manual | ±15: English manual |
//! | velocity of 00, 03, 05, 06 | 33, 20, 50, 50 rad/s: all manuals in chapter 4 | 50, 50, 33, 20: Robstride-Dynamics-Python-SDK |
//! | torque of 00, 05, 06 | 14, 5.5, 36 N·m: all manuals | 17, 17, 60: the same |
//! | torque of 02 | 17 N·m: both manuals | 20: LeRobot |
//!
//! The Chinese manuals have the same scales in both protocols; the English ones repeat numbers of
//! other drives. No register says what a drive has: try a small gain on the bench first.

use embedded_can::{ExtendedId, Frame, Id};

use super::protocol::{self, Address, Counts, Feedback, Maker, Protocol, Special};
use super::{Drive, Scale};
use crate::can::frame::{self, CanError, Component};

/// ±33 rad/s, ±14 N·m, gains to 500 and 5.
pub const RS00: Scale = small(33.0, 14.0);
/// ±44 rad/s, ±17 N·m, gains to 500 and 5.
pub const RS01: Scale = small(44.0, 17.0);
/// ±44 rad/s, ±17 N·m, gains to 500 and 5.
pub const RS02: Scale = small(44.0, 17.0);
/// ±20 rad/s, ±60 N·m, gains to 5000 and 100.
pub const RS03: Scale = large(20.0, 60.0);
/// ±15 rad/s, ±120 N·m, gains to 5000 and 100.
pub const RS04: Scale = large(15.0, 120.0);
/// ±50 rad/s, ±5.5 N·m, gains to 500 and 5.
pub const RS05: Scale = small(50.0, 5.5);
/// ±50 rad/s, ±36 N·m, gains to 5000 and 100.
pub const RS06: Scale = large(50.0, 36.0);

const fn small(velocity: f32, torque: f32) -> Scale {
    Scale { position: 12.57, velocity, torque, kp: 500.0, kd: 5.0 }
}

const fn large(velocity: f32, torque: f32) -> Scale {
    Scale { kp: 5000.0, kd: 100.0, ..small(velocity, torque) }
}

/// The types of messages, bits 28 to 24 of an identifier.
const COMMAND: u32 = 1;
const FEEDBACK: u32 = 2;
const ENABLE: u32 = 3;
const STOP: u32 = 4;
const SET_ZERO: u32 = 6;
const FAULTS: u32 = 21;
const REPORT: u32 = 24;

/// The positions of a reply repeat after four turns.
const PERIOD: Option<f32> = Some(8.0 * core::f32::consts::PI);

/// A RobStride drive by its own protocol.
///
/// ```
/// use embedded_can::{ExtendedId, Frame};
/// use joint_drivers::{JointMapping, JointRange, can::FdFrame};
/// use joint_drivers::mit::robstride::{RS02, RobStride};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let drive = RobStride::new(0x7f, 0xfd, RS02, 17.0, mapping)?;
/// let command: FdFrame = drive.set_torque(17.0)?;
/// // The torque is in the identifier.
/// assert_eq!(command.id(), ExtendedId::new(0x01ff_ff7f).unwrap().into());
/// assert_eq!(command.data(), [0x80, 0, 0x80, 0, 0, 0, 0, 0]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub type RobStride = Drive<NativeProtocol>;

/// A RobStride drive in MIT mode.
///
/// ```
/// use embedded_can::{Frame, StandardId};
/// use joint_drivers::{JointMapping, JointRange, can::FdFrame};
/// use joint_drivers::mit::robstride::{RS02, RobStrideMit};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let drive = RobStrideMit::new(0x7f, 0xfd, RS02, 17.0, mapping)?;
/// let command: FdFrame = drive.set_torque(17.0)?;
/// assert_eq!(command.id(), StandardId::new(0x7f).unwrap().into());
/// assert_eq!(command.data(), [0x80, 0, 0x80, 0, 0, 0, 0x0f, 0xff]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub type RobStrideMit = Drive<MitProtocol>;

/// The identifiers of a RobStride drive in its own protocol.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NativeProtocol {
    id: u8,
    host: u8,
}

/// The identifiers of a RobStride drive in MIT mode.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MitProtocol {
    id: u8,
    host: u8,
}

/// The identity of drive and host within their ranges.
fn identity(id: u8, host: u16) -> Result<(u8, u8), CanError> {
    let host = u8::try_from(host).map_err(|_| CanError::Node)?;
    (1..=127).contains(&id).then_some((id, host)).ok_or(CanError::Node)
}

/// The first of the faults whose bits are set in a word.
fn fault_of(word: u32) -> Result<(), CanError> {
    const FAULTS: [(u32, CanError); 6] = [
        (1 << 0, CanError::OverTemperature(Component::Motor)),
        (1 << 16 | 1 << 5 | 1 << 4, CanError::OverCurrent),
        (1 << 3, CanError::OverVoltage),
        (1 << 2, CanError::UnderVoltage),
        (1 << 9 | 1 << 7, CanError::Encoder),
        (1 << 14, CanError::Overload),
    ];
    first_of(&FAULTS, word)
}

fn first_of(faults: &[(u32, CanError)], word: u32) -> Result<(), CanError> {
    if word == 0 {
        return Ok(());
    }
    let first = faults.iter().find(|(bits, _)| word & bits != 0);
    Err(first.map_or(CanError::Fault(word), |&(_, fault)| fault))
}

/// Tenths of a degree Celsius.
fn celsius(high: u8, low: u8) -> Option<f32> {
    Some(f32::from(i16::from_be_bytes([high, low])) * 0.1)
}

impl NativeProtocol {
    /// A message of this type, with 16 bits in the identifier.
    fn frame<F: Frame>(&self, kind: u32, middle: u16, data: &[u8; 8]) -> Result<F, CanError> {
        let id = kind << 24 | u32::from(middle) << 8 | u32::from(self.id);
        frame::frame(ExtendedId::new(id).ok_or(CanError::Node)?, data)
    }

    /// The faults in bits 21 to 16, and the mode in bits 23 and 22 of an identifier.
    fn status(raw: u32) -> Result<(), CanError> {
        const FAULTS: [(u32, CanError); 5] = [
            (1 << 2, CanError::OverTemperature(Component::Motor)),
            (1 << 1, CanError::OverCurrent),
            (1 << 0, CanError::UnderVoltage),
            (1 << 5 | 1 << 3, CanError::Encoder),
            (1 << 4, CanError::Overload),
        ];
        first_of(&FAULTS, raw >> 16 & 0x3f)?;
        if raw >> 22 & 3 == 2 { Ok(()) } else { Err(CanError::NotReady) }
    }
}

impl Maker for NativeProtocol {
    const TOP: u16 = u16::MAX;
    const PERIOD: Option<f32> = PERIOD;

    fn new(id: u8, host: u16) -> Result<Self, CanError> {
        identity(id, host).map(|(id, host)| Self { id, host })
    }
}

impl Protocol for NativeProtocol {
    fn address(&self) -> Address {
        Address { host: None, ..Address::new(self.id, 0) }
    }

    fn special<F: Frame>(&self, special: Special) -> Result<F, CanError> {
        let (kind, first) = match special {
            Special::Enable => (ENABLE, 0),
            Special::Disable => (STOP, 0),
            Special::Clear => (STOP, 1),
            Special::Zero => (SET_ZERO, 1),
            Special::Faults => return Err(CanError::Unknown(special as u8)),
        };
        self.frame(kind, self.host.into(), &[first, 0, 0, 0, 0, 0, 0, 0])
    }

    fn command<F: Frame>(&self, counts: &Counts) -> Result<F, CanError> {
        let &Counts { position, velocity, kp, kd, torque } = counts;
        let all = [position, velocity, kp, kd].into_iter();
        let data = all.fold(0, |all, count| all << 16 | u64::from(count));
        self.frame(COMMAND, torque, &data.to_be_bytes())
    }

    fn decode<F: Frame>(&self, frame: &F) -> Result<Feedback, CanError> {
        let raw = frame::raw(frame.id());
        let kind = raw >> 24;
        let of_us = u32::from(self.id) << 8 | u32::from(self.host);
        let is_own = matches!(frame.id(), Id::Extended(_))
            && raw & 0xffff == of_us
            && matches!(kind, FEEDBACK | FAULTS | REPORT);
        let [p1, p0, v1, v0, t1, t0, c1, c0] = protocol::data(frame, is_own)?;
        if kind == FAULTS {
            return Ok(Feedback::Status(fault_of(u32::from_le_bytes([p1, p0, v1, v0]))));
        }
        Ok(Feedback::State {
            counts: [[p1, p0], [v1, v0], [t1, t0]].map(u16::from_be_bytes),
            motor: celsius(c1, c0),
            drive: None,
            status: Some(Self::status(raw)),
        })
    }
}

impl Maker for MitProtocol {
    const PERIOD: Option<f32> = PERIOD;

    fn new(id: u8, host: u16) -> Result<Self, CanError> {
        identity(id, host).map(|(id, host)| Self { id, host })
    }
}

impl Protocol for MitProtocol {
    const LACKS: &'static [Special] = &[];

    /// The upper bits of a command are the mode of control.
    fn address(&self) -> Address {
        Address { heard: 0xff, ..Address::new(self.id, self.host.into()) }
    }

    fn decode<F: Frame>(&self, frame: &F) -> Result<Feedback, CanError> {
        let [id, rest @ ..] = protocol::standard_data(frame, self.host.into())?;
        if id != self.id {
            return Err(CanError::Identifier);
        }
        Ok(match rest {
            // As RobStride's sample program tells them apart, but for bit 16, which it does not
            // read: a feedback of these bytes would have the most negative torque at 0.0 °C.
            [b0, b1, b2, 0, 0, 0, 0] => {
                Feedback::Status(fault_of(u32::from_le_bytes([b0, b1, b2, 0])))
            }
            [.., c1, c0] => Feedback::State {
                counts: protocol::unpack(rest),
                motor: celsius(c1, c0),
                drive: None,
                status: None,
            },
        })
    }
}
