use std::fmt::Debug;

use super::{decode, size};
use crate::insn::{Class, Insn, Marker};

const SP: u16 = 1 << 13;

/// Asserts that what is read from these pairs of halfwords is what stands beside them; of a narrow
/// opcode the second is 0.
fn assert_each<T: Debug + PartialEq>(
    cases: impl IntoIterator<Item = (u16, u16, T)>,
    read: impl Fn(Insn) -> T,
) {
    for (first, second, expected) in cases {
        let found = read(decode(first, second));
        assert_eq!(found, expected, "{first:#06x} {second:#06x}");
    }
}

/// Class, registers of the address, core registers written; of what is no branch.
fn on_core(insn: Insn) -> (Class, u16, u16) {
    assert!(!insn.may_branch);
    (insn.class, insn.address, insn.core_writes)
}

/// Class, floating-point registers read and written.
fn on_floats(insn: Insn) -> (Class, u32, u32) {
    assert!(insn.float && !insn.may_branch);
    (insn.class, insn.float_reads, insn.float_writes)
}

#[test]
fn the_first_halfword_tells_the_size() {
    let sizes = [0xBF00, 0xE7FE, 0xE800, 0xEE30, 0xF000, 0xFFFF].map(size);
    assert_eq!(sizes, [2, 2, 4, 4, 4, 4]);
}

#[test]
fn narrow_results_and_addresses_are_found() {
    let cases = [
        (0x1C48, (Class::Integer, 0, 1 << 0)),        // adds r0, r1, #1
        (0x2901, (Class::Integer, 0, 0)),             // cmp r1, #1
        (0x4348, (Class::Integer, 0, 1 << 0)),        // muls r0, r1, r0
        (0x4208, (Class::Integer, 0, 0)),             // tst r0, r1
        (0x4684, (Class::Integer, 0, 1 << 12)),       // mov r12, r0
        (0x4801, (Class::Load, 0, 1 << 0)),           // ldr r0, [pc, #4]
        (0x5688, (Class::Load, 1 << 1 | 1 << 2, 1)),  // ldrsb r0, [r1, r2]
        (0x5088, (Class::Store, 1 << 1 | 1 << 2, 0)), // str r0, [r1, r2]
        (0x6848, (Class::Load, 1 << 1, 1 << 0)),      // ldr r0, [r1, #4]
        (0x8048, (Class::Store, 1 << 1, 0)),          // strh r0, [r1, #2]
        (0x9801, (Class::Load, SP, 1 << 0)),          // ldr r0, [sp, #4]
        (0xB082, (Class::Integer, 0, SP)),            // sub sp, #8
        (0xB5F0, (Class::Words(5), SP, 0)),           // push {r4-r7, lr}
        (0xBC30, (Class::Words(2), SP, 1 << 4 | 1 << 5)), // pop {r4, r5}
        (0xC807, (Class::Words(3), 1 << 0, 7)),       // ldm r0, {r0, r1, r2}
        (0xBF08, (Class::IfThen, 0, 0)),              // it eq
        (0xB672, (Class::System, 0, 0)),              // cpsid i
    ];
    let cases = cases.map(|(code, expected)| (code, 0, expected));
    assert_each(cases, on_core);
}

