use crate::{demand, demand_part};
use hard_cases::attitude::{half_a_million_steps, one_integrator};

// It keeps its length and its attitude.
#[test]
fn a_quaternion_survives_millions_of_steps() {
    demand_part(25, half_a_million_steps);
}

// It keeps them within the order of its integrator.
#[test]
fn a_tumbling_body_keeps_energy_and_momentum() {
    demand_part(26, one_integrator);
}

#[test]
fn a_heavy_top_precesses_as_its_closed_form() {
    demand(27);
}
