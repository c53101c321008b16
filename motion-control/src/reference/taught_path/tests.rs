//! Claims about recording.

use super::*;
use crate::reference::GeometricPath;

fn taught() -> TaughtPath<f64, 2, 4> {
    TaughtPath::try_new([0.1, 0.2]).expect("good")
}

#[test]
fn way_points_are_at_least_the_spacing_apart() {
    let mut taught = taught();
    for k in 0..=2900 {
        let x = f64::from(k) * 1e-4;
        taught.record(&[x, 0.0]);
    }
    let points: [f64; 3] = core::array::from_fn(|k| taught.points()[k][0]);
    assert_eq!(taught.points().len(), 3);
    let off = [points[1] - 0.1, points[2] - 0.2].map(f64::abs);
    assert!(off[0] < 1.1e-4 && off[1] < 2.1e-4, "{points:?}");
    // Joints count by their spacings.
    taught.clear();
    for (q, recorded) in [
        ([0.0, 0.0], Recorded::Stored),
        ([0.0, 0.199], Recorded::Near),
        ([0.059, 0.159], Recorded::Near),
        ([0.061, 0.161], Recorded::Stored),
    ] {
        assert_eq!(taught.record(&q), recorded);
    }
}

#[test]
fn the_path_ends_where_the_arm_is() {
    for (end, count) in [(0.14, 2), (0.16, 3), (0.5, 3)] {
        let mut taught = taught();
        taught.record(&[0.0, 0.0]);
        taught.record(&[0.1, 0.0]);
        assert_eq!(taught.end(&[end, 0.0]), Recorded::Stored);
        assert_eq!(taught.points().len(), count);
        assert_eq!(taught.points()[count - 1][0], end);
    }
    // An arm that has not moved has no path.
    let mut taught = taught();
    taught.record(&[0.0; 2]);
    assert_eq!(taught.end(&[0.01; 2]), Recorded::Near);
    assert_eq!(taught.spline(&[0.0; 2]), Err(PathSplineError::TooFew));
}

#[test]
fn a_full_path_keeps_its_points_and_is_playable() {
    let mut taught = taught();
    for k in 0..4 {
        assert_eq!(taught.record(&[f64::from(k), 0.0]), Recorded::Stored);
    }
    let before = taught;
    assert_eq!(taught.record(&[5.0, 0.0]), Recorded::Full);
    assert_eq!(taught.end(&[5.0, 0.0]), Recorded::Full);
    assert_eq!(taught, before);
    let path = taught.spline(&[0.0; 2]).expect("good");
    assert_eq!(path.point(1.0).q, [3.0, 0.0]);
}

#[test]
fn positions_that_are_not_finite_change_nothing() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut taught = taught();
        taught.record(&[0.0; 2]);
        let before = taught;
        assert_eq!(taught.record(&[bad, 1.0]), Recorded::NotFinite { joint: 0 });
        assert_eq!(taught.end(&[1.0, bad]), Recorded::NotFinite { joint: 1 });
        assert_eq!(taught, before);
    }
    // A position that is finite and absurd is a way-point, and its path is refused or finite.
    let mut taught = taught();
    taught.record(&[0.0; 2]);
    assert_eq!(taught.record(&[f64::MAX, 0.0]), Recorded::Stored);
    assert_eq!(taught.spline(&[0.0; 2]), Err(PathSplineError::TooLong));
}

#[test]
fn a_spacing_that_is_no_positive_number_is_refused() {
    let error = ConfigError::OutOfRange { parameter: ConfigParameter::PathSpacing };
    for bad in [0.0, -0.1, f64::NAN, f64::INFINITY, 1e-320] {
        assert_eq!(TaughtPath::<f64, 2, 4>::try_new([0.1, bad]), Err(error));
    }
}
