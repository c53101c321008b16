//! Ranges of the configuration, and rows that are refused for their numbers.

use super::*;
use crate::tests::refused;

fn of(change: fn(&mut Config)) -> Option<ConfigParameter> {
    let mut config = config(0.0);
    change(&mut config);
    refused(config.check())
}

#[test]
fn each_number_has_its_range() {
    use ConfigParameter::*;
    assert_eq!(of(|_| ()), None);
    assert_eq!(of(|c| c.noise = [1e-6, 1e6]), None);
    assert_eq!(of(|c| c.noise[1] = 0.95e-6), Some(TorqueNoise));
    assert_eq!(of(|c| c.noise[1] = 1.05e6), Some(TorqueNoise));
    assert_eq!(of(|c| c.noise[0] = f64::NAN), Some(TorqueNoise));
    assert_eq!(of(|c| (c.prior[0], c.prior[1]) = (1e-12, 1e6)), None);
    assert_eq!(of(|c| c.prior[10] = 0.95e-12), Some(ParameterDeviation));
    assert_eq!(of(|c| c.prior[10] = 1.05e6), Some(ParameterDeviation));
    assert_eq!(of(|c| c.own = [P as u16, 0]), None);
    assert_eq!(of(|c| c.own = [P as u16, 1]), Some(OwnParameters));
    assert_eq!(of(|c| c.forgetting = 0.999), None);
    assert_eq!(of(|c| c.forgetting = 1.0), Some(Forgetting));
    assert_eq!(of(|c| c.forgetting = -0.001), Some(Forgetting));
    assert_eq!(of(|c| c.forgetting = f64::NAN), Some(Forgetting));
    assert_eq!(of(|c| c.limit = 3.0), None);
    assert_eq!(of(|c| c.limit = 2.95), Some(InnovationLimit));
    assert_eq!(of(|c| c.limit = 1.05e3), Some(InnovationLimit));
    let bad = Config { limit: f64::NAN, ..config(0.0) };
    assert!(Estimator::try_new(bad).is_err());
}

#[test]
fn an_unusable_row_is_named_and_changes_no_estimate() {
    let mut estimator = Estimator::try_new(config(0.0)).expect("a good configuration");
    compared(&mut estimator, &mut Whole::new(&config(0.0), [0.0; P]), 10);
    let before = estimator;
    let joint = 1;
    let row = |place: usize, x: f64| {
        let mut row = [0.5; P];
        row[5..10].fill(0.0);
        row[place] = x;
        row
    };
    let not_finite = RejectedRow::NotFinite { joint };
    for (y, residual, reason) in [
        (row(0, f64::NAN), 1.0, not_finite),
        (row(10, f64::INFINITY), 1.0, not_finite),
        (row(6, f64::NAN), 1.0, not_finite),
        (row(0, 0.5), f64::NAN, not_finite),
        (row(0, 1e10), 1.0, RejectedRow::TooLarge { joint }),
        (row(0, 0.5), 1e10, RejectedRow::TooLarge { joint }),
        // Parameters of the other joint alone.
        (row(5, 0.1), 1.0, RejectedRow::OtherJoint { joint }),
        (row(8, -0.1), 1.0, RejectedRow::OtherJoint { joint }),
        (row(0, 0.5), 1e8, RejectedRow::Outlier { joint }),
    ] {
        let mut estimator = before;
        assert_eq!(estimator.update(joint, &y, residual), Err(reason));
        assert_eq!(estimator.factors, before.factors);
        assert_eq!(estimator.rejected(), &[0, 1]);
        // It counts as the greatest innovation.
        let level = before.consistency()[1];
        let expected = level + (1e6 - level) / 64.0;
        assert!((estimator.consistency()[1] - expected).abs() < 1e-9);
    }
    let other = [0.5, 0.5, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1];
    let reason = RejectedRow::OtherJoint { joint: 0 };
    assert_eq!(estimator.update(0, &other, 1.0), Err(reason));
}

#[test]
fn squares_up_to_10_to_the_18_are_usable() {
    // A covariance of one and a noise of one: 1 + y², and the error is the residual.
    let config = ParameterEstimatorConfig {
        noise: [1.0],
        prior: [1.0],
        own: [0],
        forgetting: 0.0,
        limit: 1e3,
    };
    for (y, residual, usable) in [(1e9, 0.0, true), (1.1e9, 0.0, false), (7e8, 8e8, false)] {
        let mut one = ParameterEstimator::<f64, 1, 1>::try_new(config).expect("good");
        let too_large = Err(RejectedRow::TooLarge { joint: 0 });
        let expected = if usable { Ok(()) } else { too_large };
        assert_eq!(one.update(0, &[y], residual), expected);
    }
}
