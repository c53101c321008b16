//! Thumb-2 and FPv4-SP encodings to [`Insn`]; section numbers are those of the
//! ARMv7-M Architecture Reference Manual (DDI 0403).

mod float;
mod relative;
mod wide;

pub use relative::{Relative, relative};

use crate::insn::{Class, Insn};

/// Size in bytes of the instruction that starts with this halfword (A5.1).
pub const fn size(first: u16) -> u8 {
    if first >> 11 >= 0b11101 { 4 } else { 2 }
}

/// The instruction made of these halfwords; the second counts only if [`size`] is 4.
pub fn decode(first: u16, second: u16) -> Insn {
    if size(first) == 4 {
        wide::decode(first, second)
    } else {
        narrow(first)
    }
}

/// The set of one register, whose number stands at bit `low` of the encoding.
const fn register(encoding: u16, low: u32, bits: u32) -> u16 {
    1 << (encoding >> low & ((1 << bits) - 1))
}

const SP: u16 = 1 << 13;
const PC: u16 = 1 << 15;
/// The number of the link register.
const LR: u16 = 14;

/// 16-bit encodings (A5.2).
fn narrow(code: u16) -> Insn {
    let integer = Insn::new(Class::Integer, 2);
    let transfer = |loads: bool, data: u16| match loads {
        true => Insn::new(Class::Load, 2).writing(data),
        false => Insn::new(Class::Store, 2),
    };
    let low = register(code, 0, 3);
    let high = register(code, 8, 3);
    let loads = code & 0x0800 != 0;
    match code >> 11 {
        0b00000..=0b00011 => integer.writing(low),
        0b00101 => integer, // CMP
        0b00100 | 0b00110 | 0b00111 => integer.writing(high),
        0b01000 if code & 0x0400 == 0 => match code >> 6 & 0xF {
            8 | 10 | 11 => integer, // TST, CMP, CMN
            _ => integer.writing(low),
        },
        0b01000 => match code >> 8 & 3 {
            1 => integer, // CMP
            3 => Insn {
                indirect: code & 0x80 != 0 || code >> 3 & 0xF != LR, // BLX, BX
                ..integer.branching()
            },
            _ => integer
                .writing(1 << (code >> 4 & 8 | code & 7))
                .returning_if(code >> 3 & 0xF == LR),
        },
        0b01001 => transfer(true, high), // literal
        0b01010 | 0b01011 => {
            let address = register(code, 3, 3) | register(code, 6, 3);
            transfer(code >> 9 & 7 >= 3, low).addressed_by(address)
        }
        0b01100..=0b10001 => transfer(loads, low).addressed_by(register(code, 3, 3)),
        0b10010 | 0b10011 => transfer(loads, high).addressed_by(SP),
        0b10100 | 0b10101 => integer.writing(high), // ADR, ADD from SP
        0b10110 | 0b10111 => miscellaneous(code),
        0b11000 => several(code & 0xFF).addressed_by(high),
        0b11001 => several(code & 0xFF).writing(code & 0xFF).addressed_by(high),
        0b11010..=0b11100 => integer.branching(), // B, SVC, UDF
        _ => Insn::new(Class::Unknown, 2),
    }
}

/// A transfer of these registers.
fn several(registers: u16) -> Insn {
    Insn::new(Class::Words(registers.count_ones() as u8), 2)
}

