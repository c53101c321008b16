use crate::tests::{controlled, safety_limits};
use std::string::{String, ToString};
use std::vec::Vec;

use crate::motion::MotionControllerConfig;
use dynamics_core::advice::Advice;
use dynamics_core::scalar::Real;

fn kind(advice: &Advice) -> String {
    let text = std::format!("{advice:?}");
    text.split(' ').next().unwrap_or_default().to_string()
}

fn config() -> MotionControllerConfig<f32, 2> {
    let limits = safety_limits([10.0; 2], [5.0; 2], [3.0; 2], [-2.0; 2], [2.0; 2]);
    let mut config = controlled(limits, 1e-3, [5, 100, 200], [250.0, 25.0, 0.15]);
    config.supervisor.resolution = core::f32::consts::TAU / 16_384.0;
    config
}

fn kinds<const V: usize, R: Real>(config: &MotionControllerConfig<R, V>) -> Vec<String> {
    config.advice().map(|advice| kind(&advice)).collect()
}

#[test]
fn a_configuration_in_other_units_gets_this_advice_alone() {
    let of = |change: fn(&mut MotionControllerConfig<f32, 2>)| {
        let mut config = config();
        change(&mut config);
        assert_eq!(config.check(), Ok(()), "advice is not a refusal");
        kinds(&config)
    };
    let none: [&str; 0] = [];
    assert_eq!(of(|_| ()), none);
    assert_eq!(of(|c| c.restart_distance = f32::INFINITY), none);
    assert_eq!(of(|c| c.restart_distance = 15.0), ["FarRestart"]);
    assert_eq!(of(|c| c.supervisor.limits.rate[1] = 0.0), ["ZeroRate"]);
    // A second is far beyond every frequency, and an observer of 250 rad/s multiplies each step of
    // the encoder.
    let long = of(|c| c.supervisor.tick = 1.0);
    let twice = [["BeyondNyquist"; 2], ["CoarseEncoder"; 2]].concat();
    assert_eq!(long, [vec!["LongTick"], twice].concat());
    let fast = of(|c| c.supervisor.limits.speed = [172.0; 2]);
    assert_eq!(fast, ["SpeedsInDegrees"]);
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
        assert_eq!(kinds(&config), ["PositionsInDegrees"]);
        let first = config.advice().next();
        let Some(Advice::PositionsInDegrees { limit: found, .. }) = first else {
            panic!("no such advice: {first:?}");
        };
        assert_eq!(found, limit);
    }
}

#[test]
fn advice_names_its_number_and_its_joint() {
    let mut wrong = config();
    wrong.supervisor.tick = 1.0;
    wrong.supervisor.limits.rate[1] = 0.0;
    let advice = wrong.advice();
    let words = advice.map(|advice| advice.named(&["shoulder", "elbow"]).to_string());
    let words: Vec<String> = words.collect();
    let tick = "a tick of 1 s means 1 ticks a second";
    assert!(words[0].starts_with(tick), "{words:?}");
    let rate = "joint 1 (`elbow`): a rate of zero";
    assert!(words.iter().any(|text| text.starts_with(rate)), "{words:?}");
    let feedback = config().advice_on_feedback(5000.0, 300.0);
    let kinds: Vec<String> = feedback.map(|advice| kind(&advice)).collect();
    assert_eq!(kinds, ["BeyondNyquist", "BeyondObserver", "BeyondDrive"]);
    let none = config().advice_on_feedback(25.0, f32::INFINITY).next();
    assert_eq!(none, None);
    // A drive that is as fast as the feedback is too slow.
    let slow = config().advice_on_feedback(25.0, 25.0);
    let kinds: Vec<String> = slow.map(|advice| kind(&advice)).collect();
    assert_eq!(kinds, ["BeyondDrive"]);
}

/// In f64, whose numbers are at the thresholds exactly.
#[test]
fn a_number_at_its_threshold_gets_no_advice() {
    let kinds = |change: fn(&mut MotionControllerConfig<f64, 1>)| {
        let limits = safety_limits([10.0], [5.0], [3.0], [-2.0], [2.0]);
        let mut config = controlled(limits, 1e-3, [5, 100, 200], [50.0, 25.0, 0.15]);
        change(&mut config);
        self::kinds(&config)
    };
    let none: [&str; 0] = [];
    assert_eq!(kinds(|c| c.supervisor.tick = 0.05), none);
    assert_eq!(kinds(|c| c.restart_distance = 1.0), none);
    // A joint without a torque has no rate; one with little has.
    let weak = kinds(|c| (c.supervisor.limits.rate, c.supervisor.limits.torque) = ([0.0], [0.0]));
    assert_eq!(weak, none);
    let little = kinds(|c| (c.supervisor.limits.rate, c.supervisor.limits.torque) = ([0.0], [0.5]));
    assert_eq!(little, ["ZeroRate"]);
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
fn a_restart_distance_of_zero_is_a_configuration() {
    let mut config = config();
    config.restart_distance = 0.0;
    assert_eq!(config.check(), Ok(()));
}
