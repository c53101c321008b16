//! The subframes of a moteus reply: sections "Subframes" of `docs/protocol/can.md` and "Mappings"
//! of `docs/protocol/registers.md`.

use super::{FAULT, MODE, POSITION, TORQUE, VELOCITY};
use crate::can::frame::CanError;

/// The subframe that is one byte of padding.
pub(super) const NOP: u8 = 0x50;
/// One count of int8, int16 and int32, in rev, rev/s and N·m.
const POSITION_COUNTS: [f32; 3] = [0.01, 0.0001, 0.00001];
const VELOCITY_COUNTS: [f32; 3] = [0.1, 0.00025, 0.00001];
const TORQUE_COUNTS: [f32; 3] = [0.5, 0.01, 0.001];
const PLAIN: [f32; 3] = [1.0; 3];

/// The registers of a state that a reply has contained so far.
#[derive(Default)]
pub(super) struct Registers {
    pub(super) mode: Option<f32>,
    pub(super) position: Option<f32>,
    pub(super) velocity: Option<f32>,
    pub(super) torque: Option<f32>,
    pub(super) fault: Option<f32>,
}

impl Registers {
    /// The registers in the data of a reply.
    pub(super) fn of_reply(data: &[u8]) -> Result<Self, CanError> {
        let mut registers = Self::default();
        let mut rest = Reader(data);
        while let Some(kind) = rest.next() {
            registers.subframe(kind, &mut rest)?;
        }
        Ok(registers)
    }

    /// Takes the subframe that begins with `kind`.
    fn subframe(&mut self, kind: u8, rest: &mut Reader<'_>) -> Result<(), CanError> {
        match kind {
            NOP => Ok(()),
            // Replies: the type in bits 2 and 3, the number of registers in bits 0 and 1 if it is
            // not zero.
            0x20..=0x2f => {
                let count = match kind & 3 {
                    0 => rest.varuint()?,
                    count => count.into(),
                };
                let first = rest.varuint()?;
                (0..count).try_for_each(|place| self.take(first.wrapping_add(place), kind, rest))
            }
            0x30 | 0x31 => {
                Err(CanError::Register { register: rest.varuint()?, code: rest.varuint()? })
            }
            other => Err(CanError::Unknown(other)),
        }
    }

    /// Takes the value of a register; those that were not queried are skipped.
    fn take(&mut self, register: u32, kind: u8, rest: &mut Reader<'_>) -> Result<(), CanError> {
        let (place, counts) = match register {
            MODE => (&mut self.mode, PLAIN),
            POSITION => (&mut self.position, POSITION_COUNTS),
            VELOCITY => (&mut self.velocity, VELOCITY_COUNTS),
            TORQUE => (&mut self.torque, TORQUE_COUNTS),
            FAULT => (&mut self.fault, PLAIN),
            _ => return rest.skip([1, 2, 4, 4][usize::from(kind >> 2 & 3)]),
        };
        *place = Some(rest.value(kind, counts)?);
        Ok(())
    }
}

/// The bytes of a reply that were not read yet.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn next(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    fn chunk<const N: usize>(&mut self) -> Result<[u8; N], CanError> {
        let (first, rest) = self.0.split_first_chunk().ok_or(CanError::Short)?;
        self.0 = rest;
        Ok(*first)
    }

    fn varuint(&mut self) -> Result<u32, CanError> {
        let mut value = 0_u32;
        for shift in (0..35).step_by(7) {
            let byte = self.next().ok_or(CanError::Short)?;
            value |= u32::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Ok(value);
            }
        }
        Err(CanError::Unknown(0x80))
    }

    /// A value of the type of a subframe, of which the least integer is NaN.
    fn value(&mut self, kind: u8, [int8, int16, int32]: [f32; 3]) -> Result<f32, CanError> {
        let (value, is_number) = match kind >> 2 & 3 {
            0 => {
                let value = i8::from_le_bytes(self.chunk()?);
                (f32::from(value) * int8, value != i8::MIN)
            }
            1 => {
                let value = i16::from_le_bytes(self.chunk()?);
                (f32::from(value) * int16, value != i16::MIN)
            }
            2 => {
                let value = i32::from_le_bytes(self.chunk()?);
                (value as f32 * int32, value != i32::MIN)
            }
            _ => {
                let value = f32::from_le_bytes(self.chunk()?);
                (value, value.is_finite())
            }
        };
        is_number.then_some(value).ok_or(CanError::NotFinite)
    }

    fn skip(&mut self, bytes: usize) -> Result<(), CanError> {
        self.0 = self.0.get(bytes..).ok_or(CanError::Short)?;
        Ok(())
    }
}
