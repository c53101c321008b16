use crate::{demand, demand_part};
use hard_cases::day::quarter_of_an_hour;

#[test]
fn an_encoder_wrap_is_no_velocity_spike() {
    demand(38);
}

// The arm stays on its way.
#[test]
fn late_and_missed_ticks_keep_the_command_limits() {
    demand(39);
}

#[test]
fn time_advances_exactly_over_a_day() {
    demand_part(40, quarter_of_an_hour);
}

#[test]
fn a_blocked_arm_recovers_without_windup() {
    demand(41);
}
