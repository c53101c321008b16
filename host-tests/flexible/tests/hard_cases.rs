//! The hard cases of links that bend, of docs/hard-cases.md.

use flexible_tests::hard::CASES;

fn demand(number: u32) {
    if let Err(wrong) = host_tests::hard::demand_of(CASES, number) {
        panic!("{wrong}");
    }
}

#[test]
fn torques_of_stiff_links_are_the_rigid_arms() {
    demand(64);
}

#[test]
fn sag_is_the_closed_forms() {
    demand(65);
}

#[test]
fn frequencies_are_the_textbooks() {
    demand(66);
}

#[test]
fn energy_stays() {
    demand(67);
}

#[test]
fn modes_that_no_link_can_have_are_named() {
    demand(68);
}

#[test]
fn a_mode_of_any_frequency_is_stable() {
    demand(69);
}

#[test]
fn numbers_go_on_from_the_63_cases_before() {
    let cases = CASES.iter().copied().flatten();
    assert!(cases.map(|case| case.number).eq(64..70));
}
