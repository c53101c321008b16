//! The count of the periods of the RP2350.

use board_support::periods::{Moment, Periods};

fn moment(micros: u32, phase: u32) -> Moment {
    Moment { micros, phase }
}

#[test]
fn a_reading_early_in_a_period_is_of_the_period_before() {
    let mut periods = Periods::starting(moment(500, 2));
    periods.advance(moment(1_503, 5));
    assert_eq!(periods.count(moment(2_490, 992)), 1);
    assert_eq!(periods.count(moment(2_500, 2)), 2);
}

#[test]
fn periods_without_an_interrupt_count_too() {
    let mut periods = Periods::starting(moment(10_007, 7));
    let moments = [(11_007, 7), (11_999, 999), (12_600, 600), (16_001, 1), (20_999, 999)];
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
