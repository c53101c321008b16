//! Sequences whose instructions and cycles were counted by hand, between the markers
//! of `cycle-meter`. The figures, here in the comments as "instructions: sum of
//! cycles", stand in `lab/meter/src/hand_counted.txt`, in the order of the markers here.
#![no_std]
#![no_main]

use core::arch::{asm, global_asm};

use cortex_m_rt::entry;
use cortex_m_semihosting::debug::EXIT_SUCCESS;
use firmware_demo::{marker, target};

/// Runs these lines with `r1` pointing to 16 words of memory and `r2` to a device. A
/// `nop` before them keeps what the compiler put there from stalling the first.
macro_rules! sequence {
    ($memory:expr, $($line:literal)+) => {
        // SAFETY: the lines change no registers but those declared, push as much as
        // they pop, write only to the memory in `r1`, and to a device only what does
        // no harm.
        unsafe {
            asm!(
                "nop", $($line,)+
                inout("r1") core::ptr::from_mut($memory) => _,
                inout("r2") DEVICE => _,
                out("r0") _, out("r3") _, out("r12") _, out("lr") _,
                out("s0") _, out("s1") _, out("s2") _, out("s3") _, out("s4") _,
                out("s5") _, out("s6") _, out("s7") _, out("s8") _, out("s9") _,
            )
        }
    };
}

type Memory = [u32; 16];

/// Reload value of the system timer, which does not run.
const DEVICE: u32 = 0xE000_E014;

#[entry]
fn main() -> ! {
    let memory = &mut [0; 16];
    integers(memory);
    floats(memory);
    divisions(memory);
    loads_and_stores(memory);
    branches(memory);
    blocks(memory);
    devices(memory);
    regions(memory);
    target::leave(EXIT_SUCCESS)
}

fn integers(memory: &mut Memory) {
    // straight line: 5: 1 each
    sequence!(memory,
        "dbg #0" "adds r0, #1" "lsls r0, r0, #2" "mul r0, r0, r0" "umull r0, r3, r0, r0"
        "mov.w r12, r0" "dbg #1");
    // divide: 2: 12 + 1
    sequence!(memory, "dbg #0" "udiv r0, r3, r0" "nop" "dbg #1");
    // if-then: 4: 1 each, the addition that is not executed too
    sequence!(memory, "dbg #0" "cmp r0, r0" "ite eq" "addeq r0, #1" "addne r0, #2" "dbg #1");
    // system: 5: mrs 2 + cpsid 2 + cpsie 2 + dsb 1 + isb 3
    sequence!(memory, "dbg #0" "mrs r0, primask" "cpsid i" "cpsie i" "dsb" "isb" "dbg #1");
}

fn floats(memory: &mut Memory) {
    // independent floats: 4: 1 each
    sequence!(memory,
        "dbg #0" "vadd.f32 s0, s1, s2" "vmul.f32 s3, s4, s5" "vsub.f32 s6, s7, s8"
        "vmov.f32 s9, s10" "dbg #1");
    // chain of floats: 4: 1 + (1+1) + (1+1) + (1+1), the store waits for its datum too
    sequence!(memory,
        "dbg #0" "vadd.f32 s0, s1, s2" "vmul.f32 s3, s0, s0" "vsub.f32 s4, s3, s3"
        "vstr s4, [r1]" "dbg #1");
    // chain of floats with a gap: 3: 1 each
    sequence!(memory, "dbg #0" "vadd.f32 s0, s1, s2" "nop" "vmul.f32 s3, s0, s0" "dbg #1");
    // sum to a core register: 2: 1 + (1+1)
    sequence!(memory, "dbg #0" "vadd.f32 s0, s1, s2" "vmov r0, s0" "dbg #1");
    // moved, then used: 2: 1 each, a move is no arithmetic
    sequence!(memory, "dbg #0" "vmov.f32 s0, s1" "vadd.f32 s2, s0, s0" "dbg #1");
    // multiply-add: 3: 3 + 3 + (1+1)
    sequence!(memory,
        "dbg #0" "vfma.f32 s0, s1, s2" "vmla.f32 s3, s4, s5" "vadd.f32 s6, s3, s3" "dbg #1");
    // compare: 2: 1 each
    sequence!(memory, "dbg #0" "vcmp.f32 s0, s1" "vmrs apsr_nzcv, fpscr" "dbg #1");
    // pair to core registers: 1: 2
    sequence!(memory, "dbg #0" "vmov r0, r3, d0" "dbg #1");
}

