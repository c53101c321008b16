//! Descriptions that no body can have, and those that only look so.

use super::demand;

#[test]
fn an_axis_of_any_length_but_zero_is_a_direction() {
    demand(24);
}
