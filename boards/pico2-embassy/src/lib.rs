//! The count of the periods of a millisecond that a PWM slice measures, from the time and the slice's own counter.
#![no_std]

#[cfg(target_arch = "arm")]
pub mod devices;

/// A period, µs.
pub const PERIOD: u32 = 1000;

/// A moment: the count of a timer that never stops, and how far the slice is in its period. Both in µs, from one oscillator.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// The timer, modulo 2³². It is read before the phase.
    pub micros: u32,
    /// 0 to [`PERIOD`] − 1.
    pub phase: u32,
}

/// Counts periods, those that no interrupt has noticed too.
///
/// ```
/// use pico2_embassy::{Moment, Periods};
/// let mut periods = Periods::starting(Moment { micros: 500, phase: 2 });
/// periods.advance(Moment { micros: 1_503, phase: 5 });
/// assert_eq!(periods.count(Moment { micros: 2_490, phase: 992 }), 1);
/// assert_eq!(periods.count(Moment { micros: 2_500, phase: 2 }), 2);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Periods {
    /// When the period began up to which `count` counts, µs.
    start: u32,
    count: u32,
}

impl Periods {
    /// The count 0 in the period of this moment.
    pub fn starting(now: Moment) -> Self {
        Self {
            start: now.start(),
            count: 0,
        }
    }

    /// The count at a moment at most half an hour after the last [`advance`](Self::advance).
    pub fn count(&self, now: Moment) -> u32 {
        // Both readings are rounded, and the slice may have begun a period between them: their difference is near a
        // multiple of the period.
        let passed = now.start().wrapping_sub(self.start);
        self.count
            .wrapping_add(passed.wrapping_add(PERIOD / 2) / PERIOD)
    }

    /// Counts on from this moment.
    pub fn advance(&mut self, now: Moment) {
        *self = Self {
            start: now.start(),
            count: self.count(now),
        };
    }
}

impl Moment {
    /// When its period began, µs.
    fn start(self) -> u32 {
        self.micros.wrapping_sub(self.phase)
    }
}

#[cfg(test)]
mod tests {
    use super::{Moment, Periods};

    fn moment(micros: u32, phase: u32) -> Moment {
        Moment { micros, phase }
    }

    #[test]
    fn periods_without_an_interrupt_count_too() {
        let mut periods = Periods::starting(moment(10_007, 7));
        let moments = [
            (11_007, 7),
            (11_999, 999),
            (12_600, 600),
            (16_001, 1),
            (20_999, 999),
        ];
        let counts = moments.map(|(micros, phase)| {
            periods.advance(moment(micros, phase));
            periods.count(moment(micros, phase))
        });
        assert_eq!(counts, [1, 1, 2, 6, 10]);
    }

    #[test]
    fn a_period_that_begins_between_the_two_readings_counts() {
        let periods = Periods::starting(moment(5_000, 0));
        assert_eq!(periods.count(moment(5_999, 0)), 1);
        assert_eq!(periods.count(moment(5_999, 998)), 0);
    }

    #[test]
    fn a_timer_wraparound_is_no_gap() {
        let mut periods = Periods::starting(moment(u32::MAX - 1_499, 3));
        for expected in 1..=4 {
            let now = (u32::MAX - 1_499).wrapping_add(1_000 * expected);
            periods.advance(moment(now, 3));
            assert_eq!(periods.count(moment(now, 3)), expected);
        }
    }
}