fn divisions(memory: &mut Memory) {
    // division used at once: 2: 1 + (13 for the divider + 1 for its result + 1)
    sequence!(memory, "dbg #0" "vdiv.f32 s0, s1, s2" "vadd.f32 s3, s0, s0" "dbg #1");
    // root, then unrelated float: 2: 1 + (13+1)
    sequence!(memory, "dbg #0" "vsqrt.f32 s0, s1" "vadd.f32 s3, s4, s4" "dbg #1");
    // division half hidden: 7: 1 + 5*1 + (13-5 + 1)
    sequence!(memory,
        "dbg #0" "vdiv.f32 s0, s1, s2" ".rept 5" "nop" ".endr" "vadd.f32 s3, s0, s0" "dbg #1");
    // division hidden: 16: 1 + 14*1 + 1
    sequence!(memory,
        "dbg #0" "vdiv.f32 s0, s1, s2" ".rept 14" "nop" ".endr" "vadd.f32 s3, s0, s0" "dbg #1");
    // division across a branch: 3: 1 + (1+2) + (13-3 + 1)
    sequence!(memory,
        "dbg #0" "vdiv.f32 s0, s1, s2" "b 2f" "nop" "2: vadd.f32 s3, s0, s0" "dbg #1");
}

fn loads_and_stores(memory: &mut Memory) {
    // loads in a row: 3: 2 + 1 + 1
    sequence!(memory, "dbg #0" "ldr r0, [r1]" "ldr r3, [r1, #4]" "vldr s0, [r1, #8]" "dbg #1");
    // loads apart: 3: 2 + 1 + 2
    sequence!(memory, "dbg #0" "ldr r0, [r1]" "nop" "ldr r3, [r1, #4]" "dbg #1");
    // load through a loaded pointer: 2: 2 + (1+2)
    sequence!(memory, "str r1, [r1]" "nop" "dbg #0" "ldr r0, [r1]" "ldr r3, [r0]" "dbg #1");
    // address just computed: 4: 1 + (1+2) + 1 + (1+1)
    sequence!(memory,
        "dbg #0" "add r0, r1, #4" "ldr r3, [r0]" "add r0, r1, #8" "str r3, [r0]" "dbg #1");
    // base only updated: 2: 2 + 1
    sequence!(memory, "dbg #0" "ldr r0, [r1], #4" "ldr r3, [r1]" "dbg #1");
    // stores: 4: 1 each
    sequence!(memory,
        "dbg #0" "adds r0, #1" "str r0, [r1]" "strb r0, [r1, #4]" "vstr s0, [r1, #8]" "dbg #1");
    // several words: 8: (1+2) + (1+2) + (1+3) + (1+3) + (1+2) + (1+4) + (1+4) + (1+2)
    sequence!(memory,
        "dbg #0" "push {{r0, r3}}" "pop {{r0, r3}}" "stm r1, {{r0, r2, r3}}"
        "ldm r1, {{r0, r2, r3}}" "ldrd r0, r3, [r1]" "vstm r1, {{s0-s3}}" "vldm r1, {{d0-d1}}"
        "vldr d2, [r1]" "dbg #1");
}

fn branches(memory: &mut Memory) {
    // loop of ten: 21: 1 + 10*(1+1) + 9*2
    sequence!(memory, "dbg #0" "movs r0, #10" "2: subs r0, #1" "bne 2b" "dbg #1");
    // not taken: 3: 1 each
    sequence!(memory, "dbg #0" "cmp r0, r0" "bne 2f" "nop" "2: dbg #1");
    // taken: 3: 1 + (1+2) + 1
    sequence!(memory, "dbg #0" "cmp r0, r0" "beq 2f" "nop" "2: nop" "dbg #1");
    // compare and branch: 3: 1 + (1+2) + 1
    sequence!(memory, "dbg #0" "movs r0, #0" "cbz r0, 2f" "nop" "2: nop" "dbg #1");
    // call and return: 4: bl (1+2) + nop 1 + bx (1+2) + b (1+2)
    sequence!(memory, "dbg #0" "bl 2f" "b 3f" "2: nop" "bx lr" "3: dbg #1");
    // call that saves registers: 4: bl (1+2) + push (1+2) + pop (1+2+2) + b (1+2)
    sequence!(memory, "dbg #0" "bl 2f" "b 3f" "2: push {{r4, lr}}" "pop {{r4, pc}}" "3: dbg #1");
    // table branch: 4: 1 + 1 + (2+2) + 1
    sequence!(memory,
        "dbg #0" "movs r0, #0" "nop" "tbb [pc, r0]" ".byte 1, 1" "nop" "dbg #1");
}

