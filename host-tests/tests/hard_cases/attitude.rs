use super::demand;

#[test]
fn a_quaternion_keeps_its_length_and_attitude_for_ten_million_steps() {
    demand(25);
}

#[test]
fn a_body_that_turns_over_keeps_energy_and_momentum_within_its_integrators_order() {
    demand(26);
}

#[test]
fn a_heavy_top_precesses_as_its_closed_form() {
    demand(27);
}
