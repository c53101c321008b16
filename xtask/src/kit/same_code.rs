//! Whether two functions of an image are the same code: instruction for instruction, whatever their
//! addresses and the places of their literals.

use crate::kit::callgraph::Instruction;
use crate::kit::elf::{Function, Image};
use crate::kit::error::{Result, bail, check, refuse_if};

/// An instruction, with what it reaches instead of how far away that is.
#[derive(Debug, PartialEq, Eq)]
struct Act {
    opcode: [u16; 2],
    /// The target outside its function.
    leaves: Option<u32>,
    /// The literals that it loads.
    words: Vec<u32>,
}

/// The number of instructions that two functions have in common.
///
/// # Errors
/// They are not the same, or there are no such functions.
pub fn same(image: &Image, one: u64, other: u64) -> Result<usize> {
    let [a, b] = [one, other].map(|address| function(image, address).map(acts));
    let (a, b) = (a?, b?);
    if let Some(at) = std::iter::zip(&a, &b).position(|(a, b)| a != b) {
        bail!("instruction {at} of {one:#x} is {:x?}, that of {other:#x} {:x?}", a[at], b[at]);
    }
    let [many, others] = [a.len(), b.len()];
    refuse_if!(many != others, "{one:#x} has {many} instructions, {other:#x} {others}");
    Ok(many)
}

/// The function at an address, or that which it does nothing but jump to: the compiler makes such
/// jumps where it finds two functions the same.
fn function(image: &Image, address: u64) -> Result<&Function> {
    let at = |address: u64| image.functions.iter().find(|f| f.address == address);
    let nothing = || check!("there is no function at {address:#x}");
    let found = at(address).ok_or_else(nothing)?;
    let instructions = found.instructions();
    let jump = instructions.first().filter(|_| instructions.len() == 1);
    let target = jump.and_then(|jump| jump.target()).and_then(at);
    Ok(target.unwrap_or(found))
}

fn acts(function: &Function) -> Vec<Act> {
    let instructions = function.instructions().into_iter();
    instructions.map(|one| act(function, one)).collect()
}

fn act(function: &Function, instruction: Instruction) -> Act {
    let plain = Act { opcode: instruction.code, leaves: None, words: Vec::new() };
    let Some(reached) = instruction.relative() else {
        return plain;
    };
    let is_own = function.contains(reached.target.into());
    if is_own && reached.words == 0 {
        return plain;
    }
    let bytes = |n: u32| {
        let at = u64::from(reached.target + 4 * n).checked_sub(function.address)? as usize;
        let bytes = function.bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    let words: Option<Vec<u32>> = (0..reached.words).map(bytes).collect();
    Act {
        opcode: [0, 1].map(|half| instruction.code[half] & !reached.bits[half]),
        // Beyond its own end it loads no literal of its own.
        leaves: (!is_own || words.is_none()).then_some(reached.target),
        words: words.unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::same;
    use crate::kit::elf::{Function, Image};

    /// Loads a literal from where it lies, calls 0x2000, returns.
    fn function(address: u64, call: [u16; 2], literal: u32, padding: usize) -> Function {
        let load = 0x4800 | (2 + padding / 2) as u16;
        let code = [load, call[0], call[1], 0x4770, 0xbf00, 0xbf00];
        let mut function = Function::of(&format!("f{address:x}"), address, &code);
        function.bytes.resize(12 + 2 * padding, 0);
        function.bytes.extend(literal.to_le_bytes());
        function.data.push((address + 12, true));
        function
    }

    #[test]
    fn code_is_the_same_wherever_it_lies() {
        // Both calls go to 0x2000: from 0x1002 it is 0xffa ahead, from 0x1102 0xefa.
        let (one, two) = ([0xf000, 0xfffd], [0xf000, 0xff7d]);
        let image = Image::of(vec![
            function(0x1000, one, 1.5_f32.to_bits(), 0),
            function(0x1100, two, 1.5_f32.to_bits(), 2),
            function(0x1200, two, 1.5_f32.to_bits(), 0),
            function(0x1300, one, 2.5_f32.to_bits(), 0),
        ]);
        assert_eq!(same(&image, 0x1000, 0x1100).expect("the same"), 5);
        assert!(same(&image, 0x1000, 0x1200).is_err()); // calls another
        assert!(same(&image, 0x1000, 0x1300).is_err()); // and loads another number
        assert!(same(&image, 0x1000, 0x1400).is_err());
    }

    #[test]
    fn a_function_that_only_jumps_is_where_it_jumps_to() {
        let code = function(0x1000, [0xf000, 0xfffd], 7, 0);
        let jump = Function::of("jump", 0x1100, &[0xe77e]); // b 0x1000
        let image = Image::of(vec![code, jump]);
        assert_eq!(same(&image, 0x1000, 0x1100).expect("the same"), 5);
    }
}
