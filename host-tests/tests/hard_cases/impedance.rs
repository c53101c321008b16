//! A Cartesian impedance whose goal is out of reach.

use super::demand;

#[test]
fn an_arm_that_is_pulled_straight_comes_to_rest_within_its_limits_and_returns() {
    demand(70);
}
