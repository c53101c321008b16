//! The terminal, which spinners and lines share.

use std::sync::LazyLock;

use indicatif::{MultiProgress, ProgressDrawTarget};

/// The spinners on the screen: one for a step of the tests, one for its current action.
pub static SPINNERS: LazyLock<MultiProgress> =
    LazyLock::new(|| MultiProgress::with_draw_target(target()));

/// The place where spinners and bars are drawn: none if the user wants plain text or the terminal
/// is limited to it.
pub fn target() -> ProgressDrawTarget {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    if is_set("NO_COLOR") || is_dumb {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    }
}

/// Writes while no spinner does.
pub fn above<T>(write: impl FnOnce() -> T) -> T {
    SPINNERS.suspend(write)
}
