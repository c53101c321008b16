//! Descriptions that no body can have, and those that only look so.

use crate::demand;

#[test]
fn impossible_inertias_are_named_and_still_computed() {
    demand(22);
}

#[test]
fn asymmetric_and_indefinite_inertias_are_named() {
    demand(23);
}

#[test]
fn an_axis_of_any_length_but_zero_is_a_direction() {
    demand(24);
}
