//! Masses and inertias of very different sizes.

use crate::demand;

#[test]
fn a_tip_a_million_times_too_heavy() {
    demand(1);
}

#[test]
fn a_tip_a_million_times_too_light_costs_nothing() {
    demand(2);
}

#[test]
fn a_base_a_million_times_too_heavy_costs_nothing() {
    demand(3);
}

#[test]
fn massless_links_in_between_need_no_inertia() {
    demand(4);
}

#[test]
fn a_massless_last_link_is_named() {
    demand(5);
}

#[test]
fn an_armature_of_any_size_is_enough() {
    demand(6);
}

#[test]
fn a_weight_on_a_light_chain() {
    demand(12);
}

#[test]
fn payloads_up_to_ten_times_the_arm() {
    demand(46);
}
