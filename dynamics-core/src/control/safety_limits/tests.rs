use super::*;
use crate::control::{ConfigError, Fault, Mode, Supervisor, SupervisorConfig};

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
        LimitKind::Position => &mut limits.upper,
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
        let negative = SafetyLimitsError::Negative { joint, of };
        assert_eq!(with(of, -1.0).check(), Err(negative));
        assert_eq!(with(of, f32::NEG_INFINITY).check(), Err(negative));
        let none = SafetyLimitsError::NotFinite { joint, of };
        assert_eq!(with(of, f32::NAN).check(), Err(none));
    }
    let of = LimitKind::Torque;
    let endless = SafetyLimitsError::NotFinite { joint, of };
    assert_eq!(with(of, f32::INFINITY).check(), Err(endless));
    let of = LimitKind::Position;
    let none = SafetyLimitsError::NotFinite { joint, of };
    assert_eq!(with(of, f32::NAN).check(), Err(none));
    let mut limits = with(of, -1.0);
    limits.lower[1] = f32::NAN;
    assert_eq!(limits.check(), Err(none));
    limits.lower[1] = -0.5;
    assert_eq!(limits.check(), Err(SafetyLimitsError::Empty { joint }));
    limits.lower[1] = -1.0;
    assert_eq!(limits.check(), Ok(()));
}

#[test]
fn an_arm_with_such_limits_is_stopped_and_says_why_instead_of_going_limp() {
    for of in [
        LimitKind::Torque,
        LimitKind::Rate,
        LimitKind::Speed,
        LimitKind::Position,
    ] {
        let limits = with(of, f32::NAN);
        let Err(ConfigError::Limits(error)) = Supervisor::try_new(config(limits)) else {
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
    let mut supervisor = Supervisor::try_new(config(GOOD)).expect("limits that allow something");
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
    let limits = limits.with_speed_share(0.5).with_rate_share(0.25);
    assert_eq!((limits.speed, limits.rate), ([1.5; 2], [1.0; 2]));
    let motion = MotionLimits::from(joint);
    assert_eq!((motion.velocity, motion.acceleration), (3.0, f32::INFINITY));
}
