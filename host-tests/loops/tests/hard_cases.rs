//! The hard cases with loops hold: a test per case.

use loop_tests::hard::{Outcome, Planar, Truth, problem, rows};

/// Runs a case and demands every row's verdict.
fn demand(number: u32) {
    loop_tests::hard::demand(number).unwrap_or_else(|wrong| panic!("{wrong}"));
}

host_tests::demanded! {
    redundant_rows_are_left_out_and_named = 49;
    a_parallelogram_near_flat = 50;
    a_change_point_of_grashof = 51;
    a_loop_that_cannot_close_is_named = 52;
    a_delta_near_its_singular_postures = 53;
    a_stewart_platform_in_its_singular_postures = 54;
    a_mass_ratio_of_a_million_across_a_loop = 55;
    three_motors_for_two_degrees_of_freedom = 56;
    a_rod_of_no_mass = 57;
    links_of_a_millimetre_and_a_metre = 58;
    a_loop_at_a_thousand_radians_a_second = 59;
    a_slider_crank_near_its_dead_point = 60;
    a_crank_after_many_turns = 61;
    a_differential_of_extreme_ratio = 62;
    a_belt_of_steep_slope = 63;
}

/// The rows that are not as demanded.
fn refused(rows: &[host_tests::hard::Row]) -> Vec<String> {
    rows.iter().filter_map(|row| row.demand().err()).collect()
}

/// The reasons for which a result is wrong.
type Change = fn(&mut Truth);

/// A torque, an acceleration and a position that are wrong by some roundings of f64 are found, each
/// in f64 alone.
#[test]
fn a_wrong_value_is_refused() {
    let setup = Planar::of(problem(49, "planar four-bar in space"));
    let truth = setup.truth();
    assert_eq!(refused(&setup.rows_against(&truth)), [""; 0]);
    let wrong: [(&str, Change); 3] = [
        ("inverse dynamics", |truth| {
            let tau = truth.states[2].tau.as_mut().expect("a torque");
            tau[0] *= 1.0 + 1e-14;
        }),
        ("forward dynamics", |truth| truth.states[1].forward[2] *= 1.0 + 1e-12),
        ("assembly", |truth| truth.states[3].q[1] += 1e-13),
    ];
    for (quantity, change) in wrong {
        let mut truth = truth.clone();
        change(&mut truth);
        let refused = refused(&setup.rows_against(&truth));
        let named = refused.iter().any(|row| row.starts_with(quantity));
        assert!(named && refused.iter().all(|row| row.contains("f64")), "{refused:?}");
    }
}

/// If a status is demanded, a number without one is refused, and so is an unbounded number with
/// one.
#[test]
fn a_number_without_its_status_is_refused() {
    let (case, quantity) = (50, "inverse dynamics, flat");
    let number = |x: f64, named| Outcome::of(&[x], named);
    let judged = |single: Outcome, double: Outcome| {
        let truth = [Some(&[1.0][..])];
        refused(&rows(case, quantity, [&[single], &[double]], &truth)).len()
    };
    assert_eq!(judged(Outcome::REFUSED, number(5.0, true)), 0);
    assert_eq!(judged(number(1.0, false), Outcome::NOTHING), 2);
    assert_eq!(judged(number(f64::NAN, true), number(1e12, true)), 2);
    // And where none is demanded, one is refused.
    let judged = rows(
        49,
        "inverse dynamics, planar four-bar in space",
        [&[number(1.0, true)], &[number(1.0, true)]],
        &[Some(&[1.0][..])],
    );
    assert_eq!(refused(&judged).len(), 2);
}
