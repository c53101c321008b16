//! Invariances of the dynamics.

use crate::demand;

#[test]
fn frame_gravity_and_root_do_not_matter() {
    demand(44);
}

#[test]
fn numbering_does_not_matter() {
    demand(45);
}

#[test]
fn rounded_rotations_separate_crba_and_aba_within_kappa() {
    demand(48);
}
