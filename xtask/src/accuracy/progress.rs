//! A bar with the time left on stderr, where there is someone to see it; plain lines elsewhere.

use std::fmt::Write;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

use crate::output;

/// Steps of very different lengths, of which it is known how they compare.
pub struct Progress {
    bar: ProgressBar,
    pace: Arc<Mutex<Pace>>,
}

/// Seconds that were expected, and those that went by.
struct Pace {
    total: f64,
    done: f64,
    current: f64,
    begun: Instant,
    step: Instant,
}

impl Pace {
    /// Seconds left, as fast as it has gone so far.
    fn left(&self, now: Instant) -> f64 {
        let past = (self.step - self.begun).as_secs_f64();
        let slower = if self.done > 0.0 {
            past / self.done
        } else {
            1.0
        };
        let running = (now - self.step).as_secs_f64();
        let this = (self.current * slower - running).max(0.0);
        this + (self.total - self.done - self.current).max(0.0) * slower
    }

    fn share(&self, now: Instant) -> f64 {
        let running = (now - self.step).as_secs_f64().min(self.current);
        ((self.done + running) / self.total).clamp(0.0, 1.0)
    }
}

/// `about 3 min left`, from seconds.
fn in_words(left: f64) -> String {
    if left >= 90.0 {
        format!("about {:.0} min left", left / 60.0)
    } else {
        format!("about {:.0} s left", left.max(1.0))
    }
}

impl Progress {
    /// A bar of so many expected seconds.
    pub fn new(total: f64) -> Self {
        let now = Instant::now();
        let pace = Arc::new(Mutex::new(Pace {
            total,
            done: 0.0,
            current: 0.0,
            begun: now,
            step: now,
        }));
        let bar = ProgressBar::with_draw_target(Some(1000), crate::progress::target());
        let style = ProgressStyle::with_template("{share} {elapsed}, {left}  {wide_msg}");
        if let Ok(style) = style {
            let (of_share, of_left) = (Arc::clone(&pace), Arc::clone(&pace));
            bar.set_style(
                style
                    .with_key("share", move |_: &ProgressState, out: &mut dyn Write| {
                        let full = (30.0 * lock(&of_share).share(Instant::now())) as usize;
                        let _ = write!(out, "{}{}", "█".repeat(full), "░".repeat(30 - full));
                    })
                    .with_key("left", move |_: &ProgressState, out: &mut dyn Write| {
                        let left = lock(&of_left).left(Instant::now());
                        let _ = write!(out, "{}", in_words(left));
                    }),
            );
        }
        bar.enable_steady_tick(Duration::from_millis(250));
        Self { bar, pace }
    }

    /// The step before is done; this one, of so many expected seconds, begins.
    pub fn step(&self, what: &str, seconds: f64) {
        let now = Instant::now();
        let mut pace = lock(&self.pace);
        pace.done += pace.current;
        pace.current = seconds;
        pace.step = now;
        if self.bar.is_hidden() {
            output::note(&format!("{what} … ({})", in_words(pace.left(now))));
        }
        drop(pace);
        self.bar.set_message(what.to_owned());
    }
}

fn lock(pace: &Mutex<Pace>) -> std::sync::MutexGuard<'_, Pace> {
    pace.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::{Pace, in_words};

    #[test]
    fn what_is_left_follows_from_what_the_past_took() {
        let begun = Instant::now();
        let pace = Pace {
            total: 100.0,
            done: 20.0,
            current: 30.0,
            begun,
            step: begun + Duration::from_secs(40),
        };
        // Twice as slow as expected: 60 s for this step, 100 s for the rest.
        assert!((pace.left(begun + Duration::from_secs(50)) - 150.0).abs() < 1e-9);
        assert!((pace.share(begun + Duration::from_secs(50)) - 0.3).abs() < 1e-9);
        assert_eq!(in_words(150.0), "about 2 min left");
    }
}
