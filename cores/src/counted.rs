//! A sequence counted by hand, which proves that the instructions of a core are counted.

use core::arch::asm;

use firmware_demo::marker::measured;
use firmware_demo::region;

/// Executes 21 instructions between the markers of a tick: one, and then ten times two.
#[inline(never)]
pub fn twenty_one() {
    measured::<{ region::TICK }, _>(|| {
        // SAFETY: counts down in a register of its own.
        unsafe {
            #[cfg(target_arch = "arm")]
            asm!(
                "movs {0}, #10",
                "1: subs {0}, #1",
                "bne 1b",
                out(reg) _,
                options(nostack)
            );
            #[cfg(target_arch = "riscv32")]
            asm!(
                "li {0}, 10",
                "1: addi {0}, {0}, -1",
                "bnez {0}, 1b",
                out(reg) _,
                options(nostack)
            );
        }
    });
}
