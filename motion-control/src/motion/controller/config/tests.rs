use std::string::{String, ToString};
use std::vec::Vec;

use crate::{MotionControllerConfig, SafetyLimits, SupervisorConfig};
use dynamics_core::advice::Advice;

fn kind(advice: &Advice) -> String {
    let text = std::format!("{advice:?}");
    text.split(' ').next().unwrap_or_default().to_string()
}

fn config() -> MotionControllerConfig<f32, 2> {
    MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: SafetyLimits {
                torque: [10.0; 2],
                rate: [5.0; 2],
                speed: [3.0; 2],
                lower: [-2.0; 2],
                upper: [2.0; 2],
            },
            tick: 1e-3,
            resolution: core::f32::consts::TAU / 16_384.0,
            ride_through_ticks: 5,
            hold_ticks: 100,
            reentry_ticks: 200,
        },
        observer_bandwidth: 250.0,
        decay_rate: 25.0,
        restart_distance: 0.15,
    }
}

#[test]
fn a_configuration_in_other_units_gets_this_advice_alone() {
    let of = |change: fn(&mut MotionControllerConfig<f32, 2>)| {
        let mut config = config();
        change(&mut config);
        assert_eq!(config.check(), Ok(()), "advice is not a refusal");
        config
            .advice()
            .map(|advice| kind(&advice))
            .collect::<Vec<_>>()
    };
    let none: [&str; 0] = [];
    assert_eq!(of(|_| ()), none);
    assert_eq!(of(|c| c.restart_distance = f32::INFINITY), none);
    assert_eq!(of(|c| c.restart_distance = 15.0), ["FarRestart"]);
    assert_eq!(of(|c| c.supervisor.limits.rate[1] = 0.0), ["ZeroRate"]);
    // A second is far beyond every frequency, and an observer of 250 rad/s multiplies each step of
    // the encoder.
    let long = of(|c| c.supervisor.tick = 1.0);
    let all = [
        "LongTick",
        "BeyondNyquist",
        "BeyondNyquist",
        "CoarseEncoder",
        "CoarseEncoder",
    ];
    assert_eq!(long, all);
    assert_eq!(
        of(|c| {
            c.supervisor.limits.lower = [-115.0; 2];
            c.supervisor.limits.upper = [115.0; 2];
        }),
        ["PositionsInDegrees"]
    );
    assert_eq!(
        of(|c| c.supervisor.limits.speed = [172.0; 2]),
        ["SpeedsInDegrees"]
    );
    assert_eq!(of(|c| c.supervisor.limits.speed = [f32::INFINITY; 2]), none);
    assert_eq!(of(|c| c.decay_rate = 250.0), ["BeyondObserver"]);
    assert_eq!(of(|c| c.observer_bandwidth = 4000.0)[0], "BeyondNyquist");
    // 14 bits in degrees.
    let coarse = of(|c| c.supervisor.resolution = 360.0 / 16_384.0);
    assert_eq!(coarse, ["CoarseEncoder"; 2]);
}

#[test]
fn the_farther_end_of_a_range_is_the_one_in_degrees() {
    for (lower, upper, limit) in [(-115.0, 90.0, -115.0), (-90.0, 115.0, 115.0)] {
        let mut config = config();
        config.supervisor.limits.lower = [lower; 2];
        config.supervisor.limits.upper = [upper; 2];
        let first = config.advice().next();
        let Some(Advice::PositionsInDegrees { limit: found, .. }) = first else {
            panic!("no such advice: {first:?}");
        };
        assert_eq!(found, limit);
    }
}

#[test]
fn the_advice_on_a_configuration_says_number_reason_and_remedy() {
    let mut wrong = config();
    wrong.supervisor.tick = 1.0;
    wrong.restart_distance = 15.0;
    wrong.supervisor.limits.rate[1] = 0.0;
    let words: Vec<String> = wrong
        .advice()
        .map(|advice| advice.named(&["shoulder", "elbow"]).to_string())
        .collect();
    assert_eq!(
        words[..2],
        [
            "a tick of 1 s means 1 ticks a second, where control loops have 50 to 10000: the tick \
             is in s, 1 ms is 0.001",
            "a restart distance of 15 rad or m allows a start 859° from the trajectory: it is in \
             rad, and looks like degrees; 0.15 is usual",
        ]
    );
    assert!(
        words
            .iter()
            .any(|text| text.starts_with("joint 1 (`elbow`): a rate of zero")),
        "{words:?}"
    );
    let feedback = config().advice_on_feedback(5000.0, 300.0);
    let kinds: Vec<String> = feedback.map(|advice| kind(&advice)).collect();
    assert_eq!(kinds, ["BeyondNyquist", "BeyondObserver", "BeyondDrive"]);
    assert_eq!(
        config().advice_on_feedback(25.0, f32::INFINITY).next(),
        None
    );
}

/// In f64, whose numbers are at the thresholds exactly.
#[test]
fn a_number_at_its_threshold_gets_no_advice() {
    let kinds = |change: fn(&mut MotionControllerConfig<f64, 1>)| {
        let mut config = MotionControllerConfig {
            supervisor: SupervisorConfig {
                limits: SafetyLimits {
                    torque: [10.0],
                    rate: [5.0],
                    speed: [3.0],
                    lower: [-2.0],
                    upper: [2.0],
                },
                tick: 1e-3,
                resolution: 0.0,
                ride_through_ticks: 5,
                hold_ticks: 100,
                reentry_ticks: 200,
            },
            observer_bandwidth: 50.0,
            decay_rate: 25.0,
            restart_distance: 0.15,
        };
        change(&mut config);
        config.advice().map(|one| kind(&one)).collect::<Vec<_>>()
    };
    let none: [&str; 0] = [];
    assert_eq!(kinds(|c| c.supervisor.tick = 0.05), none);
    assert_eq!(kinds(|c| c.restart_distance = 1.0), none);
    // A joint without a torque has no rate; one with little has.
    assert_eq!(
        kinds(|c| (c.supervisor.limits.rate, c.supervisor.limits.torque) = ([0.0], [0.0])),
        none
    );
    assert_eq!(
        kinds(|c| (c.supervisor.limits.rate, c.supervisor.limits.torque) = ([0.0], [0.5])),
        ["ZeroRate"]
    );
    // A step of 0.2 rad/s of 1 rad/s, and the highest frequency that a tick can have.
    let second = |c: &mut MotionControllerConfig<f64, 1>| {
        c.supervisor.tick = 1.0;
        c.supervisor.resolution = 0.2;
        c.supervisor.limits.speed = [1.0];
        (c.observer_bandwidth, c.decay_rate) = (1.0, 0.5);
    };
    assert_eq!(kinds(second), ["LongTick"]);
    let nyquist = |c: &mut MotionControllerConfig<f64, 1>| {
        c.supervisor.tick = 1.0;
        c.observer_bandwidth = core::f64::consts::PI;
        c.decay_rate = 1.0;
    };
    assert_eq!(kinds(nyquist), ["LongTick"]);
}

#[test]
fn a_drive_as_fast_as_the_feedback_is_too_slow() {
    let advice = config().advice_on_feedback(25.0, 25.0);
    let kinds: Vec<String> = advice.map(|advice| kind(&advice)).collect();
    assert_eq!(kinds, ["BeyondDrive"]);
}

#[test]
fn a_restart_distance_of_zero_is_a_configuration() {
    let config = MotionControllerConfig {
        restart_distance: 0.0,
        ..config()
    };
    assert_eq!(config.check(), Ok(()));
}
