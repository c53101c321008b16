//! Long chains, and folded ones.

use crate::demand;

#[test]
fn chains_of_8() {
    demand(7);
}

#[test]
fn chains_of_16() {
    demand(8);
}

#[test]
fn chains_of_32() {
    demand(9);
}

#[test]
fn chains_of_64_state_their_lost_digits() {
    demand(10);
}

#[test]
fn a_zigzag_of_condition_725() {
    demand(11);
}