/// 16-bit miscellaneous encodings (A5.2.5).
fn miscellaneous(code: u16) -> Insn {
    let integer = Insn::new(Class::Integer, 2);
    match code >> 8 & 0xF {
        0 => integer.writing(SP),
        1 | 3 | 9 | 11 => integer.branching(), // CBZ, CBNZ
        2 | 10 => integer.writing(register(code, 0, 3)),
        4 | 5 => several(code & 0xFF | (code & 0x100) << 6).addressed_by(SP),
        6 => Insn::new(Class::System, 2), // CPS
        12 | 13 => {
            let registers = code & 0xFF | (code & 0x100) << 7;
            let pop = several(registers).writing(registers);
            pop.returning_if(true).addressed_by(SP)
        }
        14 => integer.branching(), // BKPT
        15 => integer,             // IT and hints
        _ => Insn::new(Class::Unknown, 2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_halfword_tells_the_size() {
        for (first, expected) in [
            (0xBF00, 2),
            (0xE7FE, 2),
            (0xE800, 4),
            (0xEE30, 4),
            (0xF000, 4),
            (0xFFFF, 4),
        ] {
            assert_eq!(size(first), expected, "{first:#06x}");
        }
    }

    #[test]
    fn narrow_results_and_addresses_are_found() {
        let cases = [
            (0x1C48, Class::Integer, 0, 1 << 0),            // adds r0, r1, #1
            (0x2901, Class::Integer, 0, 0),                 // cmp r1, #1
            (0x4348, Class::Integer, 0, 1 << 0),            // muls r0, r1, r0
            (0x4208, Class::Integer, 0, 0),                 // tst r0, r1
            (0x4684, Class::Integer, 0, 1 << 12),           // mov r12, r0
            (0x4801, Class::Load, 0, 1 << 0),               // ldr r0, [pc, #4]
            (0x5688, Class::Load, 1 << 1 | 1 << 2, 1),      // ldrsb r0, [r1, r2]
            (0x5088, Class::Store, 1 << 1 | 1 << 2, 0),     // str r0, [r1, r2]
            (0x6848, Class::Load, 1 << 1, 1 << 0),          // ldr r0, [r1, #4]
            (0x8048, Class::Store, 1 << 1, 0),              // strh r0, [r1, #2]
            (0x9801, Class::Load, SP, 1 << 0),              // ldr r0, [sp, #4]
            (0xB082, Class::Integer, 0, SP),                // sub sp, #8
            (0xB5F0, Class::Words(5), SP, 0),               // push {r4-r7, lr}
            (0xBC30, Class::Words(2), SP, 1 << 4 | 1 << 5), // pop {r4, r5}
            (0xC807, Class::Words(3), 1 << 0, 7),           // ldm r0, {r0, r1, r2}
            (0xBF08, Class::Integer, 0, 0),                 // it eq
            (0xB672, Class::System, 0, 0),                  // cpsid i
        ];
        for (code, class, address, writes) in cases {
            let insn = decode(code, 0);
            assert_eq!(
                (insn.class, insn.address, insn.core_writes),
                (class, address, writes),
                "{code:#06x}"
            );
            assert!(!insn.may_branch, "{code:#06x}");
        }
    }

    #[test]
    fn a_branch_through_any_register_is_indirect_and_a_return_is_not() {
        // blx r3, blx lr, bx r3, mov pc, r3, add pc, r3, ldr.w pc, [r3], ldr.w pc, [pc, #4], ldm.w r0, {r1, pc}
        let indirect = [
            [0x4798, 0],
            [0x47F0, 0],
            [0x4718, 0],
            [0x469F, 0],
            [0x449F, 0],
            [0xF8D3, 0xF000],
            [0xF8DF, 0xF004],
            [0xE890, 0x8002],
        ];
        // bx lr, mov pc, lr, mov r0, r3, pop {pc}, pop.w {r4, pc}, ldr pc, [sp], #4, b, bl, svc
        let direct = [
            [0x4770, 0],
            [0x46F7, 0],
            [0x4618, 0],
            [0xBD00, 0],
            [0xE8BD, 0x8010],
            [0xF85D, 0xFB04],
            [0xE07E, 0],
            [0xF000, 0xF87E],
            [0xDF00, 0],
        ];
        for [first, second] in indirect {
            assert!(decode(first, second).indirect, "{first:#06x}");
        }
        for [first, second] in direct {
            assert!(!decode(first, second).indirect, "{first:#06x}");
        }
    }

    #[test]
    fn opcodes_beyond_an_m4f_are_distinguished_from_its_own() {
        let beyond = |first, second| decode(first, second).class == Class::Unknown;
        assert!(beyond(0xfe00, 0x0a00)); // vseleq.f32 s0, s0, s0
        assert!(beyond(0xfe00, 0x0b00)); // vseleq.f64 d0, d0, d0
        assert!(beyond(0xfe80, 0x0b00)); // vmaxnm.f64 d0, d0, d0
        assert!(beyond(0xfeb8, 0x0a40)); // vrinta.f32 s0, s0
        assert!(beyond(0xeeb6, 0x0a40)); // vrintr.f32 s0, s0
        assert!(beyond(0xeeb7, 0x0ac0)); // vcvt.f64.f32 d0, s0
        assert!(beyond(0xee30, 0x0b00)); // vadd.f64 d0, d0, d0
        assert!(beyond(0xea51, 0x8002)); // csel r0, r1, r2, eq
        assert!(beyond(0xf040, 0xe001)); // dls lr, r0
        assert!(beyond(0xe8d0, 0x1faf)); // lda r1, [r0]
        assert!(!beyond(0xea51, 0x0002)); // orrs.w r0, r1, r2
        assert!(!beyond(0xf7ff, 0xff7e)); // bl
        assert!(!beyond(0xe8d0, 0x1f4f)); // ldrexb r1, [r0]
        assert!(!beyond(0xee30, 0x0a00)); // vadd.f32 s0, s0, s0
        assert!(!beyond(0xed2d, 0x8b02)); // vpush {d8}
        assert!(!beyond(0xee00, 0x0b10)); // vmov.32 d0[0], r0
    }

    #[test]
    fn narrow_branches_are_found() {
        // b, bne, bx lr, blx r3, cbz, pop {pc}, mov pc, svc, bkpt
        for code in [
            0xE7FE, 0xD1FD, 0x4770, 0x4798, 0xB108, 0xBD00, 0x46F7, 0xDF00, 0xBEAB,
        ] {
            assert!(decode(code, 0).may_branch, "{code:#06x}");
        }
    }
}
