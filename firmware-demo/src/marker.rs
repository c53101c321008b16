//! Marks the regions that `cycle-meter` measures.
//!
//! A marker is one `DBG` instruction, a hint that does nothing on the processor: it may stay
//! in the firmware. There are eight regions, which may nest. In QEMU the plugin
//! `cycle-meter` counts between a region's two markers; without it, and on a
//! host, they do nothing at all.
//!
//! Region k opens with `dbg #2k` and closes with `dbg #2k+1`. Processors without `DBG`, those of
//! ARMv6-M and RISC-V, have no markers.
//!
//! A marker keeps accesses to memory on their side of it, but not arithmetic on
//! values in registers, which the compiler may move across: measure a call of an
//! `#[inline(never)]` function with `black_box` around its arguments and its result.

#[cfg(all(target_arch = "arm", not(armv6m)))]
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

/// One end of a region: its start if `STOPS` is 0, else its end.
#[inline(always)]
fn mark<const K: u8, const STOPS: u8>() {
    const { assert!(K < 8, "there is no such region") };
    #[cfg(all(target_arch = "arm", not(armv6m)))]
    // SAFETY: an instruction that changes nothing; it may touch memory as far as the
    // compiler knows, which keeps accesses in order around it.
    unsafe {
        asm!("dbg #{}", const 2 * K + STOPS, options(nostack, preserves_flags));
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
