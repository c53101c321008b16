//! Marks the regions that `cycle-meter` measures.
//!
//! A marker is one `DBG` instruction, a hint that does nothing on the processor: it may stay
//! in the firmware. There are eight regions, which may nest. In QEMU the plugin
//! `cycle-meter` counts between a region's two markers; without it, and on a
//! host, they do nothing at all.
//!
//! Processors without `DBG` have another instruction that changes nothing and that no compiler emits:
//!
//! | processor | a region opens | it closes |
//! |---|---|---|
//! | ARMv7-M, ARMv8-M with the main extension | `dbg #2k` | `dbg #2k+1` |
//! | ARMv6-M, regions 0 to 5 | `mov rN, rN` of an even N: 0 to 6, 10, 12 | of an odd one: 1 to 7, 9, 11 |
//! | RISC-V | `slti x0, x0, 2k`, a hint for custom use | `slti x0, x0, 2k+1` |
//!
//! A marker keeps accesses to memory on their side of it, but not arithmetic on
//! values in registers, which the compiler may move across: measure a call of an
//! `#[inline(never)]` function with `black_box` around its arguments and its result.

#[cfg(any(target_arch = "arm", target_arch = "riscv32"))]
use core::arch::asm;

/// Opens region `K`, 0 to 7.
///
/// ```
/// firmware_demo::marker::start::<0>();
/// // what is to be measured
/// firmware_demo::marker::stop::<0>();
/// ```
///
/// ```compile_fail
/// firmware_demo::marker::start::<8>(); // there is no such region
/// ```
#[inline(always)]
pub fn start<const K: u8>() {
    mark::<K, 0>();
}

/// Closes region `K`, 0 to 7.
#[inline(always)]
pub fn stop<const K: u8>() {
    mark::<K, 1>();
}

const REGIONS: u8 = if cfg!(armv6m) { 6 } else { 8 };

/// One end of a region: its start if `STOPS` is 0, else its end.
#[inline(always)]
fn mark<const K: u8, const STOPS: u8>() {
    const { assert!(K < REGIONS, "there is no such region") };
    #[cfg(any(target_arch = "arm", target_arch = "riscv32"))]
    // SAFETY: an instruction that changes nothing; it may touch memory as far as the
    // compiler knows, which keeps accesses in order around it.
    unsafe {
        #[cfg(all(target_arch = "arm", not(armv6m)))]
        asm!("dbg #{}", const 2 * K + STOPS, options(nostack, preserves_flags));
        #[cfg(armv6m)]
        asm!("mov r{r}, r{r}", r = const register(2 * K + STOPS), options(nostack, preserves_flags));
        #[cfg(target_arch = "riscv32")]
        asm!("slti x0, x0, {}", const 2 * K + STOPS, options(nostack, preserves_flags));
    }
}

/// The register of a marker of ARMv6-M. R8 is left out, since `mov r8, r8` is the NOP that assemblers emit.
#[cfg(armv6m)]
const fn register(marker: u8) -> u8 {
    match marker {
        0..8 => marker,
        8 => 10,
        _ => [9, 12, 11][marker as usize - 9],
    }
}

/// The result of `run`, executed in region `K`.
///
/// ```
/// let sum = firmware_demo::marker::measured::<3, _>(|| 2 + 2);
/// assert_eq!(sum, 4);
/// ```
#[inline(always)]
pub fn measured<const K: u8, T>(run: impl FnOnce() -> T) -> T {
    start::<K>();
    let result = run();
    stop::<K>();
    result
}