// Each starts a few bytes before the end of a page, with its marker 4 bytes later.
global_asm!(
    ".section .text.meter_check_pages, \"ax\", %progbits",
    ".balign 4096",
    ".skip 4096 - 14",
    ".thumb_func",
    "straddling:",
    "nop",
    "dbg #0",
    "adds r0, #1",
    "add.w r0, r0, #1",
    "add.w r0, r0, #1", // two bytes on either page
    "adds r0, #1",
    "dbg #1",
    "bx lr",
    ".balign 4096",
    ".skip 4096 - 12",
    ".thumb_func",
    "sum_at_page_end:",
    "nop",
    "dbg #0",
    "nop",
    "vadd.f32 s0, s1, s2", // the last of its page
    "vmul.f32 s3, s0, s0",
    "dbg #1",
    "bx lr",
    ".balign 4096",
    ".skip 4096 - 10",
    ".thumb_func",
    "address_at_page_end:",
    "nop",
    "dbg #0",
    "nop",
    "adds r0, r1, #4", // the last of its page, two bytes
    "ldr.w r3, [r0, #0]",
    "dbg #1",
    "bx lr",
    // The interrupt that a device access in `devices` requests.
    ".section .text.PendSV, \"ax\", %progbits",
    ".global PendSV",
    ".thumb_func",
    "PendSV:",
    "nop",
    "bx lr",
);

fn blocks(memory: &mut Memory) {
    // across a page end: 4: 1 each
    sequence!(memory, "bl straddling");
    // result across a page end: 3: 1 + 1 + (1+1)
    sequence!(memory, "bl sum_at_page_end");
    // address across a page end: 3: 1 + 1 + (1+2)
    sequence!(memory, "bl address_at_page_end");
    // longer than a block can be: 600: 1 each
    sequence!(memory, "dbg #0" ".rept 600" "nop" ".endr" "dbg #1");
}

fn devices(memory: &mut Memory) {
    // device: 5: 1 + 2 + 1 + 1 + 1
    sequence!(memory, "dbg #0" "nop" "ldr r0, [r2]" "ldr r3, [r2]" "nop" "str r0, [r2]" "dbg #1");
    // loop over a device: 13: 1 + 3*(1 + 2 + 1 + 1) + 2*2
    sequence!(memory,
        "dbg #0" "movs r3, #3" "2: nop" "ldr r0, [r2]" "subs r3, #1" "bne 2b" "dbg #1");
    // interrupt: 5: str 1 + in the handler nop 1, bx (1+2) + nop 1 + nop 1
    sequence!(memory,
        "movw r2, #0xED04" "movt r2, #0xE000" "mov r0, #0x10000000"
        "nop" "dbg #0" "str r0, [r2]" "nop" "nop" "dbg #1");
}

/// A function of its own, for the compiler may put moves between the markers.
#[inline(never)]
fn empty() {
    marker::measured::<7, _>(|| ());
}

fn regions(memory: &mut Memory) {
    // empty: 0: nothing
    empty();
    // innermost: 1: 1; middle: 4: 1 each; outermost: 6: 1 each
    sequence!(memory,
        "dbg #0" "nop" "dbg #2" "nop" "nop" "dbg #4" "nop" "dbg #5" "nop" "dbg #3" "nop" "dbg #1");
    // second phase: 2: (2-1) + 1, for its load is right behind another; whole: 4: 2 + 1 + 1 + 1
    sequence!(memory,
        "dbg #0" "ldr r0, [r1]" "dbg #2" "ldr r3, [r1]" "nop" "dbg #3" "nop" "dbg #1");
    // overlapping, first: 2: 1 each; second: 3: 1 each
    sequence!(memory, "dbg #12" "nop" "dbg #14" "nop" "dbg #13" "nop" "nop" "dbg #15");
}
