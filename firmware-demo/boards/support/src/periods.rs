//! The count of the periods of a millisecond that a PWM slice measures, from the time and the
//! slice's own counter.

/// A period, µs.
pub const PERIOD: u32 = 1000;

/// A moment: the count of a timer that never stops, and how far the slice is in its period. Both in
/// µs, from one oscillator.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// The timer, modulo 2³². It is read before the phase.
    pub micros: u32,
    /// 0 to [`PERIOD`] − 1.
    pub phase: u32,
}

/// Counts periods, those that no interrupt has noticed too.
#[derive(Clone, Copy, Debug)]
pub struct Periods {
    /// When the period began up to which `count` counts, µs.
    start: u32,
    count: u32,
}

impl Periods {
    /// The count 0 in the period of this moment.
    pub fn starting(now: Moment) -> Self {
        Self { start: now.start(), count: 0 }
    }

    /// The count at a moment at most half an hour after the last [`advance`](Self::advance).
    pub fn count(&self, now: Moment) -> u32 {
        // Both readings are rounded, and the slice may have begun a period between them: their
        // difference is near a multiple of the period.
        let passed = now.start().wrapping_sub(self.start);
        self.count.wrapping_add(passed.wrapping_add(PERIOD / 2) / PERIOD)
    }

    /// Counts on from this moment.
    pub fn advance(&mut self, now: Moment) {
        *self = Self { start: now.start(), count: self.count(now) };
    }
}

impl Moment {
    /// When its period began, µs.
    fn start(self) -> u32 {
        self.micros.wrapping_sub(self.phase)
    }
}
