//! Single ticks of the observer, in closed form.

use super::*;

const H: f64 = 0.5;
const CONFIG: ObserverConfig<f64> = ObserverConfig { bandwidth: 1.0, tick: H };

fn observer<const ORDER: usize>() -> MomentumObserver<f64, 2, ORDER> {
    MomentumObserver::try_new(CONFIG).expect("a good configuration")
}

#[track_caller]
fn near(got: &[f64; 2], expected: [f64; 2]) {
    let gap = |i: usize| (got[i] - expected[i]).abs();
    assert!(gap(0).max(gap(1)) < 1e-12, "{got:?} {expected:?}");
}

#[test]
fn a_useless_configuration_is_refused() {
    for tick in [0.0, f64::NAN] {
        let config = ObserverConfig { tick, ..CONFIG };
        let parameter = crate::limits::ConfigParameter::Tick;
        let refused = MomentumObserver::<f64, 2>::try_new(config);
        assert_eq!(refused, Err(ConfigError::OutOfRange { parameter }));
    }
}

#[test]
fn a_tick_has_the_mean_of_the_drift() {
    let mut observer = observer::<1>();
    let gap = observer.gap;
    observer.update(&[1.0, 0.0], &[1.0, -2.0]).expect("finite");
    observer.drive(&[4.0, 0.0]);
    observer.update(&[1.5, 0.0], &[5.0, 4.0]).expect("finite");
    // Δp/h − τ − ½ (β + β⁻).
    let first = [1.0 - 4.0 - 3.0, -1.0].map(|mean| gap * mean);
    near(observer.external_torque(), first);
    // The drift before is that of the measurement before.
    observer.drive(&[0.0; 2]);
    observer.update(&[1.5, 0.0], &[5.0, 4.0]).expect("finite");
    let second = [0, 1].map(|i| first[i] + gap * (-[5.0, 4.0][i] - first[i]));
    near(observer.external_torque(), second);
}

#[test]
fn the_second_filter_follows_the_first() {
    let mut observer = observer::<2>();
    let gap = observer.gap;
    observer.update(&[0.0; 2], &[0.0; 2]).expect("finite");
    observer.drive(&[-1.0, 2.0]);
    observer.update(&[0.0; 2], &[0.0; 2]).expect("finite");
    near(observer.external_torque(), [gap * gap, -2.0 * gap * gap]);
}

#[test]
fn lost_measurements_leave_the_mean_of_all_ticks() {
    let mut observer = observer::<1>();
    let decay = 1.0 - observer.gap;
    observer.update(&[0.0; 2], &[0.0; 2]).expect("finite");
    for _ in 0..3 {
        observer.drive(&[0.0; 2]);
    }
    observer.update(&[3.0, -6.0], &[0.0; 2]).expect("finite");
    let share = 1.0 - decay * decay * decay;
    near(observer.external_torque(), [2.0 * share, -4.0 * share]);
    // Without a tick in between there is no mean.
    observer.update(&[9.0, 9.0], &[0.0; 2]).expect("finite");
    near(observer.external_torque(), [2.0 * share, -4.0 * share]);
}

#[test]
fn before_the_first_measurement_there_is_no_torque() {
    let mut observer = observer::<1>();
    observer.drive(&[3.0; 2]);
    observer.update(&[5.0; 2], &[0.0; 2]).expect("finite");
    assert_eq!(observer.external_torque(), &[0.0; 2]);
}

#[test]
fn a_measurement_that_is_not_finite_is_lost() {
    let mut observer = observer::<1>();
    observer.update(&[1.0; 2], &[1.0; 2]).expect("finite");
    observer.drive(&[1.0; 2]);
    let before = observer;
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (p, beta) in [([0.0, bad], [0.0; 2]), ([0.0; 2], [0.0, bad])] {
            let fault = Err(Fault::NotFinite { joint: 1 });
            assert_eq!(observer.update(&p, &beta), fault);
            assert_eq!(observer, before);
        }
    }
    // The sum of finite numbers may be too large.
    assert_eq!(observer.update(&[f64::MAX; 2], &[0.0; 2]), Ok(()));
}

#[test]
fn a_torque_at_its_threshold_is_no_contact() {
    let mut observer = observer::<1>();
    observer.update(&[0.0; 2], &[0.0; 2]).expect("finite");
    observer.drive(&[1.0, 2.0]);
    observer.update(&[0.0; 2], &[0.0; 2]).expect("finite");
    let threshold = observer.external_torque().map(f64::abs);
    assert_eq!(observer.outermost(&threshold), None);
    assert_eq!(observer.outermost(&threshold.map(|x| 0.9 * x)), Some(1));
    assert_eq!(observer.outermost(&[0.0, 9.0]), Some(0));
}

#[test]
fn a_torque_that_is_not_finite_counts_as_none() {
    for (tau, driven) in [
        ([f64::NAN, 2.0], [0.0, 2.0 * H]),
        ([2.0, f64::INFINITY], [2.0 * H, 0.0]),
        ([f64::MAX, f64::MAX], [f64::MAX * H; 2]),
    ] {
        let mut observer = observer::<1>();
        observer.drive(&tau);
        assert_eq!(observer.driven, driven);
    }
}

#[test]
fn a_restart_leaves_an_observer_without_a_measurement() {
    let mut observer = observer::<1>();
    observer.update(&[1.0; 2], &[1.0; 2]).expect("finite");
    observer.drive(&[1.0; 2]);
    observer.update(&[3.0; 2], &[1.0; 2]).expect("finite");
    assert!(observer.external_torque()[0] > 0.1);
    observer.drive(&[1.0; 2]);
    observer.restart();
    let new = self::observer::<1>();
    // The first measurement replaces this.
    (observer.driven, observer.beta) = (new.driven, new.beta);
    assert_eq!(observer, new);
}
