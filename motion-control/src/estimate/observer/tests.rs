use super::*;

mod steps;

const H: f64 = 1e-3;

fn observer(bandwidth: f64) -> Observer<f64, 1> {
    Observer::new(ObserverConfig { bandwidth, tick: H })
}

fn single(bandwidth: f32, tick: f32) -> Observer<f32, 1> {
    Observer::new(ObserverConfig { bandwidth, tick })
}

#[test]
fn an_initial_error_decays_as_two_equal_poles_do() {
    let bandwidth = 150.0;
    let mut observer = observer(bandwidth);
    observer.reset(&[1.0]);
    let beta = (-bandwidth * H).exp();
    // Both poles at β: e_{n+2} = 2β e_{n+1} − β² e_n.
    let errors: Vec<f64> = (0..40).map(|_| observer.update(&[0.0], &[0.0]).q[0]).collect();
    for e in errors.windows(3) {
        let expected = 2.0 * beta * e[1] - beta * beta * e[0];
        assert!((e[2] - expected).abs() < 1e-6, "{} {expected}", e[2]);
    }
    assert!(errors[39].abs() < 0.1 * errors[0].abs());
}

#[test]
fn encoder_steps_leave_little_ripple() {
    let mut observer = single(250.0, 1e-3);
    let count = core::f32::consts::TAU / 16_384.0;
    for tick in 0..2000_i32 {
        let q = (1.5e-3 * tick as f32 / count).round() * count;
        let qd = observer.update(&[q], &[0.0]).qd[0];
        assert!(tick < 200 || (qd - 1.5).abs() < 0.03, "{tick}: {qd}");
    }
}

#[test]
fn useless_parameters_give_finite_estimates() {
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38] {
        for (bandwidth, tick) in [(bad, 1e-3), (200.0, bad), (bad, bad)] {
            let config = ObserverConfig { bandwidth, tick };
            // Large numbers are clamped, not refused.
            assert_eq!(config.check().is_ok(), bad == 1e38);
            let mut observer = single(bandwidth, tick);
            for q in [1.0, 1.1, 1.2, 1.1] {
                let estimate = observer.update(&[q], &[0.5]);
                assert!(estimate.q[0].is_finite() && estimate.qd[0].is_finite());
            }
        }
    }
}

#[test]
fn before_the_first_position_nothing_moves() {
    let mut observer = single(200.0, 1e-3);
    assert_eq!(observer.predict(&[3.0]).qd, [0.0]);
    assert_eq!(observer.update(&[f32::NAN], &[3.0]).q, [0.0]);
    let first = observer.update(&[2.5], &[3.0]);
    assert_eq!((first.q, first.qd), ([2.5], [0.0]));
}

#[test]
fn the_gap_of_a_tick_is_its_series() {
    let x = 1.0_f64;
    let growth = x + 1.0 / 2.0 + 1.0 / 6.0 + 1.0 / 24.0 + 1.0 / 120.0;
    assert!((one_less_decay(x) - growth / (1.0 + growth)).abs() < 1e-15);
    assert_eq!(one_less_decay(17.0), one_less_decay(16.0));
    assert!(one_less_decay(15.9) < one_less_decay(16.0));
}

#[test]
fn useless_parameters_leave_no_gain_and_no_tick() {
    let still = single(f32::NAN, f32::NAN);
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(single(200.0, bad), still, "tick {bad}");
    }
    for bad in [0.0, -1.0, f32::NAN] {
        assert_eq!(single(bad, 1e-3), still, "bandwidth {bad}");
    }
}

#[test]
fn a_late_first_position_is_no_motion() {
    let mut observer = observer(250.0);
    let first = *observer.update_delayed(&[2.5], &[3.0]);
    assert_eq!((first.q, first.qd), ([2.5], [0.0]));
}

#[test]
fn what_is_not_finite_changes_no_estimate() {
    let (bandwidth, tick) = (200.0_f32, 1e-3);
    let mut observer = Observer::<f32, 2>::new(ObserverConfig { bandwidth, tick });
    observer.reset(&[0.5, 1.0]);
    let before = observer;
    // The last position is near the end of the range: its velocity alone is infinite.
    for bad in [f32::NAN, f32::INFINITY, f32::MAX] {
        for q in [[bad, 1.0], [0.5, bad]] {
            observer.update(&q, &[0.0; 2]);
            observer.update_delayed(&q, &[0.0; 2]);
            observer.follow(&q);
            if !bad.is_finite() {
                observer.reset(&q);
                observer.correct_position(&q);
                observer.correct_position_delayed(&q);
            }
            assert_eq!(observer, before, "{q:?}");
        }
    }
}
