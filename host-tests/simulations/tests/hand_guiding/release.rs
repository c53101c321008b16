//! A released arm: it comes to rest and remains where it is.

use crate::hand_guiding::cell::{Cell, Setup, config};
use crate::hand_guiding::plant::{Hand, Inertias};
use crate::hand_guiding::{ERROR, GRAVITY_ERRORS, POSTURES, SHARE, WAYS, setup};

/// Errors that differ from body to body, and errors of one sign.
const OFF: [[Inertias; 2]; 2] = [
    [Inertias::Alternating(0.03), Inertias::Alternating(-0.03)],
    [Inertias::All(0.03), Inertias::All(-0.03)],
];

/// The motion of the tip after the release, m.
#[derive(Clone, Copy, Debug, Default)]
struct Drift {
    /// Its way in the first two seconds.
    stop: f64,
    /// The greatest distance from there in the ten seconds after these.
    drift: f64,
    /// The greatest distance in the last of these seconds from the place at its beginning.
    wave: f64,
}

/// The worst of all postures, errors of the inertias and directions, released at rest or at this
/// speed in m/s.
fn worst(off: &[Inertias], share: f64, over: f64, gravity_error: f64, speed: f64) -> Drift {
    let mut worst = Drift::default();
    for q in POSTURES {
        for &inertias in off {
            for way in &WAYS[..if speed > 0.0 { 3 } else { 1 }] {
                let setup = Setup {
                    config: config(if share > SHARE { 0.0 } else { ERROR }, share),
                    over,
                    inertias,
                    gravity_error,
                };
                let mut cell = Cell::new(q, &setup);
                if speed > 0.0 {
                    cell.hand = Hand::Lead(cell.tip(), speed * *way);
                    cell.run(600);
                    cell.hand = Hand::Away;
                }
                let stop = cell.run(2000);
                let from = cell.tip();
                let first = cell.run(9000);
                let between = (cell.tip() - from).length();
                let wave = cell.run(1000);
                worst = Drift {
                    stop: worst.stop.max(stop),
                    drift: worst.drift.max(first).max(between + wave),
                    wave: worst.wave.max(wave),
                };
            }
        }
    }
    println!("{off:?}, share {share}, over {over}, errors {gravity_error}, {speed} m/s: {worst:?}");
    worst
}

#[test]
fn a_released_arm_neither_drifts_nor_oscillates() {
    for (gravity_error, off) in GRAVITY_ERRORS.iter().zip([&OFF[0][..], OFF.as_flattened()]) {
        for speed in [0.0, 0.05] {
            let worst = worst(off, SHARE, 0.1, *gravity_error, speed);
            assert!(worst.drift <= 1e-5 && worst.wave <= 1e-6, "{worst:?}");
        }
    }
}

#[test]
fn an_understated_model_error_lets_the_arm_drift() {
    // Friction compensated in full and over-estimated, and errors of gravity that were not stated.
    assert!(worst(&OFF[1], 1.0, 0.1, 0.03, 0.05).drift > 0.1);
    assert!(worst(&OFF[1], SHARE, 0.1, 0.0, 0.05).drift > 0.1);
}

#[test]
fn without_a_rest_speed_encoder_noise_causes_creep() {
    for (rest, creeps) in [(0.002, false), (1e-6, true)] {
        let mut setup = Setup { inertias: OFF[1][1], ..setup(SHARE, 0.1) };
        setup.config.rest_speed = [rest; 6];
        let drift = Cell::new(POSTURES[3], &setup).run(10_000);
        println!("{rest} rad/s: {drift} m");
        assert_eq!(drift > 1e-3, creeps, "{rest} rad/s: {drift} m");
    }
}