#[test]
fn register_branches_are_indirect_and_returns_are_not() {
    let is_indirect = |[first, second]: [u16; 2]| decode(first, second).indirect;
    let narrow = |first| is_indirect([first, 0]);
    // blx r3, blx lr, bx r3, mov pc, r3, add pc, r3
    assert_eq!([0x4798, 0x47F0, 0x4718, 0x469F, 0x449F].map(narrow), [true; 5]);
    // ldr.w pc, [r3], ldr.w pc, [pc, #4], ldm.w r0, {r1, pc}
    let wide = [[0xF8D3, 0xF000], [0xF8DF, 0xF004], [0xE890, 0x8002]];
    assert_eq!(wide.map(is_indirect), [true; 3]);
    // bx lr, mov pc, lr, mov r0, r3, pop {pc}, b, svc
    let direct = [0x4770, 0x46F7, 0x4618, 0xBD00, 0xE07E, 0xDF00];
    assert_eq!(direct.map(narrow), [false; 6]);
    // pop.w {r4, pc}, ldr pc, [sp], #4, bl
    let wide = [[0xE8BD, 0x8010], [0xF85D, 0xFB04], [0xF000, 0xF87E]];
    assert_eq!(wide.map(is_indirect), [false; 3]);
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
fn markers_are_found_and_other_hints_are_not() {
    for option in 0..16 {
        let marker = Marker { region: option / 2, opens: option % 2 == 0 };
        assert_eq!(decode(0xF3AF, 0x80F0 | u16::from(option)).class, Class::Marker(marker));
    }
    assert_eq!(decode(0xF3AF, 0x8000), Insn::new(Class::Integer, 4)); // nop.w
}

#[test]
fn wide_results_and_addresses_are_found() {
    let cases = [
        (0xEB00, 0x0C01, (Class::Integer, 0, 1 << 12)), // add.w r12, r0, r1
        (0xEBB0, 0x0F41, (Class::Integer, 0, 0)),       // cmp.w r0, r1, lsl #1
        (0xF100, 0x0001, (Class::Integer, 0, 1)),       // add.w r0, r0, #1
        (0xF641, 0x2034, (Class::Integer, 0, 1)),       // movw r0, #0x1a34
        (0xFBA0, 0x0302, (Class::Integer, 0, 1 | 1 << 3)), // umull r0, r3, r0, r2
        (0xFBB3, 0xF0F0, (Class::IntegerDivide, 0, 1)), // udiv r0, r3, r0
        (0xFB00, 0x3201, (Class::Integer, 0, 1 << 2)),  // mla r2, r0, r1, r3
        (0xFA01, 0xF002, (Class::Integer, 0, 1)),       // lsl.w r0, r1, r2
        (0xF8D1, 0xC004, (Class::Load, 1 << 1, 1 << 12)), // ldr.w r12, [r1, #4]
        (0xF851, 0x0B04, (Class::Load, 1 << 1, 1)),     // ldr r0, [r1], #4
        (0xF851, 0x0022, (Class::Load, 1 << 1 | 1 << 2, 1)), // ldr.w r0, [r1, r2, lsl #2]
        (0xF8DF, 0x0004, (Class::Load, 0, 1)),          // ldr.w r0, [pc, #4]
        (0xF801, 0x0B01, (Class::Store, 1 << 1, 0)),    // strb r0, [r1], #1
        (0xF891, 0xF000, (Class::Integer, 0, 0)),       // pld [r1]
        (0xE8B1, 0x000D, (Class::Words(3), 1 << 1, 0xD)), // ldm.w r1!, {r0, r2, r3}
        (0xE92D, 0x4FF0, (Class::Words(9), 1 << 13, 0)), // push.w {r4-r11, lr}
        (0xE9D1, 0x0300, (Class::Words(2), 1 << 1, 9)), // ldrd r0, r3, [r1]
        (0xE851, 0x0F00, (Class::Load, 1 << 1, 1)),     // ldrex r0, [r1]
        (0xE841, 0x2000, (Class::Load, 1 << 1, 1)),     // strex r0, r2, [r1]
        (0xE8D1, 0x2F4F, (Class::Load, 1 << 1, 1 << 2)), // ldrexb r2, [r1]
        (0xE8C1, 0x2F43, (Class::Load, 1 << 1, 1 << 3)), // strexb r3, r2, [r1]
        (0xE8C1, 0x2F53, (Class::Load, 1 << 1, 1 << 3)), // strexh r3, r2, [r1]
        (0xF3EF, 0x8010, (Class::System, 0, 1)),        // mrs r0, primask
        (0xF380, 0x8810, (Class::System, 0, 0)),        // msr primask, r0
        (0xF3BF, 0x8F4F, (Class::Integer, 0, 0)),       // dsb sy
        (0xF3BF, 0x8F6F, (Class::InstructionBarrier, 0, 0)), // isb sy
    ];
    assert_each(cases, on_core);
}

#[test]
fn dsp_instructions_take_a_cycle_and_write_their_results() {
    let cases = [
        (0xFBE1, 0x0362, 1 | 1 << 3), // umaal r0, r3, r1, r2
        (0xFB10, 0xF401, 1 << 4),     // smulbb r4, r0, r1
        (0xFB10, 0x2511, 1 << 5),     // smlabt r5, r0, r1, r2
        (0xFB20, 0x2611, 1 << 6),     // smladx r6, r0, r1, r2
        (0xFB20, 0xF711, 1 << 7),     // smuadx r7, r0, r1
        (0xEAC0, 0x4821, 1 << 8),     // pkhtb r8, r0, r1, asr #16
        (0xFA90, 0xFA01, 1 << 10),    // sadd16 r10, r0, r1
        (0xFA80, 0xFB41, 1 << 11),    // uadd8 r11, r0, r1
        (0xFAA0, 0xFC81, 1 << 12),    // sel r12, r0, r1
        (0xFA2F, 0xF081, 1),          // sxtb16 r0, r1
        (0xFA50, 0xF281, 1 << 2),     // uxtab r2, r0, r1
    ];
    let expected = |writes| Insn::new(Class::Integer, 4).writing(writes);
    let cases = cases.map(|(first, second, writes)| (first, second, expected(writes)));
    assert_each(cases, |insn| insn);
}

#[test]
fn branches_are_found() {
    // b, bne, bx lr, blx r3, cbz, pop {pc}, mov pc, svc, bkpt
    let narrow = [0xE7FE, 0xD1FD, 0x4770, 0x4798, 0xB108, 0xBD00, 0x46F7, 0xDF00, 0xBEAB];
    assert_each(narrow.map(|code| (code, 0, true)), |insn| insn.may_branch);
    let wide = [
        (0xF000, 0xF800), // bl
        (0xF000, 0xB800), // b.w
        (0xF47F, 0xAFFE), // bne.w
        (0xE8DF, 0xF000), // tbb [pc, r0]
        (0xE8BD, 0x8010), // pop.w {r4, pc}
        (0xF85D, 0xFB04), // ldr pc, [sp], #4
    ];
    let wide = wide.map(|(first, second)| (first, second, true));
    assert_each(wide, |insn| insn.may_branch);
    assert_eq!(decode(0xE8DF, 0xF000).class, Class::TableBranch);
}

#[test]
fn operands_of_arithmetic_are_found() {
    let cases = [
        (0xEE30, 0x0A81, (Class::FloatArithmetic, 1 << 1 | 1 << 2, 1)), // vadd.f32 s0, s1, s2
        (0xEE62, 0x1A22, (Class::FloatArithmetic, 3 << 4, 1 << 3)),     // vmul.f32 s3, s4, s5
        (0xEEA0, 0x0A81, (Class::FloatMultiplyAdd, 7, 1)),              // vfma.f32 s0, s1, s2
        (0xEE00, 0x0AC1, (Class::FloatMultiplyAdd, 7, 1)),              // vmls.f32 s0, s1, s2
        (0xEE80, 0x0A81, (Class::FloatDivide, 1 << 1 | 1 << 2, 1)),     // vdiv.f32 s0, s1, s2
        (0xEEB1, 0x0AE0, (Class::FloatDivide, 1 << 1, 1)),              // vsqrt.f32 s0, s1
        (0xEEB1, 0x0A60, (Class::FloatMove, 1 << 1, 1)),                // vneg.f32 s0, s1
        (0xEEB0, 0x0A60, (Class::FloatMove, 1 << 1, 1)),                // vmov.f32 s0, s1
        (0xEEB7, 0x0A00, (Class::FloatMove, 0, 1)),                     // vmov.f32 s0, #1.0
        (0xEEB4, 0x0A60, (Class::FloatConversion, 3, 0)),               // vcmp.f32 s0, s1
        (0xEEB5, 0x0A40, (Class::FloatConversion, 1, 0)),               // vcmp.f32 s0, #0
        (0xEEBD, 0x0AE0, (Class::FloatConversion, 1 << 1, 1)),          // vcvt.s32.f32 s0, s1
        (0xEEB8, 0x0AE0, (Class::FloatConversion, 1 << 1, 1)),          // vcvt.f32.s32 s0, s1
        (0xEEFA, 0x0ACC, (Class::FloatConversion, 1 << 1, 1 << 1)),     // vcvt.f32.s32 s1, s1, #8
        (0xEEFE, 0x0ACC, (Class::FloatConversion, 1 << 1, 1 << 1)),     // vcvt.s32.f32 s1, s1, #8
        (0xEEFB, 0x0ACC, (Class::FloatConversion, 1 << 1, 1 << 1)),     // vcvt.f32.u32 s1, s1, #8
        (0xEEFF, 0x0ACC, (Class::FloatConversion, 1 << 1, 1 << 1)),     // vcvt.u32.f32 s1, s1, #8
    ];
    assert_each(cases, |insn| {
        assert_eq!(insn.core_writes, 0);
        on_floats(insn)
    });
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
    assert_each(cases, |insn| insn.flops());
}

#[test]
fn words_of_loads_and_stores_are_counted() {
    let cases = [
        (0xED91, 0x0A02, (Class::Load, 0, 1)), // vldr s0, [r1, #8]
        (0xEDC1, 0xFA00, (Class::Store, 1 << 31, 0)), // vstr s31, [r1]
        (0xED91, 0x1B00, (Class::Words(2), 0, 3 << 2)), // vldr d1, [r1]
        (0xEDD1, 0x1B00, (Class::Words(2), 0, 0)), // vldr d17, [r1], which a Cortex-M4F lacks
        (0xEC81, 0x0A04, (Class::Words(4), 0xF, 0)), // vstmia r1, {s0-s3}
        (0xEC91, 0x0B04, (Class::Words(4), 0, 0xF)), // vldmia r1, {d0, d1}
        (0xED2D, 0x8B10, (Class::Words(16), 0xFFFF << 16, 0)), // vpush {d8-d15}
    ];
    assert_each(cases, |insn| {
        assert_eq!(insn.address.count_ones(), 1);
        on_floats(insn)
    });
}

#[test]
fn moves_to_core_registers_read_floats() {
    let cases = [
        (0xEE10, 0x0A90, ((Class::FloatMove, 1 << 1, 0), 1)), // vmov r0, s1
        (0xEE00, 0x0A90, ((Class::FloatMove, 0, 1 << 1), 0)), // vmov s1, r0
        (0xEEF1, 0xFA10, ((Class::FloatMove, 0, 0), 0)),      // vmrs apsr_nzcv, fpscr
        (0xEEF1, 0x0A10, ((Class::FloatMove, 0, 0), 1)),      // vmrs r0, fpscr
        (0xEC51, 0x0B10, ((Class::FloatMovePair, 3, 0), 3)),  // vmov r0, r1, d0
        (0xEC41, 0x0A30, ((Class::FloatMovePair, 0, 3 << 1), 0)), // vmov s1, s2, r0, r1
    ];
    assert_each(cases, |insn| (on_floats(insn), insn.core_writes));
}
