//! FPv4-SP encodings (A6.4 to A6.7).

use super::register;
use crate::insn::{Class, Insn};

pub(super) fn decode(first: u16, second: u16) -> Insn {
    let ours = second & 0x0E00 == 0x0A00;
    match first >> 8 {
        0xEC | 0xED if ours && first & 0xFFE0 == 0xEC40 => move_pair(first, second),
        0xEC | 0xED if ours => load_store(first, second),
        0xEE if ours && second & 0x10 != 0 => move_one(first, second),
        // Arithmetic on doubles is not in FPv4-SP.
        0xEE if ours && second & 0x100 == 0 => arithmetic(first, second),
        _ => Insn::new(Class::Unknown, 4),
    }
}

/// Number of a single register: four bits at `low`, and its lowest bit apart.
const fn single(high: u16, low: u32, bit: bool) -> u32 {
    ((high >> low & 0xF) << 1) as u32 | bit as u32
}

/// `count` registers from number `start` on.
const fn run(start: u32, count: u32) -> u32 {
    ((((1_u64 << count) - 1) << start) & 0xFFFF_FFFF) as u32
}

/// VLDR, VSTR, VLDM, VSTM, VPUSH, VPOP (A6.5).
fn load_store(first: u16, second: u16) -> Insn {
    let double = second & 0x100 != 0;
    let top = first & 0x40 != 0;
    let start = if double {
        u32::from(second >> 12) << 1 | u32::from(top) << 5
    } else {
        single(second, 12, top)
    };
    let loads = first & 0x10 != 0;
    let one = first & 0x120 == 0x100;
    let words = match (one, double) {
        (true, false) => 1,
        (true, true) => 2,
        (false, _) => second & 0xFE | second & 1 & u16::from(!double),
    };
    let class = match (one && !double, loads) {
        (true, true) => Class::Load,
        (true, false) => Class::Store,
        (false, _) => Class::Words(words.min(32) as u8),
    };
    let count = if start < 32 { words.min(32) } else { 0 };
    let registers = run(start.min(31), count.into());
    let (reads, writes) = if loads {
        (0, registers)
    } else {
        (registers, 0)
    };
    Insn::new(class, 4)
        .addressed_by(register(first, 0, 4))
        .on_floats(reads, writes)
}

/// VMOV of two core registers and two singles or a double (A6.7).
fn move_pair(first: u16, second: u16) -> Insn {
    let low = second & 0x20 != 0;
    let start = if second & 0x100 != 0 {
        u32::from(second & 0xF) << 1
    } else {
        single(second, 0, low)
    };
    let (insn, pair) = (Insn::new(Class::FloatMovePair, 4), run(start, 2));
    if first & 0x10 == 0 {
        return insn.on_floats(0, pair);
    }
    let core = register(second, 12, 4) | register(first, 0, 4);
    insn.writing(core).on_floats(pair, 0)
}

/// VMOV of a core register and a single or half a double, VMRS, VMSR (A6.6).
fn move_one(first: u16, second: u16) -> Insn {
    let insn = Insn::new(Class::FloatMove, 4);
    let to_core = first & 0x10 != 0;
    let core = register(second, 12, 4);
    if first & 0xE0 == 0xE0 {
        // VMRS with the PC as its destination moves the flags.
        let written = if to_core { core & !(1 << 15) } else { 0 };
        return insn.writing(written).on_floats(0, 0);
    }
    // Of a double it is one half; of a single the lowest bit of its number.
    let is_double = second & 0x100 != 0;
    let lowest = if is_double {
        first & 0x20
    } else {
        second & 0x80
    };
    let float = 1 << single(first, 0, lowest != 0);
    match to_core {
        true => insn.writing(core).on_floats(float, 0),
        false => insn.on_floats(0, float),
    }
}

