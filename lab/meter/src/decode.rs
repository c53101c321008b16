//! Thumb-2 and FPv4-SP encodings to [`Insn`] and [`Operation`], by the table `decode.txt`.

mod relative;
#[cfg(test)]
mod tests;

use std::sync::LazyLock;

pub use relative::{Relative, relative};

use crate::insn::{Class, Insn, Marker};

/// Size in bytes of the instruction that starts with this halfword (A5.1).
pub const fn size(first: u16) -> u8 {
    if first >> 11 >= 0b11101 { 4 } else { 2 }
}

/// The instruction made of these halfwords; the second counts only if [`size`] is 4.
pub fn decode(first: u16, second: u16) -> Insn {
    let (row, code) = found(first, second);
    let size = size(first);
    row.map_or(Insn::new(Class::Unknown, size), |row| row.insn(code, size))
}

/// The operation of an instruction: the name and the fields of its row in `decode.txt`.
#[derive(Clone, Copy, Debug)]
pub struct Operation {
    row: &'static Row,
    code: u32,
}

/// The operation of the instruction made of these halfwords, if the table has it.
pub fn operation(first: u16, second: u16) -> Option<Operation> {
    let (row, code) = found(first, second);
    let row = row.filter(|row| !row.operation.is_empty())?;
    Some(Operation { row, code })
}

impl Operation {
    pub fn name(&self) -> &'static str {
        self.row.operation[0]
    }

    /// A field, if the instruction has it.
    pub fn field(&self, name: &str) -> Option<u32> {
        let number = |word: &&str| word.strip_prefix(name)?.strip_prefix('=')?.parse().ok();
        let given = self.row.operation[1..].iter().find_map(number);
        let is_there = || (self.row.names.iter()).any(|letter| name.starts_with(*letter));
        given.or_else(|| is_there().then(|| self.row.field(self.code, name)))
    }
}

/// The first row that fits, and both halfwords together.
fn found(first: u16, second: u16) -> (Option<&'static Row>, u32) {
    static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
        let lines = include_str!("decode.txt").lines();
        lines.filter_map(Row::read).collect()
    });
    let second = if size(first) == 4 { second } else { 0 };
    let code = u32::from(first) << 16 | u32::from(second);
    let row = ROWS.iter().find(|row| code & row.mask == row.bits);
    (row, code)
}

const SP: u32 = 13;
const PC: u16 = 1 << 15;

#[derive(Debug)]
struct Row {
    /// The bits that are fixed, and what they are.
    mask: u32,
    bits: u32,
    /// The names of the bits from the highest on.
    names: Vec<char>,
    class: &'static str,
    words: Vec<&'static str>,
    /// Its name, and fields that are not among the bits.
    operation: Vec<&'static str>,
}

impl Row {
    fn read(line: &'static str) -> Option<Self> {
        let (bits, words) = line.split("//").next()?.split_once(": ")?;
        let names: Vec<char> = bits.chars().filter(|name| *name != ' ').collect();
        let of = |wanted: &str| {
            let bits = names.iter().zip((0..32).rev());
            let bits = bits.filter(|(name, _)| wanted.contains(**name));
            bits.fold(0, |sum, (_, bit)| sum | 1 << bit)
        };
        let (mask, bits) = (of("01"), of("1"));
        let mut words = words.split_whitespace();
        let class = words.next()?;
        let mut next = || words.by_ref().take_while(|word| *word != "=>").collect();
        let (words, operation) = (next(), next());
        Some(Self { mask, bits, names, class, words, operation })
    }

    fn insn(&self, code: u32, size: u8) -> Insn {
        let mut insn = Insn::new(self.class(code), size);
        for word in &self.words {
            let (verb, what) = word.split_once('=').unwrap_or((word, ""));
            insn = match verb {
                "to" => insn.writing(self.core(code, what)),
                "result" => insn.writing(self.core(code, what) & !PC),
                "list" => insn.writing(self.field(code, what) as u16),
                "pop" => {
                    let set = self.field(code, what);
                    insn.writing((set & 0xFF | (set & 0x100) << 7) as u16)
                }
                "at" => insn.addressed_by(self.core(code, what)),
                "reads" => insn.on_floats(self.floats(code, what), 0),
                "writes" => insn.on_floats(insn.float_reads, self.floats(code, what)),
                "float" => insn.on_floats(0, 0),
                "branch" => insn.branching(),
                "indirect" => Insn { indirect: true, ..insn },
                "return" => insn.returning_if(true),
                _ => unreachable!("decode.txt has no word {word}"),
            };
        }
        insn
    }

    fn class(&self, code: u32) -> Class {
        match self.class {
            "Integer" => Class::Integer,
            "IfThen" => Class::IfThen,
            "IntegerDivide" => Class::IntegerDivide,
            "System" => Class::System,
            "InstructionBarrier" => Class::InstructionBarrier,
            "Load" => Class::Load,
            "Store" => Class::Store,
            "TableBranch" => Class::TableBranch,
            "FloatMove" => Class::FloatMove,
            "FloatMovePair" => Class::FloatMovePair,
            "FloatArithmetic" => Class::FloatArithmetic,
            "FloatConversion" => Class::FloatConversion,
            "FloatMultiplyAdd" => Class::FloatMultiplyAdd,
            "FloatDivide" => Class::FloatDivide,
            "Unknown" => Class::Unknown,
            "Marker" => Class::Marker(Marker {
                region: self.field(code, "r") as u8,
                opens: self.field(code, "o") == 0,
            }),
            words => match words.split_once(['#', '=']) {
                Some((_, set)) if words.contains('#') => {
                    Class::Words(self.field(code, set).count_ones() as u8)
                }
                Some((_, number)) => Class::Words(self.number(code, number) as u8),
                None => unreachable!("decode.txt has no class {words}"),
            },
        }
    }

    /// The bits of this name, together.
    fn field(&self, code: u32, name: &str) -> u32 {
        let bits = self.names.iter().zip((0..32).rev());
        let bits = bits.filter(|(other, _)| name.starts_with(**other));
        bits.fold(0, |value, (_, bit)| value << 1 | code >> bit & 1)
    }

    /// A number of registers: itself, or a field, doubled or not.
    fn number(&self, code: u32, name: &str) -> u32 {
        let doubled = u32::from(name.ends_with('0'));
        let number = name.parse().unwrap_or(self.field(code, name) << doubled);
        number.min(32)
    }

    /// Core registers, each by its field.
    fn core(&self, code: u32, names: &str) -> u16 {
        let register = |name: &str| match name {
            "S" => SP,
            field => self.field(code, field),
        };
        let names = names.split_inclusive(|_| true);
        names.fold(0, |set, name| set | 1 << register(name))
    }

    fn floats(&self, code: u32, sets: &str) -> u32 {
        let set = |set: &str| {
            let (first, count) = set.split_once('+').unwrap_or((set, "1"));
            let low = self.field(code, &first[1..]);
            let high = self.field(code, &first[1..].to_uppercase());
            let first = match first.starts_with('D') {
                true => (high << 4 | low) << 1,
                false => low << 1 | high,
            };
            let registers = (1_u64 << self.number(code, count)) - 1;
            // Those of a double beyond d15, which a Cortex-M4F lacks, are beyond the 32 bits.
            (registers << first) as u32
        };
        sets.split(',').fold(0, |all, one| all | set(one))
    }
}
