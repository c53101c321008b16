//! Which measurements are refused, and when the estimator freezes, thaws and changes to another
//! load.

use super::*;
use crate::tests::refused;

/// The greatest square of an innovation.
const MOST: f64 = 16.0;

/// One joint whose torque is the first parameter.
type One = PayloadEstimator<f64, 1>;

fn one_with(prior: f64) -> One {
    let config =
        PayloadEstimatorConfig { noise: [1.0], prior: [prior; N], forgetting: 0.0, limit: 4.0 };
    One::try_new(config).expect("a good configuration")
}

/// The parameter is known to a ten-thousandth.
fn one() -> One {
    one_with(1e-4)
}

fn update(one: &mut One, torque: f64) -> Result<(), RejectedMeasurement> {
    let mut y = [[0.0; N]];
    y[0][0] = 1.0;
    one.update(&y, &[torque])
}

fn frozen(mut one: One) -> One {
    let until = ticks(1.0, MOST, |level| level > 0.25 * MOST);
    for _ in 1..until {
        assert_eq!(update(&mut one, 99.0), Err(RejectedMeasurement::Outlier));
        assert!(!one.frozen());
    }
    assert_eq!(update(&mut one, 99.0), Err(RejectedMeasurement::Frozen));
    assert!(one.frozen());
    one
}

#[test]
fn each_number_of_the_configuration_has_its_range() {
    let of = |change: fn(&mut PayloadEstimatorConfig<f64, V>)| {
        let mut config = config(0.0);
        change(&mut config);
        refused(config.check())
    };
    use ConfigParameter::*;
    assert_eq!(of(|c| (c.noise[0], c.noise[1]) = (1e-6, 1e6)), None);
    assert_eq!(of(|c| c.noise[2] = 0.95e-6), Some(TorqueNoise));
    assert_eq!(of(|c| c.noise[2] = 1.05e6), Some(TorqueNoise));
    assert_eq!(of(|c| (c.prior[0], c.prior[9]) = (1e-6, 1e6)), None);
    assert_eq!(of(|c| c.prior[9] = 0.95e-6), Some(PriorDeviation));
    assert_eq!(of(|c| c.prior[9] = f64::NAN), Some(PriorDeviation));
    assert_eq!(of(|c| c.forgetting = 1.0), Some(Forgetting));
    assert_eq!(of(|c| c.forgetting = -0.01), Some(Forgetting));
    assert_eq!(of(|c| c.limit = 3.0), None);
    assert_eq!(of(|c| c.limit = 1.05e3), Some(InnovationLimit));
    assert_eq!(of(|c| c.limit = 2.95), Some(InnovationLimit));
    let bad = PayloadEstimatorConfig { limit: f64::NAN, ..config(0.0) };
    assert!(Estimator::try_new(bad).is_err());
}

#[test]
fn numbers_that_cannot_be_used_change_nothing() {
    let mut estimator = estimator(0.0);
    let (y, residual) = rows(&mut Numbers(5));
    assert_eq!(estimator.update(&y, &residual), Ok(()));
    let before = estimator;
    let joint = 1;
    for bad in [f64::NAN, f64::INFINITY] {
        let not_finite = Err(RejectedMeasurement::NotFinite { joint });
        let mut wrong = residual;
        wrong[joint] = bad;
        assert_eq!(estimator.update(&y, &wrong), not_finite);
        for k in [0, 9] {
            let mut wrong = y;
            wrong[joint][k] = bad;
            assert_eq!(estimator.update(&wrong, &residual), not_finite);
            let of_two = estimator.update_joints([2, 1], &wrong, &residual);
            assert_eq!(of_two, not_finite);
            // A joint that is not used may have any.
            let mut others = before;
            let of_others = others.update_joints([0, 2], &wrong, &residual);
            assert_eq!(of_others, Ok(()));
        }
    }
    let too_large = Err(RejectedMeasurement::TooLarge);
    assert_eq!(estimator.update(&y, &[0.0, 0.0, 1.01e9]), too_large);
    // The sum of all squares counts, each over its noise.
    assert_eq!(estimator.update(&y, &[0.0, 1.5e9, 0.8e9]), too_large);
    assert_eq!(estimator, before);
    let outlier = Err(RejectedMeasurement::Outlier);
    let none = [[0.0; N]; V];
    assert_eq!(estimator.update(&none, &[0.0, 0.0, 1e9]), outlier);
}

#[test]
fn a_torque_beyond_the_limit_is_an_outlier() {
    let mut one = one();
    let before = *one.factors();
    assert_eq!(update(&mut one, 4.01), Err(RejectedMeasurement::Outlier));
    assert_eq!(*one.factors(), before);
    assert!((one.consistency() - (1.0 + (MOST - 1.0) / 64.0)).abs() < 1e-12);
    assert_eq!(update(&mut one, 3.99), Ok(()));
    // Without a direction the innovation is that of the torque: at the limit, it is within.
    let mut at = self::one();
    assert_eq!(at.update(&[[0.0; N]], &[4.0]), Ok(()));
    // As high as the level may be.
    let mut high = self::one();
    high.level = 0.25 * MOST;
    assert_eq!(high.update(&[[0.0; N]], &[2.0]), Ok(()));
}

#[test]
fn torques_of_the_load_thaw_the_estimate() {
    let mut one = frozen(one());
    let estimate = one.inertia();
    let until = ticks(one.consistency(), 0.0, |level| level <= 0.16 * MOST);
    for _ in 0..until {
        assert!(one.frozen());
        assert_eq!(update(&mut one, 0.0), Err(RejectedMeasurement::Frozen));
    }
    assert!(!one.frozen());
    assert_eq!(one.inertia(), estimate);
    assert_eq!(update(&mut one, 0.0), Ok(()));
}

