//! Large speeds and angles.

use super::demand;

#[test]
fn speed_costs_no_digits() {
    demand(15);
}

#[test]
fn a_million_rad_is_refused_and_its_remainder_is_exact() {
    demand(16);
}

#[test]
fn quarter_turns_are_angles_like_any() {
    demand(17);
}
