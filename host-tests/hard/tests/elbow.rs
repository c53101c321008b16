//! Operational space at a stretched elbow.

use crate::demand;

#[test]
fn a_stretched_elbow_is_damped_and_exact_to_the_damping() {
    demand(18);
}

#[test]
fn a_sweep_through_the_singularity_does_not_jump() {
    demand(19);
}
