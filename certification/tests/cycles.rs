//! The bounds of cycles of code that is written by hand, and what is declined.

use certification::cycles::{Declined, function};
use certification::image::Image;

const BASE: u32 = 0x0800_0000;

fn bound(code: &[u16]) -> Result<u64, Declined> {
    let bytes: Vec<u8> = code.iter().flat_map(|half| half.to_le_bytes()).collect();
    function(&Image::of(BASE, &bytes), BASE)
}

/// A return costs its own cycle and two of the refill.
const RETURN: u64 = 3;

#[test]
fn straight_code_takes_what_was_counted_by_hand() {
    // Figures of `hand_counted.txt`: a division, a chain of sums, loads through a loaded pointer; each and `bx lr`.
    for (code, cycles) in [
        (&[0xfbb0, 0xf0f1, 0xbf00][..], 13), // udiv r0, r0, r1; nop
        (
            &[
                0xee30, 0x0a20, 0xee30, 0x0a20, 0xee30, 0x0a20, 0xee10, 0x0a10,
            ],
            7,
        ), // vadd s0, s0, s1 thrice; vmov r0, s0
        (&[0x6800, 0x6800], 5),              // ldr r0, [r0], twice
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
fn what_has_no_bound_is_declined_with_its_address() {
    // subs r0, #1; bne, of an argument
    let turns = bound(&[0x3801, 0xd1fd, 0x4770]);
    assert_eq!(turns, Err(Declined::Loop { at: BASE + 2 }));
    assert_eq!(
        bound(&[0x4798, 0x4770]),
        Err(Declined::IndirectCall { at: BASE })
    ); // blx r3
    assert_eq!(bound(&[0x469f]), Err(Declined::IndirectJump { at: BASE })); // mov pc, r3
    assert_eq!(
        bound(&[0xee30, 0x0b01]),
        Err(Declined::UnknownInstruction { at: BASE })
    ); // vadd.f64
    let recursive = bound(&[0xf7ff, 0xfffe, 0x4770]); // bl to itself
    assert_eq!(recursive, Err(Declined::Recursion { at: BASE }));
    let json = serde_json::to_string(&Declined::Loop { at: 2 }).expect("JSON");
    assert_eq!(json, r#"{"reason":"loop","at":2}"#);
}
