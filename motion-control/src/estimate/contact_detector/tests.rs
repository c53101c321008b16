//! Single ticks of the detector, in closed form.

use super::*;

const H: f64 = 0.5;
const CONFIG: ObserverConfig<f64> = ObserverConfig { bandwidth: 1.0, tick: H };
const MARGIN: [f64; 2] = [1.0, 2.0];

type Detector<const ORDER: usize> = ContactDetector<f64, 2, ORDER>;

fn detector<const ORDER: usize>() -> Detector<ORDER> {
    ContactDetector::try_new(CONFIG, MARGIN).expect("a good configuration")
}

/// A tick of an arm that stands still although its drives push by `tau`, of a model with these
/// errors.
fn tick<const ORDER: usize>(
    detector: &mut Detector<ORDER>,
    tau: [f64; 2],
    errors: [f64; 2],
) -> Option<DetectedContact<f64>> {
    let contact = detector.update(&[0.0; 2], &[0.0; 2], &errors);
    detector.drive(&tau);
    contact.expect("finite")
}

fn gap() -> f64 {
    crate::estimate::observer::one_less_decay(CONFIG.bandwidth * CONFIG.tick)
}

#[track_caller]
fn near(got: [f64; 2], expected: [f64; 2]) {
    let gap = |i: usize| (got[i] - expected[i]).abs();
    assert!(gap(0).max(gap(1)) < 1e-12, "{got:?} {expected:?}");
}

#[test]
fn a_margin_that_is_not_a_positive_number_is_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Detector::<1>::try_new(CONFIG, [1.0, bad]);
        let parameter = ConfigParameter::ContactMargin;
        assert_eq!(refused, Err(ConfigError::OutOfRange { parameter }));
    }
}

#[test]
fn the_threshold_follows_the_mean_of_the_stated_errors() {
    let mut one = detector::<1>();
    assert_eq!(one.threshold(), MARGIN);
    // There is no mean before the second measurement.
    tick(&mut one, [0.0; 2], [4.0, -2.0]);
    assert_eq!(one.threshold(), MARGIN);
    tick(&mut one, [0.0; 2], [-2.0, 6.0]);
    let first = [3.0, 4.0].map(|mean| gap() * mean);
    near(one.threshold(), [1.0 + first[0], 2.0 + first[1]]);
    // The second bound of a detector of second order follows the first.
    let mut two = detector::<2>();
    tick(&mut two, [0.0; 2], [4.0, -2.0]);
    tick(&mut two, [0.0; 2], [-2.0, 6.0]);
    let second = first.map(|bound| gap() * bound);
    near(two.threshold(), [1.0 + second[0], 2.0 + second[1]]);
}

#[test]
fn a_contact_is_named_with_its_torque() {
    let mut detector = detector::<1>();
    let contacts = [(); 3].map(|()| tick(&mut detector, [3.0, -9.0], [0.0; 2]));
    let torque = 9.0 * gap();
    assert!(torque > MARGIN[1], "beyond the margin in its first tick");
    let [None, Some(first), Some(_)] = contacts else {
        panic!("{contacts:?}");
    };
    assert_eq!(first.joint, 1);
    assert!((first.torque - torque).abs() < 1e-12);
    assert_eq!(detector.external_torque()[1], contacts[2].unwrap().torque);
    // The error of the model explains it.
    let mut detector = self::detector::<1>();
    for _ in 0..20 {
        assert_eq!(tick(&mut detector, [3.0, -9.0], [3.0, 9.0]), None);
    }
}

#[test]
fn numbers_that_are_not_finite_change_nothing() {
    let mut detector = detector::<1>();
    tick(&mut detector, [1.0; 2], [1.0; 2]);
    let before = detector;
    let fault = Err(Fault::NotFinite { joint: 1 });
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(detector.update(&[0.0; 2], &[0.0; 2], &[0.0, bad]), fault);
        assert_eq!(detector.update(&[0.0, bad], &[0.0; 2], &[9.0; 2]), fault);
        assert_eq!(detector, before);
    }
}

#[test]
fn a_restart_forgets_torques_and_bounds() {
    let mut detector = detector::<1>();
    (0..5).for_each(|_| _ = tick(&mut detector, [3.0; 2], [1.0; 2]));
    assert!(detector.threshold()[0] > 1.1 && detector.external_torque()[0] < -1.0);
    detector.restart();
    assert_eq!(detector.threshold(), MARGIN);
    assert_eq!(detector.external_torque(), &[0.0; 2]);
    // The first measurement sets the momentum, and there is no mean with what was before.
    let contact = detector.update(&[50.0; 2], &[0.0; 2], &[9.0; 2]);
    assert_eq!((contact, detector.threshold()), (Ok(None), MARGIN));
}
