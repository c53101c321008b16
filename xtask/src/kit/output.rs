//! Output to the user. `println!` panics where a pipe is closed or a disk is full; here the first
//! is the end of a run, the second an error, and notes on stderr that nobody can read are lost.

use std::io::Write;

use crate::kit::error::{Error, Result};
use crate::kit::screen;

/// Writes a text to stdout.
///
/// # Errors
/// It cannot be written, all of it.
pub fn print(text: &str) -> Result<()> {
    // Between two frames of a spinner, which stderr may show on the same terminal.
    screen::above(|| {
        let mut stdout = std::io::stdout().lock();
        let written = stdout.write_all(text.as_bytes());
        written.and_then(|()| stdout.flush()).map_err(Error::Output)
    })
}

/// Writes a line to stdout.
///
/// # Errors
/// As [`print()`].
pub fn line(text: &str) -> Result<()> {
    print(&format!("{text}\n"))
}

/// Writes a line to stderr.
pub fn note(text: &str) {
    screen::above(|| {
        // There is nowhere to say that it failed.
        let _ = writeln!(std::io::stderr().lock(), "{text}");
    });
}
