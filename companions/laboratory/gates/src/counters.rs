//! The counters of a core: cycles and executed instructions, which the core itself counts.

use core::sync::atomic::{AtomicU32, Ordering};

/// Cycles and instructions; zero on a host.
#[derive(Clone, Copy, Default)]
pub struct Count {
    pub cycles: u32,
    pub instructions: u32,
}

/// What two readings cost with nothing between them.
static EMPTY: [AtomicU32; 2] = [const { AtomicU32::new(0) }; 2];

/// Measures what a reading costs.
pub fn calibrate() {
    // The second time nothing waits for a fetch.
    for _ in 0..2 {
        let [begin, end] = [read(), read()];
        EMPTY[0].store(end.cycles.wrapping_sub(begin.cycles), Ordering::Relaxed);
        EMPTY[1].store(end.instructions.wrapping_sub(begin.instructions), Ordering::Relaxed);
    }
}

/// The counts between two readings.
pub fn between(begin: Count, end: Count) -> Count {
    let [cycles, instructions] = EMPTY.each_ref().map(|empty| empty.load(Ordering::Relaxed));
    Count {
        cycles: end.cycles.wrapping_sub(begin.cycles).wrapping_sub(cycles),
        instructions: end.instructions.wrapping_sub(begin.instructions).wrapping_sub(instructions),
    }
}

/// The counters now.
#[inline(always)]
pub fn read() -> Count {
    #[cfg(not(target_arch = "riscv32"))]
    return Count::default();
    #[cfg(target_arch = "riscv32")]
    {
        let (cycles, instructions);
        // SAFETY: reads two registers; as far as the compiler knows it may touch memory, which
        // keeps accesses in order around it.
        unsafe {
            core::arch::asm!(
                "csrr {}, mcycle", "csrr {}, minstret",
                out(reg) cycles, out(reg) instructions, options(nostack, preserves_flags)
            );
        }
        Count { cycles, instructions }
    }
}
