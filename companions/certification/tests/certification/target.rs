//! The bounds of cycles and stack of code that is written by hand, what is declined, and what
//! contradicts a sheet.

use certification::certificate::{Function, expression};
use certification::cycles::{Declined, function, region};
use certification::emulation::Emulation;
use certification::error::Error;
use certification::image::Image;
use certification::interval::Interval;
use certification::narrow::{Narrow, NarrowError};
use certification::search::Evaluation;
use certification::stack::{INTERRUPT_FRAME, stack};
use certification::target::Target;
use cycle_meter::Sample;

use super::recorded::{BASE, RNEA, bytes, program, robot};

fn image(code: &[u16]) -> Image {
    let bytes: Vec<u8> = code.iter().flat_map(|half| half.to_le_bytes()).collect();
    Image::of(BASE, &bytes)
}

fn bound(code: &[u16]) -> Result<u64, Declined> {
    function(&image(code), BASE).cycles
}

/// A return costs its own cycle and two of the refill.
const RETURN: u64 = 3;

#[test]
fn straight_code_takes_what_was_counted_by_hand() {
    // Figures of `hand_counted.txt`: a division, a chain of sums, loads through a loaded pointer;
    // each and `bx lr`.
    for (code, cycles) in [
        (&[0xfbb0, 0xf0f1, 0xbf00][..], 13), // udiv r0, r0, r1; nop
        // vadd s0, s0, s1 thrice; vmov r0, s0
        (&[0xee30, 0x0a20, 0xee30, 0x0a20, 0xee30, 0x0a20, 0xee10, 0x0a10], 7),
        (&[0x6800, 0x6800], 5), // ldr r0, [r0], twice
    ] {
        let whole: Vec<u16> = code.iter().copied().chain([0x4770]).collect();
        assert_eq!(bound(&whole), Ok(cycles + RETURN), "{code:x?}");
    }
}

#[test]
fn a_loop_of_a_known_count_is_followed_turn_by_turn() {
    // movs r0, #10; subs r0, #1; bne: 1 + 10 * (1 + 1) + 9 * 2
    assert_eq!(bound(&[0x200a, 0x3801, 0xd1fd, 0x4770]), Ok(39 + RETURN));
}

#[test]
fn the_longer_way_of_a_branch_on_data_counts() {
    // cmp r0, #0; beq over two of udiv; the short way is taken in 1 + 3 cycles.
    let code = [0x2800, 0xd003, 0xfbb0, 0xf0f1, 0xfbb0, 0xf0f1, 0x4770];
    assert_eq!(bound(&code), Ok(2 + 24 + RETURN));
}

#[test]
fn what_stands_before_a_mark_counts_only_if_no_branch_leaves_it_out() {
    // movs r4, #1; dbg #0; subs r4, #1; bne back to subs; dbg #1; and then back to the mark, or bx
    // lr
    let code = [0x2401, 0xf3af, 0x80f0, 0x3c01, 0xd1fd, 0xf3af, 0x80f1];
    let of = |last: u16| {
        let whole = [&code[..], &[last]].concat();
        let image = image(&whole).with_function("f", BASE, 16);
        region(&image, BASE + 2, None).map(|bound| bound.cycles)
    };
    assert_eq!(of(0x4770), Some(Ok(2)));
    assert_eq!(of(0xe7f8), Some(Err(Declined::Loop { at: BASE + 8 })));
}

#[test]
fn a_table_of_branches_ends_before_its_padding() {
    // tbb [pc, r0]; two entries, to nop and behind it, and padding that is none; nop; bx lr
    let code = [0xe8df, 0xf000, 0x0302, 0x007f, 0xbf00, 0x4770];
    let image = image(&code).with_function("f", BASE, 12);
    assert_eq!(function(&image, BASE).cycles, Ok(2 + 2 + 1 + RETURN));
}

#[test]
fn a_byte_in_memory_is_known_until_something_may_reach_it() {
    // push {r7, lr}; movs r2, #3; strb.w r2, [sp]; str r1, [r0] or [sp]; ldrb.w r2, [sp]; subs r2,
    // #1; bne; pop {r7, pc}
    let of = |store: u16| {
        bound(&[0xb580, 0x2203, 0xf88d, 0x2000, store, 0xf89d, 0x2000, 0x3a01, 0xd1fd, 0xbd80])
    };
    assert!(of(0x6001).is_ok());
    assert_eq!(of(0x9100), Err(Declined::Loop { at: BASE + 16 }));
}

