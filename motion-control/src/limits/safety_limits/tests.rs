use super::*;
use crate::limits::{ConfigError, Fault, Mode};
use crate::safety::SupervisorConfig;
use crate::safety::supervisor::Supervisor;

const GOOD: SafetyLimits<f32, 2> = SafetyLimits {
    torque: [10.0, 0.0],
    rate: [4.0, f32::INFINITY],
    speed: [2.0, f32::INFINITY],
    lower: [-1.0, f32::NEG_INFINITY],
    upper: [1.0, f32::INFINITY],
};

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
    SupervisorConfig {
        limits,
        tick: 0.01,
        resolution: 0.0,
        ride_through_ticks: 0,
        hold_ticks: 3,
        reentry_ticks: 4,
    }
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
    let (lower, upper) = (-0.5, -1.0);
    assert_eq!(
        limits.check(),
        Err(SafetyLimitsError::Empty {
            joint,
            lower,
            upper
        })
    );
    limits.lower[1] = -1.0;
    assert_eq!(limits.check(), Ok(()));
}

#[test]
fn the_text_of_a_limit_has_joint_limit_and_value() {
    let text = |of, limit| {
        let error = config(with(of, limit))
            .check()
            .expect_err("it allows nothing");
        std::format!("{error}")
    };
    let cases = [
        (
            LimitKind::Torque,
            -35.5,
            "joint 1: its torque limit, -35.5, is negative",
        ),
        (
            LimitKind::Torque,
            f32::INFINITY,
            "joint 1: its torque limit is infinite and has to be finite",
        ),
        (
            LimitKind::Rate,
            f32::NAN,
            "joint 1: its torque rate limit is not a number",
        ),
        (
            LimitKind::Speed,
            -2.0,
            "joint 1: its speed limit, -2, is negative",
        ),
        (
            LimitKind::LeastPosition,
            f32::NAN,
            "joint 1: its least position is not a number",
        ),
    ];
    for (of, limit, expected) in cases {
        assert_eq!(text(of, limit), expected);
    }
    let mut limits = GOOD;
    (limits.lower[0], limits.upper[0]) = (2.0, 1.5);
    let error = limits.check().expect_err("an empty range");
    assert_eq!(
        std::format!("{}", error.named(&["shoulder"])),
        "joint `shoulder`: its least position, 2, is above its greatest, 1.5"
    );
    assert_eq!(
        std::format!("{}", error.named(&[])),
        "joint 0: its least position, 2, is above its greatest, 1.5"
    );
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
    let joint = JointLimits {
        lower: -1.0,
        upper: 2.0,
        velocity: 3.0,
        torque: 4.0_f32,
    };
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
    let (joint, lower, upper) = (0, 0.125, -0.125);
    assert_eq!(
        more,
        Err(SafetyLimitsError::Empty {
            joint,
            lower,
            upper
        })
    );
}
