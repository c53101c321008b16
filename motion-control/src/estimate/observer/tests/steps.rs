//! One step of each kind, in numbers.

use super::*;
use crate::tests::estimate_of;

/// An observer of two joints that move, with a tick of 0.5 s and a step of the gains that is not
/// small.
fn moving() -> Observer<f64, 2> {
    let (bandwidth, tick) = (1.5, 0.5);
    let mut observer = Observer::new(ObserverConfig { bandwidth, tick });
    observer.reset(&[0.0; 2]);
    observer.estimate = estimate_of([1.0, -2.0], [4.0, -0.5]);
    observer
}

/// (1 − β²) and (1 − β)²/h at β = exp(−ω_o h), of the exponential's series.
fn gains() -> [f64; 2] {
    let gap = one_less_decay(1.5 * 0.5);
    [1.0 - (1.0 - gap) * (1.0 - gap), gap * gap / 0.5]
}

fn near(got: &Estimate<f64, 2>, want: [[f64; 2]; 2]) {
    let pairs = got.q.iter().chain(&got.qd).zip(want.as_flattened());
    for (got, want) in pairs {
        assert!((got - want).abs() < 1e-14, "{got}, not {want}");
    }
}

#[test]
fn a_measurement_corrects_what_was_predicted() {
    let (mut observer, [position, velocity]) = (moving(), gains());
    // q̂⁻ = q̂ + h q̇̂ + ½ h² q̈, q̇̂⁻ = q̇̂ + h q̈ with q̈ = 8 and −4.
    let (q, qd) = ([1.0 + 2.0 + 1.0, -2.0 - 0.25 - 0.5], [4.0 + 4.0, -2.5]);
    near(&observer.clone().predict(&[8.0, -4.0]), [q, qd]);
    let measured = [5.0, -3.5];
    let errors = [0, 1].map(|k| measured[k] - q[k]);
    let want =
        [[0, 1].map(|k| q[k] + position * errors[k]), [0, 1].map(|k| qd[k] + velocity * errors[k])];
    near(&observer.update(&measured, &[8.0, -4.0]), want);
    near(observer.estimate(), want);
}

#[test]
fn a_late_measurement_corrects_before_it_is_extrapolated() {
    let (mut observer, [position, velocity]) = (moving(), gains());
    let (measured, qdd) = ([1.5, -3.0], [8.0, -4.0]);
    let want = [0, 1].map(|k| {
        let (q, qd) = ([1.0, -2.0][k], [4.0, -0.5][k]);
        let e = measured[k] - q;
        let (q, qd) = (q + position * e, qd + velocity * e);
        [q + 0.5 * qd + 0.125 * qdd[k], qd + 0.5 * qdd[k]]
    });
    let want = [want.map(|[q, _]| q), want.map(|[_, qd]| qd)];
    near(observer.update_delayed(&measured, &qdd), want);
    near(observer.estimate(), want);
}

#[test]
fn a_sinking_arm_is_followed_without_an_acceleration() {
    let (mut observer, [position, velocity]) = (moving(), gains());
    let mut same = observer;
    same.update(&[3.5, -2.0], &[0.0; 2]);
    observer.follow(&[3.5, -2.0]);
    let q = [3.0 + 0.5 * position, -2.25 + 0.25 * position];
    let qd = [4.0 + 0.5 * velocity, -0.5 + 0.25 * velocity];
    near(observer.estimate(), [q, qd]);
    near(observer.estimate(), [same.estimate.q, same.estimate.qd]);
}

#[test]
fn a_corrected_position_keeps_the_velocity() {
    let (mut observer, mut late) = (moving(), moving());
    observer.correct_position(&[7.0, 8.0]);
    near(observer.estimate(), [[7.0, 8.0], [4.0, -0.5]]);
    // A late one goes on for a tick.
    late.correct_position_delayed(&[7.0, 8.0]);
    near(late.estimate(), [[9.0, 7.75], [4.0, -0.5]]);
    late.reset(&[1.0, 2.0]);
    near(late.estimate(), [[1.0, 2.0], [0.0, 0.0]]);
}

#[test]
fn only_positive_numbers_are_a_bandwidth_and_a_tick() {
    use ConfigParameter::{Bandwidth, Tick};
    let config = |bandwidth, tick| ObserverConfig { bandwidth, tick };
    assert_eq!(config(1e-9, 1e-9).check(), Ok(()));
    let refused = |parameter| Err(ConfigError::OutOfRange { parameter });
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(config(250.0, bad).check(), refused(Tick));
        assert_eq!(config(bad, H).check(), refused(Bandwidth));
        assert!(Observer::<f64, 1>::try_new(config(bad, H)).is_err());
    }
    let new = Observer::<f64, 1>::try_new(config(250.0, H));
    assert_eq!(new, Ok(observer(250.0)));
    // An observer that has no position is at rest at zero.
    assert!(!observer(250.0).started() && observer(250.0).tick() == H);
    assert_eq!(observer(250.0).estimate, estimate_of([0.0], [0.0]));
}
