use crate::{demand, demand_part};
use hard_cases::pendulum::pendulum_for_seconds;

#[test]
fn a_double_pendulum_keeps_its_energy() {
    demand_part(28, pendulum_for_seconds);
}

#[test]
fn a_falling_tree_does_not_move_its_joints() {
    demand(29);
}

#[test]
fn what_rests_without_gravity_stays_exactly_at_rest() {
    demand(30);
}
