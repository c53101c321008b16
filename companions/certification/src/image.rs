//! Machine code and constants of a linked program, by address.

use std::collections::BTreeSet;

use cycle_meter::Relative;
use object::{Object, ObjectSection, ObjectSymbol, SectionKind};
use sha2::{Digest, Sha256};

use crate::error::{Error, Result};

/// The parts of a program that lie in flash, and its symbols.
#[derive(Clone, Debug, Default)]
pub struct Image {
    /// First address and bytes of each section.
    sections: Vec<(u32, Vec<u8>)>,
    /// Name, address and size, sorted by address.
    symbols: Vec<(String, u32, u32)>,
    /// The addresses where code begins behind data, sorted: the symbols `$t` of the ARM ABI.
    code: Vec<u32>,
}

impl Image {
    /// The code and constants of an ELF.
    ///
    /// # Errors
    /// [`Error::Elf`].
    pub fn read(elf: &[u8]) -> Result<Self> {
        let file = object::File::parse(elf).map_err(|e| Error::Elf(e.to_string()))?;
        let is_flash = |kind| {
            use SectionKind::{ReadOnlyData, ReadOnlyString, Text};
            matches!(kind, Text | ReadOnlyData | ReadOnlyString)
        };
        let flash = file.sections().filter(|section| is_flash(section.kind()));
        let sections =
            flash.filter_map(|one| Some((one.address() as u32, one.data().ok()?.to_vec())));
        let sized = file.symbols().filter(|symbol| symbol.size() > 0);
        let symbols = sized.map(|symbol| {
            let name = symbol.name().unwrap_or_default().to_owned();
            // The lowest bit of a function's address says Thumb.
            (name, symbol.address() as u32 & !1, symbol.size() as u32)
        });
        let mut symbols: Vec<_> = symbols.collect();
        symbols.sort_by_key(|symbol| symbol.1);
        let is_code = |name: &str| name == "$t" || name.starts_with("$t.");
        let marks = file.symbols().filter(|one| one.name().is_ok_and(is_code));
        let mut code: Vec<u32> = marks.map(|one| one.address() as u32).collect();
        code.sort_unstable();
        Ok(Self { sections: sections.collect(), symbols, code })
    }

    /// An image of these bytes from an address on, for tests of code that is written by hand.
    pub fn of(address: u32, bytes: &[u8]) -> Self {
        Self { sections: vec![(address, bytes.to_vec())], symbols: Vec::new(), code: Vec::new() }
    }

    /// The same with a function that has a name.
    pub fn with_function(mut self, name: &str, address: u32, size: u32) -> Self {
        self.symbols.push((name.to_owned(), address, size));
        self
    }

    /// The bytes from an address on.
    fn from(&self, address: u32) -> Option<&[u8]> {
        self.sections.iter().find_map(|(start, bytes)| {
            let at = address.checked_sub(*start)? as usize;
            bytes.get(at..).filter(|rest| !rest.is_empty())
        })
    }

    /// The halfword at an address.
    pub fn half(&self, address: u32) -> Option<u16> {
        Some(u16::from_le_bytes(*self.from(address)?.first_chunk()?))
    }

    /// The word at an address.
    pub fn word(&self, address: u32) -> Option<u32> {
        Some(u32::from_le_bytes(*self.from(address)?.first_chunk()?))
    }

    /// First address and size of the function that holds an address.
    pub fn function(&self, at: u32) -> Option<(u32, u32)> {
        let symbols = self.symbols.iter().map(|(_, start, size)| (*start, *size));
        let mut holding = symbols.filter(|(start, size)| at.wrapping_sub(*start) < *size);
        holding.next()
    }

    /// All names of the function at an address.
    pub fn names(&self, at: u32) -> impl Iterator<Item = &str> {
        let here = self.symbols.iter().filter(move |symbol| symbol.1 == at);
        here.map(|symbol| &*symbol.0)
    }

    /// The address at which the data at an address ends, if the program says it.
    pub fn code_after(&self, data: u32) -> Option<u32> {
        let after = self.code.partition_point(|at| *at <= data);
        self.code.get(after).copied()
    }

