//! The content of memory, by words.

use super::{ARGUMENTS, RANGE, Walk, Word};
use crate::decode::{Access, NOWHERE, PC, Several};
use crate::error::Result;
use crate::graph::{Input, Node};

impl Walk<'_> {
    pub(super) fn load(&mut self, address: u32) -> Result<Word> {
        if address & 3 != 0 {
            return Err(self.declined("an address that is not a word's"));
        }
        if let Some(word) = self.memory.get(&address) {
            return Ok(*word);
        }
        if let Some(bits) = self.image.word(address) {
            return Ok(Word::Bits(bits));
        }
        let argument = address.wrapping_sub(ARGUMENTS) / RANGE;
        if !(1..4).contains(&argument) {
            return Err(self.declined("memory that nothing has written"));
        }
        let input = Input { argument: argument as u8, offset: (address - ARGUMENTS) % RANGE };
        if let Some(node) = self.inputs.get(&input) {
            return Ok(Word::Real(*node));
        }
        let node = self.push(Node::Input(input));
        self.inputs.insert(input, node);
        Ok(Word::Real(node))
    }

    pub(super) fn store(&mut self, address: u32, word: Word) -> Result<()> {
        // A load of an input or of the program has it whatever was stored.
        let is_input = (ARGUMENTS + RANGE..ARGUMENTS + 4 * RANGE).contains(&address);
        if address & 3 != 0 || is_input || self.image.word(address).is_some() {
            return Err(
                self.declined("a store to an input, to the program, or beside a word's address")
            );
        }
        self.memory.insert(address, word);
        Ok(())
    }

    fn byte(&self, address: u32) -> Result<u8> {
        let within = address & 3;
        let word = match self.memory.get(&(address - within)) {
            Some(Word::Bits(bits)) => Some(*bits),
            Some(_) => None,
            None => self.image.word(address - within),
        };
        let byte = word.map(|word| word.to_le_bytes()[within as usize]);
        byte.ok_or_else(|| self.declined("a part of a word that is not known"))
    }

    /// Loads or stores one word or two, or loads a part of one.
    pub(super) fn access(&mut self, one: Access) -> Result<()> {
        let (base, by) = (self.base(one.n)?, self.operand(one.offset)?);
        let moved = base.wrapping_add(by);
        let at = if one.before { moved } else { base };
        if one.writes_back {
            self.set(one.n, Word::Bits(moved))?;
        }
        let registers = [one.t, one.second].into_iter().filter(|t| *t != NOWHERE);
        for (t, at) in registers.zip([at, at.wrapping_add(4)]) {
            if one.bytes < 4 {
                let bytes = (at..).take(one.bytes.into()).map(|at| self.byte(at));
                let bytes = bytes.collect::<Result<Vec<_>>>()?;
                let number =
                    bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
                self.set(t, Word::Bits(number))?;
            } else if one.load {
                let word = self.load(at)?;
                self.set(t, word)?;
            } else {
                let word = self.core(t)?;
                self.store(at, word)?;
            }
        }
        Ok(())
    }

    fn base(&self, n: u8) -> Result<u32> {
        Ok(self.bits(n)? & if n == PC { !3 } else { !0 })
    }

    pub(super) fn several(&mut self, one: Several) -> Result<()> {
        let base = self.base(one.n)?;
        if one.moves != 0 {
            self.set(one.n, Word::Bits(base.wrapping_add_signed(one.moves)))?;
        }
        let low = base.wrapping_add_signed(one.offset);
        for (address, register) in (low..).step_by(4).zip(one.named()) {
            let real = register.wrapping_sub(16);
            match (one.load, self.real.get(real)) {
                (true, Some(_)) => self.real[real] = Some(self.load(address)?),
                (true, None) => {
                    let word = self.load(address)?;
                    self.set(register as u8, word)?;
                }
                (false, is_real) => {
                    let word = match is_real {
                        Some(_) => self.real(real as u8)?,
                        None => self.core(register as u8)?,
                    };
                    self.store(address, word)?;
                }
            }
        }
        Ok(())
    }
}
