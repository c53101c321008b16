use crate::demand;

// It keeps its length and its attitude.
#[test]
fn a_quaternion_survives_ten_million_steps() {
    demand(25);
}

// It keeps them within the order of its integrator.
#[test]
fn a_tumbling_body_keeps_energy_and_momentum() {
    demand(26);
}

#[test]
fn a_heavy_top_precesses_as_its_closed_form() {
    demand(27);
}
