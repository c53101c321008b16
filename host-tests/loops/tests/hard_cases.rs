//! The hard cases with loops hold: a test per case.

use loop_tests::hard::CASES;

/// Runs a case and demands every row's verdict.
fn demand(number: u32) {
    loop_tests::hard::demand(number).unwrap_or_else(|wrong| panic!("{wrong}"));
}

#[test]
fn redundant_rows_are_left_out_and_named() {
    demand(49);
}

#[test]
fn a_parallelogram_near_flat() {
    demand(50);
}

#[test]
fn a_change_point_of_grashof() {
    demand(51);
}

#[test]
fn a_loop_that_cannot_close_is_named() {
    demand(52);
}

#[test]
fn a_delta_near_its_singular_postures() {
    demand(53);
}

#[test]
fn a_stewart_platform_in_its_singular_postures() {
    demand(54);
}

#[test]
fn a_mass_ratio_of_a_million_across_a_loop() {
    demand(55);
}

#[test]
fn three_motors_for_two_degrees_of_freedom() {
    demand(56);
}

#[test]
fn a_rod_of_no_mass() {
    demand(57);
}

#[test]
fn links_of_a_millimetre_and_a_metre() {
    demand(58);
}

#[test]
fn a_loop_at_a_thousand_radians_a_second() {
    demand(59);
}

#[test]
fn a_slider_crank_near_its_dead_point() {
    demand(60);
}

#[test]
fn a_crank_after_many_turns() {
    demand(61);
}

#[test]
fn a_differential_of_extreme_ratio() {
    demand(62);
}

#[test]
fn a_belt_of_steep_slope() {
    demand(63);
}

#[test]
fn numbers_go_on_from_the_other_cases() {
    let numbers = |cases: &[&[host_tests::hard::Case]]| -> Vec<u32> {
        cases
            .iter()
            .copied()
            .flatten()
            .map(|case| case.number)
            .collect()
    };
    let mut all = numbers(host_tests::hard::CASES);
    all.extend(numbers(CASES));
    all.sort_unstable();
    assert!(all.windows(2).all(|pair| pair[0] + 1 == pair[1]), "{all:?}");
}
