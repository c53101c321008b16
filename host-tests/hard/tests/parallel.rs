//! Axes that coincide, and axes that are parallel.

use crate::demand;

#[test]
fn coincident_axes_are_named_whatever_their_direction() {
    demand(20);
}

#[test]
fn parallel_axes_give_the_planar_closed_form() {
    demand(21);
}
