//! 32-bit encodings other than floating point (A5.3).

use super::{PC, float, register};
use crate::insn::{Class, Insn, Marker};

const SP_NUMBER: u16 = 13;

pub(super) fn decode(first: u16, second: u16) -> Insn {
    let integer = Insn::new(Class::Integer, 4);
    let result = register(second, 8, 4);
    if first & 0xEC00 == 0xEC00 {
        return float::decode(first, second);
    }
    match first >> 9 & 0x7F {
        0x74 if first & 0x40 == 0 => load_store_multiple(first, second),
        0x74 => double_exclusive_table(first, second),
        // CSEL and its kin.
        0x75 if first & 0x1F0 == 0x50 && second & 0x8000 != 0 => Insn::new(Class::Unknown, 4),
        0x75 => data_processing(second),
        // Immediate operands and branches share their first halfwords.
        0x78..=0x7B if second & 0x8000 != 0 => branches_and_control(first, second),
        0x78 | 0x7A => data_processing(second),
        0x79 | 0x7B => integer.writing(result), // plain immediates, MOVW, MOVT, bit fields
        0x7C => load_store_single(first, second),
        0x7D if first & 0x180 == 0x180 => match first >> 4 & 7 {
            1 | 3 => Insn::new(Class::IntegerDivide, 4).writing(result),
            _ => integer.writing(result | register(second, 12, 4)),
        },
        0x7D => integer.writing(result), // shifts by register, parallel sums, multiplications
        _ => Insn::new(Class::Unknown, 4),
    }
}

/// Shifted register or modified immediate (A5.3.1, A5.3.11).
fn data_processing(second: u16) -> Insn {
    let integer = Insn::new(Class::Integer, 4);
    // Without a register for it (TST, TEQ, CMN, CMP) the result is the flags only.
    match register(second, 8, 4) {
        PC => integer,
        result => integer.writing(result),
    }
}

/// LDM, STM, PUSH, POP (A5.3.5).
fn load_store_multiple(first: u16, second: u16) -> Insn {
    let words = Class::Words(second.count_ones() as u8);
    let insn = Insn::new(words, 4).addressed_by(register(first, 0, 4));
    match first & 0x10 {
        0 => insn,
        _ => insn.writing(second).returning_if(first & 0xF == SP_NUMBER),
    }
}

/// LDRD, STRD, exclusives, table branches (A5.3.6).
fn double_exclusive_table(first: u16, second: u16) -> Insn {
    let base = register(first, 0, 4);
    let loads = first & 0x10 != 0;
    let data = register(second, 12, 4);
    if first & 0x120 != 0 {
        let written = if loads {
            data | register(second, 8, 4)
        } else {
            0
        };
        return Insn::new(Class::Words(2), 4)
            .addressed_by(base)
            .writing(written);
    }
    // Load-acquire and store-release.
    if first & 0x80 != 0 && matches!(second >> 4 & 0xF, 0x8 | 0x9 | 0xA | 0xC | 0xD | 0xE) {
        return Insn::new(Class::Unknown, 4);
    }
    // STREX is timed like LDREX, and that like LDR (TRM 3.3.3).
    let exclusive = Insn::new(Class::Load, 4).addressed_by(base);
    match (first & 0x80 != 0, loads) {
        (false, true) => exclusive.writing(data),
        (false, false) => exclusive.writing(register(second, 8, 4)),
        (true, true) if second & 0xE0 == 0 => Insn::new(Class::TableBranch, 4)
            .addressed_by(base | register(second, 0, 4))
            .branching(),
        (true, true) => exclusive.writing(data),
        (true, false) => exclusive.writing(register(second, 0, 4)),
    }
}

/// Branches, hints, barriers, special registers (A5.3.4).
fn branches_and_control(first: u16, second: u16) -> Insn {
    let integer = Insn::new(Class::Integer, 4);
    let system = Insn::new(Class::System, 4);
    // Low-overhead loops.
    if second & 0x5000 == 0x4000 {
        return Insn::new(Class::Unknown, 4);
    }
    // B, BL; the link register forms no address before the callee spills it.
    if second & 0x5000 != 0 || first & 0x0380 != 0x0380 {
        return integer.branching();
    }
    match first {
        0xF3AF if second & 0xFFF0 == 0x80F0 => {
            let (region, opens) = ((second as u8 & 0xF) >> 1, second & 1 == 0);
            Insn::new(Class::Marker(Marker { region, opens }), 4)
        }
        0xF3AF => integer,
        0xF3BF if second & 0xF0 == 0x60 => Insn::new(Class::InstructionBarrier, 4),
        0xF3BF => integer, // DSB, DMB, CLREX
        0xF380..=0xF39F => system,
        0xF3E0..=0xF3FF => system.writing(register(second, 8, 4)),
        0xF7F0..=0xF7FF => integer.branching(), // UDF
        _ => Insn::new(Class::Unknown, 4),
    }
}

