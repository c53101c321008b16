//! Ticks that were missed or took too long, by the count of a timer, and what a watchdog is fed
//! with.

use crate::limits::{Fault, Status};

/// Counts the ticks of a loop by the count of a timer that advances by one per period and wraps
/// around.
///
/// A tick has a begin and an end, which the types enforce. The begin gives the number of missed
/// ticks, for [`MotionController::missed`](crate::motion::MotionController::missed); the end needs
/// the status of the tick's command and gives a [`CompletedTick`], which alone feeds a
/// [`Watchdog`], or [`Fault::Overrun`], for
/// [`MotionController::report`](crate::motion::MotionController::report).
///
/// ```
/// use motion_control::limits::{Fault, Mode, Status};
/// use motion_control::safety::{CompletedTick, TickCounter, Watchdog};
///
/// struct Reload(u32);
/// impl Watchdog for Reload {
///     fn feed(&mut self, _: CompletedTick) {
///         self.0 += 1; // write the key register of the peripheral
///     }
/// }
///
/// # let status = Status { mode: Mode::Full, fault: None, limited: false };
/// let (mut counter, mut watchdog) = (TickCounter::new(), Reload(0));
/// for (begin, missed, end, on_time) in [(7, 0, 7, true), (8, 0, 9, false), (12, 3, 12, true)] {
///     let tick = counter.begin(begin);
///     assert_eq!(tick.missed(), missed);
///     match tick.end(end, &status) {
///         Ok(completed) => watchdog.feed(completed),
///         Err(fault) => assert_eq!((fault, on_time), (Fault::Overrun, false)),
///     }
/// }
/// assert_eq!(watchdog.0, 2);
/// ```
#[doc(alias = "deadline")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TickCounter {
    last: Option<u32>,
}

/// A tick that has begun; [`Self::end`] ends it.
#[must_use = "a tick that is not ended feeds no watchdog"]
#[derive(Debug, PartialEq, Eq)]
pub struct CountedTick {
    now: u32,
    missed: u32,
}

/// The proof that a tick had a command and ended within its period. Only [`CountedTick::end`] makes
/// one.
///
/// ```compile_fail,E0423
/// let tick = motion_control::safety::CompletedTick(());
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct CompletedTick(());

/// A hardware watchdog, which resets the processor unless it is fed in time.
///
/// Every feed takes one completed tick: a loop that hangs, or whose ticks take too long, starves
/// it.
///
/// ```compile_fail,E0382
/// # use motion_control::safety::{CompletedTick, Watchdog};
/// fn twice(watchdog: &mut impl Watchdog, tick: CompletedTick) {
///     watchdog.feed(tick);
///     watchdog.feed(tick);
/// }
/// ```
pub trait Watchdog {
    /// Restarts the watchdog's period.
    fn feed(&mut self, tick: CompletedTick);
}

impl TickCounter {
    /// A counter before its first tick, which misses none.
    pub const fn new() -> Self {
        Self { last: None }
    }

    /// Begins a tick at the count `now` of the timer.
    pub fn begin(&mut self, now: u32) -> CountedTick {
        let passed = self.last.map_or(1, |last| now.wrapping_sub(last));
        self.last = Some(now);
        CountedTick { now, missed: passed.saturating_sub(1) }
    }
}

impl CountedTick {
    /// The whole ticks that have passed since the previous one without a call.
    pub fn missed(&self) -> u32 {
        self.missed
    }

    /// Ends the tick at the count `now` of the timer, after its command has been written to the
    /// drives.
    ///
    /// # Errors
    /// [`Fault::Overrun`] if the timer has advanced since the begin.
    pub fn end(self, now: u32, _: &Status) -> Result<CompletedTick, Fault> {
        if now == self.now { Ok(CompletedTick(())) } else { Err(Fault::Overrun) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrapping_count_is_no_missed_tick() {
        let mut counter = TickCounter::new();
        let missed = [u32::MAX - 1, u32::MAX, 0, 3, 3].map(|now| counter.begin(now).missed());
        assert_eq!(missed, [0, 0, 0, 2, 0]);
    }

    #[test]
    fn a_tick_that_outlasts_its_period_feeds_no_watchdog() {
        let command = crate::tests::full_command([0.0], false);
        let end = |begin, end| TickCounter::new().begin(begin).end(end, &command.status);
        assert_eq!(end(7, 7), Ok(CompletedTick(())));
        assert_eq!(end(7, 8), Err(Fault::Overrun));
    }
}
