//! Spinners on stderr, where there is someone to see them.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::kit::output;
use crate::kit::screen::SPINNERS;

/// A line about the current action, shown until it is dropped.
pub struct Spinner(ProgressBar);

impl Spinner {
    /// Says what is going on: with a spinner on a terminal, as a plain line elsewhere.
    pub fn start(what: &str) -> Self {
        let bar = ProgressBar::new_spinner();
        if SPINNERS.is_hidden() {
            output::note(&format!("{what} …"));
            bar.set_draw_target(ProgressDrawTarget::hidden());
            return Self(bar);
        }
        let bar = SPINNERS.add(bar);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} ({elapsed})") {
            bar.set_style(style);
        }
        bar.set_message(what.to_owned());
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar)
    }

    /// Says what is going on now, to those who watch.
    pub fn say(&self, what: String) {
        self.0.set_message(what);
    }

    /// Prints a line above the spinners.
    pub fn line(&self, line: &str) {
        output::note(line);
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
        SPINNERS.remove(&self.0);
    }
}