/// LDR, STR and their narrow kin, PLD (A5.3.7 to A5.3.10).
fn load_store_single(first: u16, second: u16) -> Insn {
    let base = register(first, 0, 4);
    let data = register(second, 12, 4);
    let by_register = first & 0x80 == 0 && second & 0xFC0 == 0 && base != PC;
    let index = if by_register {
        register(second, 0, 4)
    } else {
        0
    };
    let address = base | index;
    if first & 0x10 == 0 {
        return Insn::new(Class::Store, 4).addressed_by(address);
    }
    // Byte and halfword loads into the PC are hints to a cache there is not.
    if data == PC && first & 0x40 == 0 {
        return Insn::new(Class::Integer, 4);
    }
    Insn::new(Class::Load, 4)
        .addressed_by(address)
        .writing(data)
        .returning_if(first & 0xF == SP_NUMBER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markers_are_found_and_other_hints_are_not() {
        for option in 0..16 {
            let marker = Marker {
                region: option / 2,
                opens: option % 2 == 0,
            };
            assert_eq!(
                decode(0xF3AF, 0x80F0 | u16::from(option)).class,
                Class::Marker(marker)
            );
        }
        assert_eq!(decode(0xF3AF, 0x8000), Insn::new(Class::Integer, 4)); // nop.w
    }

    #[test]
    fn results_and_addresses_are_found() {
        let cases = [
            (0xEB00, 0x0C01, Class::Integer, 0, 1 << 12), // add.w r12, r0, r1
            (0xEBB0, 0x0F41, Class::Integer, 0, 0),       // cmp.w r0, r1, lsl #1
            (0xF100, 0x0001, Class::Integer, 0, 1),       // add.w r0, r0, #1
            (0xF641, 0x2034, Class::Integer, 0, 1),       // movw r0, #0x1a34
            (0xFBA0, 0x0302, Class::Integer, 0, 1 | 1 << 3), // umull r0, r3, r0, r2
            (0xFBB3, 0xF0F0, Class::IntegerDivide, 0, 1), // udiv r0, r3, r0
            (0xFB00, 0x3201, Class::Integer, 0, 1 << 2),  // mla r2, r0, r1, r3
            (0xFA01, 0xF002, Class::Integer, 0, 1),       // lsl.w r0, r1, r2
            (0xF8D1, 0xC004, Class::Load, 1 << 1, 1 << 12), // ldr.w r12, [r1, #4]
            (0xF851, 0x0B04, Class::Load, 1 << 1, 1),     // ldr r0, [r1], #4
            (0xF851, 0x0022, Class::Load, 1 << 1 | 1 << 2, 1), // ldr.w r0, [r1, r2, lsl #2]
            (0xF8DF, 0x0004, Class::Load, 0, 1),          // ldr.w r0, [pc, #4]
            (0xF801, 0x0B01, Class::Store, 1 << 1, 0),    // strb r0, [r1], #1
            (0xF891, 0xF000, Class::Integer, 0, 0),       // pld [r1]
            (0xE8B1, 0x000D, Class::Words(3), 1 << 1, 0xD), // ldm.w r1!, {r0, r2, r3}
            (0xE92D, 0x4FF0, Class::Words(9), 1 << 13, 0), // push.w {r4-r11, lr}
            (0xE9D1, 0x0300, Class::Words(2), 1 << 1, 9), // ldrd r0, r3, [r1]
            (0xE851, 0x0F00, Class::Load, 1 << 1, 1),     // ldrex r0, [r1]
            (0xE841, 0x2000, Class::Load, 1 << 1, 1),     // strex r0, r2, [r1]
            (0xE8D1, 0x2F4F, Class::Load, 1 << 1, 1 << 2), // ldrexb r2, [r1]
            (0xE8C1, 0x2F43, Class::Load, 1 << 1, 1 << 3), // strexb r3, r2, [r1]
            (0xE8C1, 0x2F53, Class::Load, 1 << 1, 1 << 3), // strexh r3, r2, [r1]
            (0xF3EF, 0x8010, Class::System, 0, 1),        // mrs r0, primask
            (0xF380, 0x8810, Class::System, 0, 0),        // msr primask, r0
            (0xF3BF, 0x8F4F, Class::Integer, 0, 0),       // dsb sy
            (0xF3BF, 0x8F6F, Class::InstructionBarrier, 0, 0), // isb sy
        ];
        for (first, second, class, address, writes) in cases {
            let insn = decode(first, second);
            let found = (insn.class, insn.address, insn.core_writes);
            assert_eq!(
                found,
                (class, address, writes),
                "{first:#06x} {second:#06x}"
            );
            assert!(!insn.may_branch, "{first:#06x} {second:#06x}");
        }
    }

    #[test]
    fn branches_are_found() {
        let cases = [
            (0xF000, 0xF800), // bl
            (0xF000, 0xB800), // b.w
            (0xF47F, 0xAFFE), // bne.w
            (0xE8DF, 0xF000), // tbb [pc, r0]
            (0xE8BD, 0x8010), // pop.w {r4, pc}
            (0xF85D, 0xFB04), // ldr pc, [sp], #4
        ];
        for (first, second) in cases {
            assert!(
                decode(first, second).may_branch,
                "{first:#06x} {second:#06x}"
            );
        }
        assert_eq!(decode(0xE8DF, 0xF000).class, Class::TableBranch);
    }
}
