//! The switch of the mutants, a crate of its own in the copy of the workspace: which change is active, from the
//! environment, or that all sites which are reached are to be recorded.

use std::io::Write;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The variable with the number of the active change, or with [`RECORD`].
const VARIABLE: &str = "MUTANT";
/// The variable with the file to which the numbers of reached sites are appended.
const LOG: &str = "MUTANT_LOG";
/// The value for a run without a change that records the sites.
const RECORD: &str = "record";
/// More than there are sites.
const SITES: usize = 1 << 13;

/// The sites that may be active: all until they are reached. Specialised code contains each site very often, where
/// one byte that is read is short enough.
static MAY_BE: [AtomicBool; SITES] = [const { AtomicBool::new(true) }; SITES];

/// What the environment says.
static WANTED: LazyLock<String> = LazyLock::new(|| std::env::var(VARIABLE).unwrap_or_default());
static ACTIVE: LazyLock<Option<usize>> = LazyLock::new(|| WANTED.parse().ok());

/// Whether the change of this number is active.
#[inline(always)]
pub fn on(number: usize) -> bool {
    MAY_BE[number].load(Relaxed) && is_active(number)
}

#[cold]
#[inline(never)]
fn is_active(number: usize) -> bool {
    let active = *ACTIVE == Some(number);
    // Two threads that are here at once record it twice, which is no harm.
    MAY_BE[number].store(active, Relaxed);
    if *WANTED == RECORD {
        record(number);
    }
    active
}

/// Appends a number at once: a test may end without any code at its end.
fn record(number: usize) {
    let path = std::env::var_os(LOG).expect("a file for the numbers of reached sites");
    let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
    let written = file.and_then(|mut file| file.write_all(format!("{number}\n").as_bytes()));
    written.expect("the file for the numbers of reached sites can be written");
}
