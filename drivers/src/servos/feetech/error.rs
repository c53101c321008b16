//! Errors of the servo bus.

use core::fmt;

use embedded_io::{Error, ErrorKind};

/// The reason why the bus did not do what it should.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FeetechError {
    /// The port reported an error.
    Port(ErrorKind),
    /// The port returned no byte: the servo did not reply within the port's time limit.
    NoReply {
        /// The number of the servo on the bus.
        id: u8,
    },
    /// No reply, but a packet with a wrong checksum.
    Checksum {
        /// The servo that should have replied.
        id: u8,
    },
    /// No reply among the most bytes that are skipped.
    Noise,
    /// The port did not receive the bytes that it sent: another device sent at the same time.
    Echo,
    /// Another servo replied, or a reply has another length.
    Unexpected {
        /// The servo that should have replied.
        id: u8,
        /// The number of the servo that replied.
        found: u8,
    },
    /// The servo reports errors in its status.
    Servo {
        /// The number of the servo on the bus.
        id: u8,
        /// Bit 0 voltage, 1 magnetic encoder, 2 temperature, 3 current, 5 load.
        status: u8,
    },
    /// An identity above 253, or two servos of the same.
    Id(u8),
    /// The goal of a joint is not finite, or beyond the counts of its servo: from where the joint
    /// is the servo has to pass the seam of its turn (or ±32,767 counts, if it counts turns), or it
    /// is not known where the joint is.
    Goal {
        /// The place of the joint.
        joint: usize,
    },
    /// The count of a servo does not say where its joint is, until
    /// [`Servos::place_near`](super::Servos::place_near).
    LostTurn {
        /// The place of the joint.
        joint: usize,
    },
    /// The packet would be longer than this driver sends or receives.
    TooLong,
}

impl fmt::Display for FeetechError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Port(kind) => write!(out, "the servo bus failed: {kind:?}"),
            Self::NoReply { id } => write!(out, "servo {id} did not reply"),
            Self::Checksum { id } => write!(out, "the reply of servo {id} has a wrong checksum"),
            Self::Noise => out.write_str("the servo bus receives no packets but noise"),
            Self::Echo => out.write_str("two devices sent on the servo bus at the same time"),
            Self::Unexpected { id, found } => {
                write!(out, "servo {found} replied instead of {id}, or not as it should")
            }
            Self::Servo { id, status } => write!(out, "servo {id} reports errors {status:#04x}"),
            Self::Id(id) => write!(out, "{id} is not the identity of one servo"),
            Self::Goal { joint } => {
                write!(out, "the goal of joint {joint} is beyond the counts of its servo")
            }
            Self::LostTurn { joint } => {
                write!(out, "the servo of joint {joint} can have lost a turn")
            }
            Self::TooLong => out.write_str("the packet is too long"),
        }
    }
}

impl core::error::Error for FeetechError {}

pub(super) fn port_error<E: Error>(error: E) -> FeetechError {
    FeetechError::Port(error.kind())
}
