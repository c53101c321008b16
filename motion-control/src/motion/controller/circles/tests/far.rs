//! After ten thousand turns a controller computes what it computes after none.

use super::*;
use crate::tests::{Motion, controlled, safety_limits};

const COUNTS: i64 = 16_384;

/// The angle of counts within ±π, of which the turns are dropped before anything is rounded.
fn angle(counts: i64) -> f32 {
    let within = (counts + COUNTS / 2).rem_euclid(COUNTS) - COUNTS / 2;
    within as f32 * (TAU / COUNTS as f32)
}

/// The largest error of the estimated speed, and of the tracking error, in three turns of a joint
/// that lags by `lag` counts.
fn errors(turns: i64, step: i64, lag: i64) -> [f32; 2] {
    let begin = turns * COUNTS;
    let qd = step as f32 * (TAU / COUNTS as f32) / TICK;
    // At a constant speed, the angle within a turn.
    let cruise = Motion(|tick| State {
        q: [angle(begin + step * i64::from(tick)), 0.0],
        qd: [qd, 0.0],
        qdd: [0.0; 2],
    });
    let mut controller = Controller::new(config(FREE[0], FREE[1]));
    let [mut speed, mut tracking] = [0.0_f32; 2];
    let ticks = 600 + 3 * COUNTS / step.abs();
    for tick in 0..ticks {
        let counts = begin + step * tick - lag;
        let mut off = 0.0;
        let command = controller.tick(Ok(&[angle(counts), 0.0]), &cruise, |reference, estimate| {
            off = reference.q[0] - estimate.q[0];
            [0.0; 2]
        });
        assert_eq!(command.status.fault, None, "{turns} {tick}");
        if tick >= 600 {
            speed = speed.max((controller.estimate().qd[0] / qd - 1.0).abs());
            let lag = lag as f32 * (TAU / COUNTS as f32);
            tracking = tracking.max((off / lag - 1.0).abs());
        }
    }
    [speed, tracking]
}

#[test]
fn speed_and_tracking_errors_are_the_same_after_ten_thousand_turns() {
    for step in [3, 7, -7] {
        for lag in [20, -20] {
            let none = errors(0, step, lag);
            assert_eq!(errors(10_000, step, lag), none);
            assert_eq!(errors(-10_000, step, lag), none);
            assert!(none[0] < 1e-3 && none[1] < 1e-3, "{none:?}");
        }
    }
}

#[test]
fn a_count_of_turns_in_f64_is_a_place_after_ten_thousand_of_them() {
    type Double = MotionController<f64, 1, OnCircles<1, CurrentTick>>;
    let limits = safety_limits([40.0], [40.0], [3.0], [f64::NEG_INFINITY], [f64::INFINITY]);
    let config = controlled(limits, 1e-3, [2, 100, 50], [250.0, 25.0, 0.1]);
    let mut controller = Double::try_new(config).expect("a circle");
    for tick in 0..3000 {
        let q = 62_831.0 + 2e-3 * f64::from(tick);
        let command = controller.tick(Ok(&[q]), &State::at([q + 0.01]), |reference, estimate| {
            assert!(tick < 600 || (reference.q[0] - estimate.q[0] - 0.01).abs() < 1e-8);
            [0.0]
        });
        assert_eq!(command.status.fault, None);
    }
    assert!((controller.estimate().qd[0] - 2.0).abs() < 1e-6);
}
