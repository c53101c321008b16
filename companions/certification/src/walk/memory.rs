//! The content of memory: words, and bytes of words of which not all are known.

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
        if let [Some(a), Some(b), Some(c), Some(d)] =
            [0, 1, 2, 3].map(|i| self.bytes.get(&(address + i)))
        {
            return Ok(Word::Bits(u32::from_le_bytes([*a, *b, *c, *d])));
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

    /// Whether a word is an input or the program's: a load has it whatever was stored.
    fn is_given(&self, word: u32) -> bool {
        let is_input = (ARGUMENTS + RANGE..ARGUMENTS + 4 * RANGE).contains(&word);
        is_input || self.image.word(word).is_some()
    }

    pub(super) fn store(&mut self, address: u32, word: Word) -> Result<()> {
        if address & 3 != 0 || self.is_given(address) {
            return Err(
                self.declined("a store to an input, to the program, or beside a word's address")
            );
        }
        self.bytes.retain(|at, _| *at & !3 != address);
        self.memory.insert(address, word);
        Ok(())
    }

    pub(super) fn byte(&self, address: u32) -> Result<u8> {
        let within = address & 3;
        let word = match self.memory.get(&(address - within)) {
            Some(Word::Bits(bits)) => Some(*bits),
            Some(_) => None,
            None => self.image.word(address - within),
        };
        let byte = word.map(|word| word.to_le_bytes()[within as usize]);
        let byte = self.bytes.get(&address).copied().or(byte);
        byte.ok_or_else(|| self.declined("a part of a word that is not known"))
    }

    /// After a byte is written into a real number, its other bytes are no longer known.
    pub(super) fn store_byte(&mut self, address: u32, byte: u8) -> Result<()> {
        let within = address & 3;
        let word = address - within;
        if self.is_given(word) {
            return Err(self.declined("a store to a byte of an input or of the program"));
        }
        if let Some(Word::Bits(bits)) = self.memory.get(&word) {
            let mut bytes = bits.to_le_bytes();
            bytes[within as usize] = byte;
            return self.store(word, Word::Bits(u32::from_le_bytes(bytes)));
        }
        self.memory.remove(&word);
        self.bytes.insert(address, byte);
        Ok(())
    }

    /// Loads or stores one word or two.
    pub(super) fn access(&mut self, one: Access) -> Result<()> {
        let (base, by) = (self.base(one.n)?, self.operand(one.offset)?);
        let moved = base.wrapping_add(by);
        let at = if one.before { moved } else { base };
        if one.writes_back {
            self.set(one.n, Word::Bits(moved))?;
        }
        let registers = [one.t, one.second].into_iter().filter(|t| *t != NOWHERE);
        for (t, at) in registers.zip([at, at.wrapping_add(4)]) {
            if one.bytes < 4 && one.load {
                let bytes = (at..).take(one.bytes.into()).map(|at| self.byte(at));
                let bytes = bytes.collect::<Result<Vec<_>>>()?;
                let number =
                    bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
                self.set(t, Word::Bits(number))?;
            } else if one.bytes < 4 {
                let number = self.bits(t)?.to_le_bytes();
                for (at, byte) in (at..).zip(&number[..one.bytes.into()]) {
                    self.store_byte(at, *byte)?;
                }
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
