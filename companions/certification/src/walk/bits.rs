//! Integers and flags, and the bits of a real number of which it is known that it is positive.

use std::cmp::Ordering;

use super::{Walk, Word};
use crate::decode::{ALWAYS, Condition, Operand};
use crate::error::Result;
use crate::flags;

/// Bits from the least to the greatest.
pub(super) fn within(low: u32, high: u32) -> Word {
    match low == high {
        true => Word::Bits(low),
        false => Word::Within(low, high),
    }
}

impl Walk<'_> {
    pub(super) fn bits(&self, register: u8) -> Result<u32> {
        match self.core(register)? {
            Word::Bits(bits) => Ok(bits),
            _ => Err(self.declined("an integer operation on a real number")),
        }
    }

    /// The least and the greatest bits of a register. Those of a real number are taken as of one
    /// that is positive, neither subnormal nor infinite, which is noted as a comparison.
    pub(super) fn range(&mut self, register: u8) -> Result<(u32, u32)> {
        match self.core(register)? {
            Word::Within(low, high) => Ok((low, high)),
            Word::Real(a) => {
                let least = self.node(Word::Bits(f32::MIN_POSITIVE.to_bits()))?;
                match self.compare([a, least])? {
                    Ordering::Greater => Ok((f32::MIN_POSITIVE.to_bits(), f32::MAX.to_bits())),
                    _ => {
                        Err(self.declined("an integer operation on a number that is not positive"))
                    }
                }
            }
            _ => self.bits(register).map(|bits| (bits, bits)),
        }
    }

    pub(super) fn operand(&self, operand: Operand) -> Result<u32> {
        match operand {
            Operand::Constant(value) => Ok(value),
            Operand::Register(m, shift) => Ok(self.bits(m)? << shift),
            Operand::Right(m, shift) => Ok(self.bits(m)? >> shift),
        }
    }

    /// a + b + carry for each a from low to high, and its flags.
    pub(super) fn sum(
        &mut self,
        sets: bool,
        (low, high): (u32, u32),
        b: u32,
        carry: bool,
    ) -> Result<Word> {
        let [least, most] = [low, high].map(|a| flags::of_sum(a, b, carry));
        // A sum that passes 2³² somewhere in between has no order.
        if least[2] != most[2] {
            return Err(self.declined("a sum of bits that are not known"));
        }
        if sets {
            let is_decided = |i: usize| least[i] == most[i] && (low ^ high) >> 31 == 0;
            self.flags = [0, 1, 2, 3].map(|i| is_decided(i).then_some(least[i]));
        }
        let [low, high] = [low, high].map(|a| a.wrapping_add(b).wrapping_add(carry.into()));
        Ok(within(low, high))
    }

    /// Keeps the flags of another result: carry and overflow are those of no sum.
    pub(super) fn note(&mut self, sets: bool, result: Word) {
        if sets {
            self.flags = match result {
                Word::Bits(bits) => [Some(bits >> 31 != 0), Some(bits == 0), None, None],
                _ => [None; 4],
            };
        }
    }

    pub(super) fn holds(&self, condition: Condition) -> Result<bool> {
        if condition == ALWAYS {
            return Ok(true);
        }
        let unknown = || self.declined("a branch by flags that are not followed");
        flags::holds(condition, self.flags).ok_or_else(unknown)
    }
}
