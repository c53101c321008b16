use crate::demand;

/// The everyday witness of the hour.
#[test]
fn a_double_pendulum_keeps_its_energy_for_seconds() {
    for row in hard_cases::energy::pendulum_for_seconds() {
        row.demand().unwrap_or_else(|wrong| panic!("{wrong}"));
    }
}

#[cfg(feature = "full")]
#[test]
fn a_double_pendulum_keeps_its_energy_for_an_hour() {
    demand(28);
}

#[test]
fn a_falling_tree_does_not_move_its_joints() {
    demand(29);
}

#[test]
fn what_rests_without_gravity_stays_exactly_at_rest() {
    demand(30);
}