    /// The name of the function that holds an address: the last parts of its path, without the
    /// hash.
    pub fn name(&self, at: u32) -> Option<String> {
        let mut symbols = self.symbols.iter();
        let (name, ..) = symbols.find(|(_, start, size)| at.wrapping_sub(*start) < *size)?;
        let (mut parts, mut rest) = (Vec::new(), name.strip_prefix("_ZN").unwrap_or_default());
        while let Some(end) = rest.find(|c: char| !c.is_ascii_digit()).filter(|end| *end > 0) {
            let length = rest[..end].parse().unwrap_or(usize::MAX);
            let Some((part, after)) = rest[end..].split_at_checked(length) else {
                break;
            };
            // A type is shown by its name, without its path and parameters.
            let part = part.trim_start_matches("_$LT$").trim_start_matches("impl$u20$");
            let part = part.split('$').next().unwrap_or_default();
            parts.push(part.rsplit("..").next().unwrap_or_default());
            rest = after;
        }
        parts.pop();
        let last = parts.split_off(parts.len().saturating_sub(2));
        Some(if last.is_empty() { name.clone() } else { last.join("::") })
    }

    /// The address and the words of the variable of a name, whatever its path and hash.
    ///
    /// # Errors
    /// [`Error::Missing`].
    pub fn variable(&self, name: &str) -> Result<(u32, Vec<u32>)> {
        let mut symbols = self.symbols.iter();
        let found = symbols.find(|(symbol, _, _)| symbol.contains(name));
        let (_, address, size) = found.ok_or_else(|| Error::Missing(name.to_owned()))?;
        let words = (0..size / 4).map(|i| self.word(address + 4 * i));
        let words: Option<Vec<u32>> = words.collect();
        Ok((*address, words.ok_or_else(|| Error::Missing(name.to_owned()))?))
    }

    /// SHA-256 of the functions that hold these addresses, each from its first instruction to its
    /// last literal.
    ///
    /// The hash is the same at any address: a branch from one function to another has no distance,
    /// and the functions are sorted by their bytes.
    pub fn hash(&self, visited: &[u32]) -> String {
        let mut functions: Vec<Vec<u8>> = Vec::new();
        let mut last = None;
        for &(_, start, size) in &self.symbols {
            let first = visited.partition_point(|address| *address < start);
            let is_visited = visited.get(first).is_some_and(|address| address - start < size);
            // A second name of the same function is passed over.
            if is_visited && last.replace(start) != Some(start) {
                functions.push(self.relocatable(start, size));
            }
        }
        functions.sort_unstable();
        let mut hash = Sha256::new();
        functions.iter().for_each(|bytes| hash.update(bytes));
        hexadecimal(hash)
    }

    /// The bytes of a function, with the distance set to zero in each branch that leaves it.
    fn relocatable(&self, start: u32, size: u32) -> Vec<u8> {
        let bytes = self.from(start).and_then(|bytes| bytes.get(..size as usize));
        let mut bytes = bytes.unwrap_or_default().to_vec();
        let (mut literals, mut address) = (BTreeSet::new(), start);
        while address - start < size {
            if literals.contains(&address) {
                address = self.code_after(address).unwrap_or(start + size);
                continue;
            }
            let [first, second] = [0, 2].map(|at| self.half(address + at).unwrap_or(0));
            let relative = cycle_meter::relative(address, first, second);
            literals.extend(relative.iter().filter(|one| one.words > 0).map(|one| one.target));
            let leaves = |one: &Relative| one.words == 0 && one.target.wrapping_sub(start) >= size;
            for (k, bits) in relative
                .into_iter()
                .filter(leaves)
                .flat_map(|one| [(0, one.bits[0]), (2, one.bits[1])])
            {
                let at = (address - start) as usize + k;
                let [low, high] = (!bits).to_le_bytes();
                if let Some([a, b]) = bytes.get_mut(at..at + 2) {
                    (*a, *b) = (*a & low, *b & high);
                }
            }
            address += u32::from(cycle_meter::size(first));
        }
        bytes
    }
}

/// The digits of a hash.
pub(crate) fn hexadecimal(hash: Sha256) -> String {
    let bytes = hash.finalize();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::Image;

    /// The hash of a function that calls another and then executes this instruction.
    fn hash(distance: u16, instruction: u16) -> String {
        let code = [0xF000, 0xF800 | distance, instruction, 0x4770];
        let bytes: Vec<u8> = code.iter().flat_map(|half: &u16| half.to_le_bytes()).collect();
        Image::of(0x800, &bytes).with_function("f", 0x800, 8).hash(&[0x800])
    }

    #[test]
    fn the_place_of_a_called_function_does_not_count_but_each_instruction_does() {
        assert_eq!(hash(0x10, 0xBF00), hash(0x20, 0xBF00));
        assert_ne!(hash(0x10, 0xBF00), hash(0x10, 0x3001));
        // A branch within the function keeps its distance.
        assert_ne!(hash(0x10, 0xBF00), hash(0, 0xBF00));
    }
}
