//! A Cartesian impedance whose goal is out of reach.

use crate::demand;

// It stays within its limits.
#[test]
fn an_arm_pulled_straight_rests_and_returns() {
    demand(70);
}
