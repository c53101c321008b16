//! Large speeds and angles.

use crate::demand;

#[test]
fn high_speed_costs_no_digits() {
    demand(15);
}

#[test]
fn a_million_rad_is_refused_and_reduced_exactly() {
    demand(16);
}

#[test]
fn quarter_turns_are_as_accurate_as_other_angles() {
    demand(17);
}