/// Data processing (A6.4).
fn arithmetic(first: u16, second: u16) -> Insn {
    let d = 1 << single(second, 12, first & 0x40 != 0);
    let n = 1 << single(first, 0, second & 0x80 != 0);
    let m = 1 << single(second, 0, second & 0x20 != 0);
    let class = |class| Insn::new(class, 4);
    match first >> 4 & 0b1011 {
        0b0000 | 0b0001 | 0b1001 | 0b1010 => class(Class::FloatMultiplyAdd).on_floats(d | n | m, d),
        0b0010 | 0b0011 => class(Class::FloatArithmetic).on_floats(n | m, d),
        0b1000 => class(Class::FloatDivide).on_floats(n | m, d),
        _ if second & 0x40 == 0 => class(Class::FloatMove).on_floats(0, d), // VMOV immediate
        _ => match (first & 0xF, second & 0x80 != 0) {
            (0, _) | (1, false) => class(Class::FloatMove).on_floats(m, d), // VMOV, VABS, VNEG
            (1, true) => class(Class::FloatDivide).on_floats(m, d),         // VSQRT
            (4, _) => class(Class::FloatConversion).on_floats(d | m, 0),    // VCMP
            (5, _) => class(Class::FloatConversion).on_floats(d, 0),        // VCMP with zero
            // Fixed-point conversions work in place.
            (10 | 11 | 14 | 15, _) => class(Class::FloatConversion).on_floats(d, d),
            (2 | 3 | 8 | 12 | 13, _) => class(Class::FloatConversion).on_floats(m, d),
            _ => class(Class::Unknown),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operands_of_arithmetic_are_found() {
        let cases = [
            (0xEE30, 0x0A81, Class::FloatArithmetic, 1 << 1 | 1 << 2, 1), // vadd.f32 s0, s1, s2
            (
                0xEE62,
                0x1A22,
                Class::FloatArithmetic,
                1 << 4 | 1 << 5,
                1 << 3,
            ), // vmul.f32 s3, s4, s5
            (0xEEA0, 0x0A81, Class::FloatMultiplyAdd, 7, 1),              // vfma.f32 s0, s1, s2
            (0xEE00, 0x0AC1, Class::FloatMultiplyAdd, 7, 1),              // vmls.f32 s0, s1, s2
            (0xEE80, 0x0A81, Class::FloatDivide, 1 << 1 | 1 << 2, 1),     // vdiv.f32 s0, s1, s2
            (0xEEB1, 0x0AE0, Class::FloatDivide, 1 << 1, 1),              // vsqrt.f32 s0, s1
            (0xEEB1, 0x0A60, Class::FloatMove, 1 << 1, 1),                // vneg.f32 s0, s1
            (0xEEB0, 0x0A60, Class::FloatMove, 1 << 1, 1),                // vmov.f32 s0, s1
            (0xEEB7, 0x0A00, Class::FloatMove, 0, 1),                     // vmov.f32 s0, #1.0
            (0xEEB4, 0x0A60, Class::FloatConversion, 3, 0),               // vcmp.f32 s0, s1
            (0xEEB5, 0x0A40, Class::FloatConversion, 1, 0),               // vcmp.f32 s0, #0
            (0xEEBD, 0x0AE0, Class::FloatConversion, 1 << 1, 1),          // vcvt.s32.f32 s0, s1
            (0xEEB8, 0x0AE0, Class::FloatConversion, 1 << 1, 1),          // vcvt.f32.s32 s0, s1
            (0xEEFA, 0x0ACC, Class::FloatConversion, 1 << 1, 1 << 1),     // vcvt.f32.s32 s1, s1, #8
            (0xEEFE, 0x0ACC, Class::FloatConversion, 1 << 1, 1 << 1),     // vcvt.s32.f32 s1, s1, #8
            (0xEEFB, 0x0ACC, Class::FloatConversion, 1 << 1, 1 << 1),     // vcvt.f32.u32 s1, s1, #8
            (0xEEFF, 0x0ACC, Class::FloatConversion, 1 << 1, 1 << 1),     // vcvt.u32.f32 s1, s1, #8
        ];
        for (first, second, class, reads, writes) in cases {
            let insn = decode(first, second);
            let found = (insn.class, insn.float_reads, insn.float_writes);
            assert_eq!(found, (class, reads, writes), "{first:#06x} {second:#06x}");
            assert!(insn.float && !insn.may_branch && insn.core_writes == 0);
        }
    }

    #[test]
    fn flops_are_those_of_sums_products_quotients_and_roots() {
        let cases = [
            (0xEE30, 0x0A81, 1), // vadd.f32 s0, s1, s2
            (0xEE30, 0x0AC1, 1), // vsub.f32 s0, s1, s2
            (0xEE20, 0x0A81, 1), // vmul.f32 s0, s1, s2
            (0xEE20, 0x0AC1, 1), // vnmul.f32 s0, s1, s2
            (0xEE80, 0x0A81, 1), // vdiv.f32 s0, s1, s2
            (0xEEB1, 0x0AE0, 1), // vsqrt.f32 s0, s1
            (0xEE00, 0x0A81, 2), // vmla.f32 s0, s1, s2
            (0xEE00, 0x0AC1, 2), // vmls.f32 s0, s1, s2
            (0xEE10, 0x0A81, 2), // vnmls.f32 s0, s1, s2
            (0xEEA0, 0x0A81, 2), // vfma.f32 s0, s1, s2
            (0xEE90, 0x0A81, 2), // vfnms.f32 s0, s1, s2
            (0xEEB1, 0x0A60, 0), // vneg.f32 s0, s1
            (0xEEB0, 0x0AE0, 0), // vabs.f32 s0, s1
            (0xEEB0, 0x0A60, 0), // vmov.f32 s0, s1
            (0xEEB4, 0x0A60, 0), // vcmp.f32 s0, s1
            (0xEEBD, 0x0AE0, 0), // vcvt.s32.f32 s0, s1
        ];
        for (first, second, flops) in cases {
            assert_eq!(
                decode(first, second).flops(),
                flops,
                "{first:#06x} {second:#06x}"
            );
        }
    }

    #[test]
    fn words_of_loads_and_stores_are_counted() {
        let cases = [
            (0xED91, 0x0A02, Class::Load, 0, 1),          // vldr s0, [r1, #8]
            (0xEDC1, 0xFA00, Class::Store, 1 << 31, 0),   // vstr s31, [r1]
            (0xED91, 0x1B00, Class::Words(2), 0, 3 << 2), // vldr d1, [r1]
            (0xEC81, 0x0A04, Class::Words(4), 0xF, 0),    // vstmia r1, {s0-s3}
            (0xEC91, 0x0B04, Class::Words(4), 0, 0xF),    // vldmia r1, {d0, d1}
            (0xED2D, 0x8B10, Class::Words(16), 0xFFFF << 16, 0), // vpush {d8-d15}
        ];
        for (first, second, class, reads, writes) in cases {
            let insn = decode(first, second);
            let found = (insn.class, insn.float_reads, insn.float_writes);
            assert_eq!(found, (class, reads, writes), "{first:#06x} {second:#06x}");
            assert_eq!(insn.address.count_ones(), 1);
        }
    }

    #[test]
    fn moves_to_core_registers_read_floats() {
        let cases = [
            (0xEE10, 0x0A90, Class::FloatMove, 1 << 1, 0, 1), // vmov r0, s1
            (0xEE00, 0x0A90, Class::FloatMove, 0, 1 << 1, 0), // vmov s1, r0
            (0xEEF1, 0xFA10, Class::FloatMove, 0, 0, 0),      // vmrs apsr_nzcv, fpscr
            (0xEEF1, 0x0A10, Class::FloatMove, 0, 0, 1),      // vmrs r0, fpscr
            (0xEC51, 0x0B10, Class::FloatMovePair, 3, 0, 3),  // vmov r0, r1, d0
            (0xEC41, 0x0A30, Class::FloatMovePair, 0, 3 << 1, 0), // vmov s1, s2, r0, r1
        ];
        for (first, second, class, reads, writes, core) in cases {
            let insn = decode(first, second);
            let found = (
                insn.class,
                insn.float_reads,
                insn.float_writes,
                insn.core_writes,
            );
            assert_eq!(
                found,
                (class, reads, writes, core),
                "{first:#06x} {second:#06x}"
            );
            assert!(insn.float && !insn.may_branch);
        }
    }
}