/// One that has learned a load, and is frozen at it.
fn frozen_at(load: f64) -> One {
    let mut one = one_with(30.0);
    one.level = 0.0;
    for _ in 0..500 {
        let _ = update(&mut one, load);
    }
    assert!(!one.frozen());
    while !one.frozen() {
        assert!(update(&mut one, load + 500.0).is_err());
    }
    one
}

fn mass(one: &One) -> f64 {
    let [mass, ..] = one.inertia().parameters();
    mass
}

#[test]
fn a_freeze_keeps_the_error_of_the_load_before() {
    let mut one = frozen_at(7.0);
    let mass = mass(&one);
    for torque in [mass + 1.0, mass - 2.0, mass + 99.0] {
        let square = (torque - mass) * (torque - mass);
        let level = one.consistency();
        let expected = level + (square.min(MOST) - level) / 64.0;
        assert_eq!(update(&mut one, torque), Err(RejectedMeasurement::Frozen));
        assert!((one.consistency() - expected).abs() < 1e-9);
    }
    // For several joints it is the mean.
    let mut three = estimator(0.0);
    three.freeze();
    three.level = 1e6;
    let residual = [1.0, 2.0, 3.0];
    assert!(three.update(&[[0.0; N]; V], &residual).is_err());
    let square = (4.0 + 1.0 + 9.0) / 3.0;
    let expected = 1e6 + (square - 1e6) / 64.0;
    assert!((three.consistency() - expected).abs() < 1e-6);
}

#[test]
fn another_load_is_taken_over_after_1024_ticks() {
    let mut one = frozen_at(7.0);
    let load = 40.0;
    for _ in 1..1024 {
        assert_eq!(update(&mut one, load), Err(RejectedMeasurement::Frozen));
        assert!(one.frozen());
    }
    let level = one.freeze.map(|freeze| freeze.level);
    assert_eq!(update(&mut one, load), Err(RejectedMeasurement::Frozen));
    assert!(!one.frozen());
    // The knowledge from the ticks since the freeze.
    assert!((mass(&one) - load).abs() < 0.01, "{}", mass(&one));
    let level = level.expect("frozen before") * 63.0 / 64.0;
    assert!((one.consistency() - level).abs() < 1e-6);
    assert_eq!(update(&mut one, load), Ok(()));
}

#[test]
fn a_load_that_the_prior_excludes_is_not_taken_over() {
    // 4 deviations of 30 are 120.
    for (size, taken) in [(119.5, true), (120.5, false)] {
        for load in [size, -size] {
            let mut one = frozen_at(7.0);
            for _ in 0..1100 {
                let _ = update(&mut one, load);
            }
            assert_eq!(!one.frozen(), taken, "{load}");
        }
    }
}

#[test]
fn ticks_of_a_fault_begin_the_other_load_anew() {
    // Torques that no load explains, and then another load.
    let mut one = frozen_at(7.0);
    let fault = |tick: u32| [100.0, -100.0][tick as usize % 2];
    let count = |one: &One| one.freeze.map(|freeze| (freeze.ticks, freeze.level));
    for tick in 1..256 {
        let _ = update(&mut one, fault(tick));
        assert_eq!(count(&one).map(|(ticks, _)| ticks), Some(tick));
    }
    let parameters = one.freeze.map(|freeze| freeze.parameters);
    let _ = update(&mut one, fault(256));
    assert_eq!(count(&one), Some((0, MOST)));
    assert_eq!(one.freeze.map(|freeze| freeze.parameters), parameters);
    let start = Factors::of(one.start);
    assert_eq!(*one.other(), start);
    for _ in 0..1024 {
        assert!(one.frozen());
        let _ = update(&mut one, 40.0);
    }
    assert!(!one.frozen());
    assert!((mass(&one) - 40.0).abs() < 0.01, "{}", mass(&one));
}

/// One of a limit of 5, whose bounds are 2² and 2.5², frozen at no load with these levels and ticks
/// of the other load.
fn frozen_with(level: f64, other: f64, ticks: u32) -> One {
    let config =
        PayloadEstimatorConfig { noise: [1.0], prior: [2.0; N], forgetting: 0.0, limit: 5.0 };
    let mut one = One::try_new(config).expect("a good configuration");
    one.freeze();
    one.level = level;
    if let Some(freeze) = &mut one.freeze {
        (freeze.level, freeze.ticks) = (other, ticks);
    }
    one
}

// A torque without a direction keeps the level that is its square.
#[test]
fn levels_at_their_bounds_thaw_and_do_not_begin_anew() {
    let none = [[0.0; N]];
    let mut load = frozen_with(4.0, 25.0, 0);
    assert!(load.update(&none, &[2.0]).is_err());
    assert_eq!((load.level, load.frozen()), (4.0, false));
    let mut other = frozen_with(20.0, 4.0, 1023);
    assert!(other.update(&none, &[2.0]).is_err());
    assert_eq!((other.level, other.frozen()), (4.0, false));
    let mut fault = frozen_with(20.0, 6.25, 300);
    assert!(fault.update(&none, &[2.5]).is_err());
    assert_eq!(fault.freeze.map(|freeze| freeze.ticks), Some(301));
}

#[test]
fn a_load_at_the_limit_of_its_prior_is_expected() {
    // 5 deviations of 2.
    for (x, expected) in [(10.0, true), (-10.0, true), (10.01, false)] {
        let mut one = frozen_with(20.0, 4.0, 1023);
        one.other().rows[9][10] = x;
        assert_eq!(one.other_is_expected(), expected, "{x}");
    }
}
