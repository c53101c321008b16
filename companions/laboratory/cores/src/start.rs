//! From reset to `main`, and what a fault does. The core is as QEMU starts it; what it needs beside
//! is a stack, a floating-point unit that is switched on, and the initial values of variables.

use core::arch::global_asm;

use semihosting::process;

#[cfg(target_arch = "arm")]
global_asm!(
    ".section .init, \"ax\"",
    ".word _stack_start",
    ".word _start",
    ".rept 14",
    ".word fault",
    ".endr",
    ".globl _start",
    ".type _start, %function",
    ".thumb_func",
    "_start:",
    // The coprocessor access control register; parts without an FPU keep it as it is.
    "ldr r0, =0xe000ed88",
    "ldr r1, ={coprocessors}",
    "str r1, [r0]",
    "dsb",
    "isb",
    "ldr r0, =_data_load",
    "ldr r1, =_data_start",
    "ldr r2, =_data_end",
    "1: cmp r1, r2",
    "bhs 2f",
    "ldr r3, [r0]",
    "str r3, [r1]",
    "adds r0, #4",
    "adds r1, #4",
    "b 1b",
    "2: ldr r1, =_bss_start",
    "ldr r2, =_bss_end",
    "movs r3, #0",
    "3: cmp r1, r2",
    "bhs 4f",
    "str r3, [r1]",
    "adds r1, #4",
    "b 3b",
    "4: bl main",
    ".pool",
    coprocessors = const if cfg!(target_abi = "eabihf") { 0x00f0_0000 } else { 0 },
);

#[cfg(target_arch = "riscv32")]
global_asm!(
    ".section .init, \"ax\"",
    ".globl _start",
    "_start:",
    ".option push",
    ".option norelax",
    "la gp, __global_pointer$",
    ".option pop",
    "la sp, _stack_start",
    "la t0, 4f",
    "csrw mtvec, t0",
    "li t0, 0x6000", // FS of mstatus
    "csrs mstatus, t0",
    "csrw fcsr, zero",
    "csrw mcountinhibit, zero",
    "la t0, _data_load",
    "la t1, _data_start",
    "la t2, _data_end",
    "1: bgeu t1, t2, 2f",
    "lw t3, 0(t0)",
    "sw t3, 0(t1)",
    "addi t0, t0, 4",
    "addi t1, t1, 4",
    "j 1b",
    "2: la t1, _bss_start",
    "la t2, _bss_end",
    "3: bgeu t1, t2, 5f",
    "sw zero, 0(t1)",
    "addi t1, t1, 4",
    "j 3b",
    // `mtvec` of some cores holds multiples of 256. Without an emulator that answers semihosting the
    // breakpoint of a call comes here; a host that simulates a core answers it by these words.
    ".balign 256",
    "4: csrw mscratch, t0",
    "csrr t0, mcause",
    "addi t0, t0, -3",
    "bnez t0, 6f",
    "li t0, 0x40000000",
    "sw a0, 0(t0)",
    "sw a1, 4(t0)",
    "lw a0, 8(t0)",
    "csrr t0, mepc",
    "addi t0, t0, 4",
    "csrw mepc, t0",
    "csrr t0, mscratch",
    "mret",
    "6: tail fault",
    "5: tail main",
);

// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
extern "C" fn main() -> ! {
    crate::work();
    process::exit(0)
}

// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
extern "C" fn fault() -> ! {
    process::exit(2)
}
