//! The stack that a call uses.

use core::arch::asm;

/// The words below the stack pointer that are painted: more than any tick takes.
const PAINTED: usize = 1024;
/// No code, address or small number that a tick could store has these bits.
const PAINT: u32 = 0xcccc_cccc;

/// The result of `run`, and the bytes of stack below the caller that it wrote to: its own frame and
/// those of all that it calls. What a frame reserves at its deepest end and never writes is not
/// seen.
#[inline(never)]
pub fn measured<T>(run: impl FnOnce() -> T) -> (T, usize) {
    let top = stack_pointer();
    let bottom = top.wrapping_sub(PAINTED);
    let mut at = bottom;
    while at < top {
        // SAFETY: memory below the stack pointer belongs to nobody: no interrupt is enabled, these
        // cores have no red zone, and this function's frame, which no call extends here, lies above
        // it. The linker scripts leave more than PAINTED words there.
        unsafe { at.write_volatile(PAINT) };
        at = at.wrapping_add(1);
    }
    let result = run();
    let mut deepest = bottom;
    // SAFETY: as above; the volatile reads are of words that were written above, or by `run` after
    // them.
    while deepest < top && unsafe { deepest.read_volatile() } == PAINT {
        deepest = deepest.wrapping_add(1);
    }
    assert!(deepest > bottom, "a tick takes more stack than is painted");
    (result, top as usize - deepest as usize)
}

/// The stack pointer of the caller.
#[inline(always)]
fn stack_pointer() -> *mut u32 {
    let pointer: *mut u32;
    // SAFETY: reads a register.
    unsafe {
        #[cfg(target_arch = "arm")]
        asm!("mov {}, sp", out(reg) pointer, options(nomem, nostack, preserves_flags));
        #[cfg(target_arch = "riscv32")]
        asm!("mv {}, sp", out(reg) pointer, options(nomem, nostack, preserves_flags));
    }
    pointer
}
