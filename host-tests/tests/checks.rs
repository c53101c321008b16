//! The comparisons of errors with bounds fail when they must: the tables of tolerances and of hard
//! cases; and the compiler refuses what is wrong, at the line of its user.

#[path = "checks/mistakes.rs"]
mod mistakes;

use host_tests::hard::{Row, Verdict};
use host_tests::measured::larger;
use host_tests::tolerances::{Errors, check};

/// An entry of the table: 1e-15 in f64, 5e-7 in f32.
fn rnea(scalar: &str, error: f64) -> Result<(), String> {
    check("ur5e", "rnea", scalar, error)
}

#[test]
fn only_an_error_beyond_its_bound_is_refused() {
    assert_eq!(rnea("f64", 1e-15), Ok(()));
    assert_eq!(rnea("f32", 5e-7), Ok(()));
    for (scalar, error) in [("f64", 1.01e-15), ("f32", 5.01e-7), ("f64", 5e-7)] {
        let refused = rnea(scalar, error).expect_err("beyond");
        assert!(refused.contains("exceeded"), "{refused}");
    }
}

#[test]
fn an_error_that_is_not_a_number_is_refused() {
    for scalar in ["f32", "f64"] {
        for error in [f64::NAN, f64::INFINITY] {
            let refused = rnea(scalar, error).expect_err("no number");
            assert!(refused.contains("exceeded"), "{refused}");
        }
    }
}

#[test]
fn a_bound_more_than_ten_times_its_error_is_refused() {
    assert_eq!(rnea("f64", 1.01e-16), Ok(()));
    for error in [0.99e-16, 1e-18, 0.0] {
        let refused = rnea("f64", error).expect_err("slack");
        assert!(refused.contains("slack"), "{refused}");
    }
}

#[test]
fn an_error_without_a_bound_is_refused() {
    assert!(check("ur5e", "no such quantity", "f64", 0.0).is_err());
    assert!(check("no such robot", "rnea", "f64", 0.0).is_err());
    // Measured in one scalar alone.
    assert!(check("ur5e", "engine gravity", "f64", 1e-16).is_err());
}

// A slack bound is more than ten times the value.
#[test]
fn a_measured_row_passes_within_a_tight_bound() {
    let demand = |error, bound| Row::measured("τ", "f32", error, bound).demand();
    assert_eq!(demand(1e-6, 1e-6), Ok(()));
    assert_eq!(demand(1e-6, 0.99e-5), Ok(()));
    for (error, bound, why) in [
        (1.01e-6, 1e-6, "fails"),
        (f64::NAN, 1e-6, "fails"),
        (f64::INFINITY, 1e-6, "fails"),
        (1e-6, 1.01e-5, "slack"),
        (1e-8, 1e-6, "slack"),
    ] {
        let refused = demand(error, bound).expect_err(why);
        assert!(refused.contains(why), "{refused}");
    }
}

#[test]
fn a_stated_bound_may_be_slack_but_not_broken() {
    let demand = |error, bound| Row::stated("τ", "f32", error, bound).demand();
    assert_eq!(demand(0.0, 1e-6), Ok(()));
    assert!(demand(1.01e-6, 1e-6).is_err());
    assert!(demand(f64::NAN, 1e-6).is_err());
}

#[test]
fn a_claim_must_hold_and_a_naive_alternative_fail() {
    assert_eq!(Row::claim("sorted", "f32", true).demand(), Ok(()));
    assert!(Row::claim("sorted", "f32", false).demand().is_err());
    let naive = |error| Row::naive("τ, naive", "f32", error, 1e-6);
    assert_eq!(naive(1e-5).verdict, Verdict::Shown);
    assert_eq!(naive(f64::NAN).demand(), Ok(()));
    assert!(naive(1e-7).demand().is_err());
}

#[test]
fn the_larger_of_two_prefers_nan() {
    assert_eq!(larger(1.0, 2.0), 2.0);
    assert_eq!(larger(2.0, 1.0), 2.0);
    assert!(larger(f64::NAN, 1.0).is_nan() && larger(1.0, f64::NAN).is_nan());
    use firmware_demo::scene;
    assert_eq!(scene::larger(1.0, 2.0), 2.0);
    assert_eq!(scene::larger(2.0, 1.0), 2.0);
    assert!(scene::larger(f32::NAN, 1.0).is_nan() && scene::larger(1.0, f32::NAN).is_nan());
}

/// The errors of two states of `rnea` in f64, the full scale 4.
fn collected(errors: [f64; 2]) -> Errors {
    let mut collected = Errors::new("ur5e");
    for (error, scale) in errors.into_iter().zip([4.0, 2.0]) {
        collected.add("rnea", "f64", &[scale + error, 0.0], &[scale, 0.0]);
    }
    collected
}

#[test]
fn errors_are_the_largest_relative_to_the_largest_value() {
    // Powers of two, so that the sums are exact.
    let [large, small] = [50, 51].map(|n| 0.5_f64.powi(n));
    let errors = collected([small, large]);
    assert_eq!(errors.of("rnea", "f64"), Some(large / 4.0));
    assert_eq!(errors.of("rnea", "f32"), None);
    errors.check();
}

#[test]
#[should_panic(expected = "exceeded")]
fn an_error_among_those_of_several_states_is_refused() {
    collected([0.0, 1e-14]).check();
}

#[test]
#[should_panic(expected = "no bound")]
fn errors_of_a_quantity_without_a_bound_are_refused() {
    let mut errors = Errors::new("ur5e");
    errors.add("no such quantity", "f64", &[1.0], &[1.0]);
    errors.check();
}
