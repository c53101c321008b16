//! The digests of the bin `bits`, computed in WebAssembly: `test/bits.mjs` compares them with the
//! host's.

use std::cell::RefCell;
use std::fmt::Write;

use fixtures::{hard, recorded};

thread_local! {
    static LINES: RefCell<String> = RefCell::default();
}

/// Computes all lines; returns their length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn compute() -> usize {
    LINES.with_borrow_mut(|lines| {
        lines.clear();
        // Writing to a string does not fail.
        recorded::digests(|robot, quantity, digest| {
            let _ = writeln!(lines, "bits {robot} {quantity} {:016x}", digest.0);
        });
        hard::digests(|case, name, digest| {
            let _ = writeln!(lines, "bits hard {case} {name} {:016x}", digest.0);
        });
        lines.len()
    })
}

/// The address of the lines.
#[unsafe(no_mangle)]
pub extern "C" fn lines() -> *const u8 {
    LINES.with_borrow(|lines| lines.as_ptr())
}