#[test]
fn what_has_no_bound_is_declined_with_its_address() {
    // subs r0, #1; bne, of an argument
    let turns = bound(&[0x3801, 0xd1fd, 0x4770]);
    assert_eq!(turns, Err(Declined::Loop { at: BASE + 2 }));
    assert_eq!(bound(&[0x4798, 0x4770]), Err(Declined::IndirectCall { at: BASE })); // blx r3
    assert_eq!(bound(&[0x469f]), Err(Declined::IndirectJump { at: BASE })); // mov pc, r3
    // vadd.f64
    assert_eq!(bound(&[0xee30, 0x0b01]), Err(Declined::UnknownInstruction { at: BASE }));
    let recursive = bound(&[0xf7ff, 0xfffe, 0x4770]); // bl to itself
    assert_eq!(recursive, Err(Declined::Recursion { at: BASE }));
    let json = serde_json::to_string(&Declined::Loop { at: 2 }).expect("JSON");
    assert_eq!(json, r#"{"reason":"loop","at":2}"#);
}

#[test]
fn the_way_that_is_shorter_to_where_both_meet_counts_if_it_is_longer_afterwards() {
    // cbz over a vdiv and a branch, to three of nop; vadd. At vadd a quotient is pending for ten
    // cycles after five, or nothing after six.
    let code = [0xb110, 0xee80, 0x0a20, 0xe002, 0xbf00, 0xbf00, 0xbf00, 0xee30, 0x1a00, 0x4770];
    assert_eq!(bound(&code), Ok(5 + 10 + 1 + RETURN));
}

#[test]
fn a_comparison_in_an_it_block_sets_flags() {
    // movs r2, #0; cmp r2, #0, which is equal; cmp r0, #1; it eq; tsteq r1, r1; beq over udiv: both
    // ways are open.
    let code = [0x2200, 0x2801, 0xbf08, 0x4209, 0xd001, 0xfbb0, 0xf0f1, 0x4770];
    assert_eq!(bound(&code), Ok(5 + 12 + RETURN));
    assert_eq!(function(&image(&code), BASE).branches, [BASE + 8]);
}

#[test]
fn a_counter_that_a_pointer_may_reach_is_not_known() {
    // movs r2, #3; str r2, [r0]; str r1, [r3]; ldr r2, [r0]; subs r2, #1; bne
    let code = [0x2203, 0x6002, 0x6019, 0x6802, 0x3a01, 0xd1fd, 0x4770];
    assert_eq!(bound(&code), Err(Declined::Loop { at: BASE + 10 }));
    // The same on the stack, which is the compiler's own: push {r7, lr} …
    let code = [0xb580, 0x2203, 0x9200, 0x6019, 0x9a00, 0x3a01, 0xd1fd, 0xbd80];
    assert!(bound(&code).is_ok());
}

#[test]
fn the_stack_is_the_deepest_chain_of_calls_and_an_interrupt() {
    let of = |code: &[u16]| stack(&image(code), BASE);
    // push {r4, lr}; sub sp, #8; add sp, #8; pop {r4, pc}
    let frame = [0xb510, 0xb082, 0xb002, 0xbd10];
    assert_eq!(of(&frame), Ok(16 + INTERRUPT_FRAME));
    // push {r4, lr}; bl to the leaf behind; pop {r4, pc}; vpush {s16, s17}; vpop {s16, s17}; bx lr
    let calls = [0xb510, 0xf000, 0xf801, 0xbd10, 0xed2d, 0x8a02, 0xecbd, 0x8a02, 0x4770];
    let with_leaf =
        image(&calls).with_function("calls", BASE, 8).with_function("leaf", BASE + 8, 10);
    assert_eq!(stack(&with_leaf, BASE), Ok(8 + 8 + INTERRUPT_FRAME));
    // subs r0, #1; bne; bx lr: a loop on data takes none.
    assert_eq!(of(&[0x3801, 0xd1fd, 0x4770]), Ok(INTERRUPT_FRAME));
    // sub sp, r0
    assert_eq!(of(&[0xebad, 0x0d00, 0x4770]), Err(Declined::StackPointer { at: BASE }));
    // A push at each turn.
    assert_eq!(of(&[0xb401, 0x3801, 0xd1fc, 0x4770]), Err(Declined::StackPointer { at: BASE }));
    assert_eq!(of(&[0x4798, 0x4770]), Err(Declined::IndirectCall { at: BASE }));
    assert_eq!(of(&[0xf7ff, 0xfffe, 0x4770]), Err(Declined::Recursion { at: BASE }));
    assert_eq!(INTERRUPT_FRAME, 108);
}

#[test]
fn a_sheet_takes_neither_other_bits_nor_other_cycles() {
    let (image, robot) = (program(bytes(RNEA), "RNEA"), robot(6));
    let state: Vec<f64> = (0..18).map(|k| f64::from((k as f32).sin())).collect();
    let graph = expression(&image, Function::Rnea).expect("straight-line").graph;
    let bits: Vec<u32> =
        Evaluation::new(&graph, &robot).at(&state).map(|pair| pair.0.to_bits()).collect();
    let cycles = function(&image, BASE).cycles.expect("a bound");
    let target = |bits: &[u32], cycles| {
        let said = format!("rnea {bits:x?}");
        let run = Emulation::read(vec![state.clone()], &said, vec![Sample::of(0, [1, cycles, 0])]);
        Target::of(&image, Function::Rnea, &robot, &Ok(run.expect("a call")))
    };
    let sheet = target(&bits, cycles).expect("the bits of the expression");
    assert_eq!((sheet.measured.clone(), sheet.bound), (Ok([cycles, cycles]), Ok(cycles)));
    assert!(sheet.branches.is_empty() && sheet.stack.is_ok());
    let mut other = bits.clone();
    other[3] ^= 1;
    assert!(matches!(target(&other, cycles), Err(Error::Bits { state: 1, result: 4, .. })));
    assert!(matches!(target(&bits[..5], cycles), Err(Error::Missing(_))));
    for wrong in [cycles - 1, cycles + 1] {
        assert!(matches!(target(&bits, wrong), Err(Error::Cycles { .. })));
    }
    let json = serde_json::to_string(&sheet).expect("JSON");
    let bound = format!("{{\"measured\":[{cycles},{cycles}],\"states\":1,\"bound\":{cycles},");
    assert!(json.starts_with(&bound), "{json}");
    let without = Target::of(&image, Function::Rnea, &robot, &Err("no QEMU".to_owned()));
    let said = without.expect("a bound alone").sentence();
    assert!(
        said.contains("not measured (no QEMU)") && said.contains("Bits: not compared"),
        "{said}"
    );
    assert!(Emulation::read(Vec::new(), "rnea [0]", Vec::new()).is_none());
}

#[test]
fn a_box_is_narrowed_joint_by_joint() {
    let apply = |text: &str| {
        let mut robot = robot(6);
        text.parse::<Narrow>()?.apply(&mut robot)?;
        Ok::<_, NarrowError>(robot.joints[1])
    };
    let joint = apply("2:-1.5..1.25").expect("it is within the range");
    assert_eq!(joint.position, Interval::new(-1.5, 1.25));
    assert_eq!(apply("2:v:0.5").map(|joint| joint.speed), Ok(0.5));
    assert_eq!(apply("2:a:20").map(|joint| joint.acceleration), Ok(20.0));
    for text in
        ["", "2", "2:", "0:0..1", "2:1..0", "2:0..nan", "2:w:1", "2:v:-1", "-1:0..1", "2:v:x"]
    {
        let said = apply(text).expect_err(text).to_string();
        assert!(said.contains("JOINT:v:MOST"), "{said}");
    }
    for (text, why) in [("7:0..1", "joints 1 to 6"), ("2:-4..1", "range -3 to 3")] {
        let said = apply(text).expect_err(text).to_string();
        assert!(said.contains(why), "{said}");
    }
    let said = apply("2:v:4").expect_err("too fast").to_string();
    assert_eq!(said, "2:v:4: joint 2 has the range -3 to 3");
    let mut far = robot(6);
    far.joints[1].position = Interval::new(-100.0, 100.0);
    let narrow: Narrow = "2:-1..1".parse().expect("a range");
    let said = narrow.apply(&mut far).expect_err("its sines turn further");
    assert!(said.to_string().contains("more than two turns"), "{said}");
}
