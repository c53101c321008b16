//! The checks of measured values notice what they are for.

use std::panic::catch_unwind;

use host_tests::measured::{largest, within};

#[test]
fn the_largest_of_values_keeps_nan_wherever_it_stands() {
    assert_eq!(largest([0.5, 2.0, 1.0]), 2.0);
    assert_eq!(largest([-3.0_f32, -2.0]), -2.0);
    assert_eq!(largest([1.0, f64::INFINITY]), f64::INFINITY);
    for values in [
        [f64::NAN, 1.0, 2.0],
        [1.0, f64::NAN, 2.0],
        [1.0, 2.0, f64::NAN],
        [f64::INFINITY, f64::NAN, 1.0],
        [f64::NAN; 3],
    ] {
        assert!(largest(values).is_nan(), "{values:?}");
    }
    assert!(largest([1.0, f32::NAN]).is_nan());
}

#[test]
fn a_bound_holds_from_its_tenth_to_itself() {
    for (measured, bound) in [(1.0, 1.0), (0.1, 1.0), (0.0, 0.0), (3e-16, 1e-15)] {
        within("a value", measured, bound);
    }
    within("a value in f32", 0.5_f32, 1.0);
}

#[test]
fn nan_excess_slack_and_nothing_measured_are_noticed() {
    for (measured, bound, remark) in [
        (f64::NAN, 1.0, "exceeded"),
        (1.0, f64::NAN, "exceeded"),
        (f64::NAN, f64::INFINITY, "exceeded"),
        (f64::INFINITY, 1.0, "exceeded"),
        (1.001, 1.0, "exceeded"),
        (1e-300, 0.0, "exceeded"),
        (0.099, 1.0, "slack"),
        (0.0, 1e-300, "slack"),
        (1.0, f64::INFINITY, "slack"),
        (largest::<f64>([]), 1.0, "slack"),
        (largest::<f64>([]), 0.0, "slack"),
        (-1.0, 0.0, "slack"),
    ] {
        let panic = catch_unwind(|| within("the value", measured, bound)).unwrap_err();
        let message = panic.downcast_ref::<String>().unwrap();
        assert!(message.starts_with("the value: "), "{message}");
        assert!(message.contains(remark), "{measured} {bound}: {message}");
    }
}
