use super::*;
use crate::limits::{ConfigError, Fault, Mode};
use crate::safety::SupervisorConfig;
use crate::safety::supervisor::Supervisor;
use crate::tests::{safety_limits, supervised};

const GOOD: SafetyLimits<f32, 2> = safety_limits(
    [10.0, 0.0],
    [4.0, f32::INFINITY],
    [2.0, f32::INFINITY],
    [-1.0, f32::NEG_INFINITY],
    [1.0, f32::INFINITY],
);

fn with(of: LimitKind, limit: f32) -> SafetyLimits<f32, 2> {
    let mut limits = GOOD;
    let joints = match of {
        LimitKind::Torque => &mut limits.torque,
        LimitKind::Rate => &mut limits.rate,
        LimitKind::Speed => &mut limits.speed,
        LimitKind::LeastPosition => &mut limits.lower,
        LimitKind::GreatestPosition => &mut limits.upper,
        LimitKind::Acceleration => panic!("no such limit"),
    };
    joints[1] = limit;
    limits
}

fn config(limits: SafetyLimits<f32, 2>) -> SupervisorConfig<f32, 2> {
    supervised(limits, 0.01, [0, 3, 4])
}

fn empty(joint: usize, lower: f64, upper: f64) -> SafetyLimitsError {
    SafetyLimitsError::Empty { joint, lower, upper }
}

#[test]
fn limits_that_allow_nothing_are_refused_by_joint_and_name() {
    assert_eq!(GOOD.check(), Ok(()));
    let joint = 1;
    for of in [LimitKind::Torque, LimitKind::Rate, LimitKind::Speed] {
        for value in [-1.0, f64::NEG_INFINITY] {
            let negative = SafetyLimitsError::Negative { joint, of, value };
            assert_eq!(with(of, value as f32).check(), Err(negative));
        }
        let none = SafetyLimitsError::NotANumber { joint, of };
        assert_eq!(with(of, f32::NAN).check(), Err(none));
    }
    let of = LimitKind::Torque;
    let endless = SafetyLimitsError::Infinite { joint, of };
    assert_eq!(with(of, f32::INFINITY).check(), Err(endless));
    for of in [LimitKind::LeastPosition, LimitKind::GreatestPosition] {
        let none = SafetyLimitsError::NotANumber { joint, of };
        assert_eq!(with(of, f32::NAN).check(), Err(none));
    }
    let mut limits = with(LimitKind::GreatestPosition, -1.0);
    limits.lower[1] = -0.5;
    assert_eq!(limits.check(), Err(empty(joint, -0.5, -1.0)));
    limits.lower[1] = -1.0;
    assert_eq!(limits.check(), Ok(()));
}

#[test]
fn the_text_of_a_limit_has_joint_limit_and_value() {
    let text = |of, limit| {
        let error = config(with(of, limit)).check().expect_err("it allows nothing");
        std::format!("{error}")
    };
    use LimitKind::{LeastPosition, Rate, Speed, Torque};
    for (of, limit, expected) in [
        (Torque, -35.5, "torque limit, -35.5, is negative"),
        (Torque, f32::INFINITY, "torque limit is infinite and has to be finite"),
        (Rate, f32::NAN, "torque rate limit is not a number"),
        (Speed, -2.0, "speed limit, -2, is negative"),
        (LeastPosition, f32::NAN, "least position is not a number"),
    ] {
        assert_eq!(text(of, limit), std::format!("joint 1: its {expected}"));
    }
    let mut limits = GOOD;
    (limits.lower[0], limits.upper[0]) = (2.0, 1.5);
    let error = limits.check().expect_err("an empty range");
    let range = "its least position, 2, is above its greatest, 1.5";
    for (names, joint) in [(&["shoulder"][..], "`shoulder`"), (&[], "0")] {
        let text = std::format!("{}", error.named(names));
        assert_eq!(text, std::format!("joint {joint}: {range}"));
    }
}

#[test]
fn an_arm_with_invalid_limits_stops_and_says_why() {
    for of in [
        LimitKind::Torque,
        LimitKind::Rate,
        LimitKind::Speed,
        LimitKind::LeastPosition,
        LimitKind::GreatestPosition,
    ] {
        let limits = with(of, f32::NAN);
        let Err(ConfigError::Limits(error)) = config(limits).check() else {
            panic!("such a limit allows nothing");
        };
        assert_eq!(error.joint(), 1);
        let mut supervisor = Supervisor::new(config(limits));
        for _ in 0..3 {
            assert_eq!(supervisor.accept_measurement(Ok(&[0.0; 2])), Mode::Stopped);
            let command = supervisor.gate(&[1.0, 0.0], &[0.0; 2]);
            assert_eq!((command.torque, command.brake), ([0.0; 2], true));
            assert_eq!(command.status.fault, Some(Fault::Limits { joint: 1 }));
            supervisor.reset();
        }
    }
    let mut supervisor = Supervisor::new(config(GOOD));
    assert_eq!(supervisor.accept_measurement(Ok(&[0.0; 2])), Mode::Full);
}

#[test]
fn what_a_description_does_not_limit_is_unlimited() {
    let joint = JointLimits { lower: -1.0, upper: 2.0, velocity: 3.0, torque: 4.0_f32 };
    let limits = SafetyLimits::from([joint; 2]);
    assert_eq!(limits.check(), Ok(()));
    assert_eq!((limits.rate, limits.upper), ([f32::INFINITY; 2], [2.0; 2]));
    assert_eq!((limits.lower, limits.speed), ([-1.0; 2], [3.0; 2]));
    assert_eq!(limits.torque, [4.0; 2]);
    let limits = limits.with_speed_share(0.5).with_rate_share(0.25);
    assert_eq!((limits.speed, limits.rate), ([1.5; 2], [1.0; 2]));
    let motion = MotionLimits::from(joint);
    assert_eq!((motion.velocity, motion.acceleration), (3.0, f32::INFINITY));
}

#[test]
fn a_margin_makes_a_range_smaller_at_both_ends() {
    let limits = GOOD.with_position_margin(0.25);
    assert_eq!(limits.lower, [-0.75, f32::NEG_INFINITY]);
    assert_eq!(limits.upper, [0.75, f32::INFINITY]);
    let others = |limits: SafetyLimits<f32, 2>| (limits.torque, limits.rate, limits.speed);
    assert_eq!(others(limits), others(GOOD));
    let shares = GOOD.with_rate_share(0.5).with_speed_share(0.25);
    assert_eq!((shares.torque, shares.rate), (GOOD.torque, [5.0, 0.0]));
    assert_eq!(shares.speed, [0.5, f32::INFINITY]);
    assert_eq!((shares.lower, shares.upper), (GOOD.lower, GOOD.upper));
    // The remainder of a range may be nothing.
    let all = GOOD.with_position_margin(1.0).check();
    assert_eq!(all, Ok(()));
    let more = GOOD.with_position_margin(1.125).check();
    assert_eq!(more, Err(empty(0, 0.125, -0.125)));
}
