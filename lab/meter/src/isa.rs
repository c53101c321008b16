//! The instruction sets whose instructions are counted. Only the Cortex-M4F has a model of its cycles.

use crate::decode;
use crate::insn::{Class, Insn, Marker};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Isa {
    /// The code of a Cortex-M4F, with cycles and floating-point operations.
    #[default]
    CortexM4F,
    /// The code of another core of ARMv7-M, or of ARMv8-M with the main extension.
    Thumb2,
    /// The code of ARMv6-M, which has no `dbg`: markers are moves of a register to itself.
    Armv6M,
    /// RISC-V with or without compressed instructions: markers are `slti x0, x0, k`.
    RiscV,
}

impl Isa {
    /// By its name on the command line.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "thumb2" => Some(Self::Thumb2),
            "armv6m" => Some(Self::Armv6M),
            "riscv" => Some(Self::RiscV),
            _ => None,
        }
    }

    /// Whether cycles and floating-point operations are known.
    pub fn is_modelled(self) -> bool {
        self == Self::CortexM4F
    }

    /// The instruction of these bytes; those behind a short one count nothing.
    pub fn decode(self, code: [u8; 4]) -> Insn {
        let [first, second] = [0, 2].map(|at| u16::from_le_bytes([code[at], code[at + 1]]));
        match self {
            Self::CortexM4F | Self::Thumb2 => decode::decode(first, second),
            Self::Armv6M => {
                let marker = move_to_itself(first).and_then(marker_of_register);
                let insn = || decode::decode(first, second);
                marker.map_or_else(insn, |marker| Insn::new(Class::Marker(marker), 2))
            }
            Self::RiscV => risc_v(u32::from_le_bytes(code)),
        }
    }
}

/// The register of a `mov rN, rN`.
fn move_to_itself(code: u16) -> Option<u16> {
    let (to, from) = (code >> 4 & 8 | code & 7, code >> 3 & 15);
    (code >> 8 == 0x46 && to == from).then_some(to)
}

/// Regions 0 to 5; `mov r8, r8` is a NOP, and the stack pointer, the link register and the PC are no markers.
fn marker_of_register(register: u16) -> Option<Marker> {
    let number = match register {
        0..=7 | 9 => register,
        10 => 8,
        12 => 10,
        11 => 11,
        _ => return None,
    };
    Some(marker(number.into()))
}

fn marker(number: u32) -> Marker {
    Marker {
        region: (number / 2) as u8,
        opens: number.is_multiple_of(2),
    }
}

/// All that is known of an instruction of RISC-V is its size, and whether it is a marker.
fn risc_v(code: u32) -> Insn {
    let is_long = code & 3 == 3;
    // `slti x0, x0, k` with k from 0 to 15.
    if is_long && code & 0xff0f_ffff == 0x0000_2013 {
        return Insn::new(Class::Marker(marker(code >> 20)), 4);
    }
    Insn::new(Class::Integer, if is_long { 4 } else { 2 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marker_in(isa: Isa, code: u32) -> Option<Marker> {
        let insn = isa.decode(code.to_le_bytes());
        match insn.class {
            Class::Marker(marker) => Some(marker),
            _ => None,
        }
    }

    fn markers(isa: Isa, codes: &[u32]) -> Vec<(u8, bool)> {
        let found = codes.iter().filter_map(|code| marker_in(isa, *code));
        found.map(|marker| (marker.region, marker.opens)).collect()
    }

    #[test]
    fn armv6m_markers_are_moves_of_registers_to_themselves() {
        // mov rN, rN, in the order of the regions.
        let codes = [
            0x4600, 0x4609, 0x4612, 0x461b, 0x4624, 0x462d, 0x4636, 0x463f, 0x46d2, 0x46c9, 0x46e4,
            0x46db,
        ];
        let expected: Vec<(u8, bool)> = (0..6).flat_map(|k| [(k, true), (k, false)]).collect();
        assert_eq!(markers(Isa::Armv6M, &codes), expected);
        // mov r8, r8; mov sp, sp; mov lr, lr; mov r0, r1; mov r8, r0; movs r0, r0
        let others = [0x46c0, 0x46ed, 0x46f6, 0x4608, 0x4680, 0x0000];
        assert!(markers(Isa::Armv6M, &others).is_empty());
        // Cores that have `dbg` take them for what they are.
        assert!(markers(Isa::Thumb2, &codes).is_empty());
    }

    #[test]
    fn hints_for_custom_use_are_the_markers_of_risc_v() {
        let codes: Vec<u32> = (0..16).map(|k| 0x2013 | k << 20).collect();
        let expected: Vec<(u8, bool)> = (0..8).flat_map(|k| [(k, true), (k, false)]).collect();
        assert_eq!(markers(Isa::RiscV, &codes), expected);
        // slti x0, x0, 16; slti x1, x0, 0; slti x0, x1, 0; addi x0, x0, 0
        let others = [0x0100_2013, 0x0000_2093, 0x0000_a013, 0x0000_0013];
        assert!(markers(Isa::RiscV, &others).is_empty());
    }

    #[test]
    fn the_two_lowest_bits_give_a_riscv_instructions_size() {
        for (code, size) in [(0x0000_0013, 4), (0x0001, 2), (0x4501, 2), (0x8082, 2)] {
            let insn = Isa::RiscV.decode(u32::to_le_bytes(code));
            assert_eq!(insn.size, size, "{code:#x}");
        }
    }
}
