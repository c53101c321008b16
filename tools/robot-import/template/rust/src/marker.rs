//! Instructions that do nothing and mark regions for `cargo xtask meter ELF` of dynamics-core's
//! repository.

/// Runs a closure in region K, 0 to 7.
#[inline(always)]
#[allow(unsafe_code, reason = "inline assembly has no safe form")]
pub fn measured<const K: u8, T>(run: impl FnOnce() -> T) -> T {
    // SAFETY: a hint that changes nothing.
    #[cfg(target_os = "none")]
    unsafe {
        core::arch::asm!("dbg #{}", const 2 * K, options(nostack, preserves_flags));
    }
    let result = run();
    // SAFETY: as above.
    #[cfg(target_os = "none")]
    unsafe {
        core::arch::asm!("dbg #{}", const 2 * K + 1, options(nostack, preserves_flags));
    }
    result
}
