//! Copies the tick's code from flash to the memory that never waits, where `memory.x` places it.
//!
//! It runs before any code of Rust, since start-up calls some of these functions as well.

core::arch::global_asm!(
    // Without the section there is nothing to copy.
    ".weak __sfast_text, __efast_text, __sifast_text",
    ".section .text.__pre_init, \"ax\", %progbits",
    ".global __pre_init",
    ".type __pre_init, %function",
    ".thumb_func",
    "__pre_init:",
    "ldr r0, =__sfast_text",
    "ldr r1, =__efast_text",
    "ldr r2, =__sifast_text",
    "1: cmp r0, r1",
    "beq 2f",
    "ldr r3, [r2], #4",
    "str r3, [r0], #4",
    "b 1b",
    "2: dsb",
    "isb",
    "bx lr",
    ".size __pre_init, . - __pre_init",
);
