//! The hard cases of links that bend, of docs/hard-cases.md.

use flexible_tests::hard::{CASES, energy_for};
use host_tests::hard::demand_rows;

fn demand(number: u32) {
    if let Err(wrong) = host_tests::hard::demand_of(CASES, number) {
        panic!("{wrong}");
    }
}

host_tests::demanded! {
    stiff_links_need_the_rigid_arms_torques = 64;
    static_sag_has_its_closed_form = 65;
    beam_frequencies_are_those_of_the_textbook = 66;
    modes_that_no_link_can_have_are_named = 68;
    a_mode_of_any_frequency_is_stable = 69;
}

#[test]
fn a_bending_arm_keeps_its_energy() {
    // A tenth of its time; `cargo xtask test hard-cases` demands the whole case.
    let rows = energy_for(6);
    demand_rows(67, &rows).unwrap_or_else(|wrong| panic!("{wrong}"));
}

#[test]
fn flexible_case_numbers_follow_the_63_before() {
    let cases = CASES.iter().copied().flatten();
    assert!(cases.map(|case| case.number).eq(64..70));
}
