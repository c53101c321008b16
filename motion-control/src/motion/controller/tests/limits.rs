//! Limits that change while the arm moves.

use super::*;

const FAST: SafetyLimits<f64, 1> = CONFIG.supervisor.limits;
/// Half of the speed of the motion.
const SLOW: SafetyLimits<f64, 1> = SafetyLimits { speed: [0.5 * SPEED], ..FAST };

type Controller = MotionController<f64, 1, CurrentTick>;

/// A joint that decelerates at this rate, rad/s², from its speed to that of the limits: the fault,
/// and the speed at which it comes.
fn slows(deceleration: f64, fall: f64) -> (Option<Fault>, f64) {
    let mut controller: Controller = following(400, 0);
    let (mut q, mut qd) = (CRUISE.at(399).q[0], SPEED);
    for _ in 0..4000 {
        controller.set_limits(&SLOW, fall).expect("good ones");
        qd = (qd - TICK * deceleration).max(0.4 * SPEED);
        q += TICK * qd;
        let command = controller.tick(Ok(&[q]), &CRUISE, |_, _| [0.0]);
        if let Some(fault) = command.status.fault {
            return (Some(fault), qd);
        }
    }
    (None, qd)
}

#[test]
fn a_limit_of_speed_falls_along_its_ramp() {
    // From 3 to 0.25 rad/s: the joint has the whole ramp for its way from 0.5 rad/s.
    assert_eq!(slows(1.0, 1.0), (None, 0.4 * SPEED));
    assert_eq!(slows(0.1, 0.5), (None, 0.4 * SPEED));
    let speed = Some(Fault::Speed { joint: 0 });
    // One that does not slow down, and a ramp of one tick.
    let (fault, at) = slows(0.0, 1.0);
    assert_eq!((fault, at), (speed, SPEED));
    assert_eq!(slows(1.0, f64::INFINITY).0, speed);
    let mut controller: Controller = following(400, 0);
    let mut fall = || controller.set_limits(&SLOW, 10.0);
    let ticks = (1..).find(|_| fall() == Ok(true));
    assert!(ticks.is_some_and(|ticks| (275..=276).contains(&ticks)), "{ticks:?}");
    // They rise at once.
    assert_eq!(controller.set_limits(&FAST, 10.0), Ok(true));
    assert_eq!(controller.supervisor.bounds(), [[-2.0, 2.0]]);
}

#[test]
fn an_infinite_limit_of_speed_falls_from_twice_the_speed() {
    let mut controller: Controller = following(400, 0);
    let endless = SafetyLimits { speed: [f64::INFINITY], ..FAST };
    assert_eq!(controller.set_limits(&endless, 1.0), Ok(true));
    let ticks = (1..).find(|_| controller.set_limits(&SLOW, 1.0) == Ok(true));
    assert!(ticks.is_some_and(|ticks| (750..=752).contains(&ticks)), "{ticks:?}");
}

#[test]
fn a_torque_falls_to_a_new_limit_at_its_rate() {
    let mut controller: Controller = following(400, 0);
    let weak = SafetyLimits { torque: [2.0], rate: [0.5], ..FAST };
    let tick = |controller: &mut Controller, k| {
        controller.tick(Ok(&CRUISE.at(k).q), &CRUISE, |_, _| [8.0]).torque[0]
    };
    assert_eq!(tick(&mut controller, 400), 8.0);
    controller.set_limits(&weak, 1.0).expect("good ones");
    for k in 1..=20 {
        let torque = tick(&mut controller, 400 + k);
        assert_eq!(torque, f64::max(8.0 - 0.5 * f64::from(k), 2.0));
    }
    // A limit above that of the configuration does not lift it.
    let strong = SafetyLimits { torque: [7.0 + FAST.torque[0]], ..FAST };
    assert_eq!(controller.set_limits(&strong, 1.0), Ok(true));
    assert_eq!(controller.supervisor.torque_limit(), &FAST.torque);
}

#[test]
fn limits_that_are_wrong_change_nothing() {
    let mut controller: Controller = following(400, 0);
    let before = controller;
    let position = CRUISE.at(399).q[0];
    let wrong = [
        SafetyLimits { torque: [f64::INFINITY], speed: [1.0], ..FAST },
        SafetyLimits { speed: [f64::NAN], lower: [-1.0], ..FAST },
        SafetyLimits { rate: [-1.0], speed: [1.0], ..FAST },
        SafetyLimits { lower: [1.0], upper: [0.5], ..FAST },
        SafetyLimits { upper: [position - 1e-6], speed: [1.0], ..FAST },
        SafetyLimits { lower: [position + 1e-6], ..FAST },
    ];
    for limits in wrong {
        let error = controller.set_limits(&limits, 1.0);
        assert!(matches!(error, Err(ConfigError::Limits(_))), "{error:?}");
    }
    let parameter = ConfigParameter::Deceleration;
    for fall in [0.0, -1.0, f64::NAN] {
        let error = controller.set_limits(&SLOW, fall);
        assert_eq!(error, Err(ConfigError::OutOfRange { parameter }));
    }
    assert_eq!(controller, before);
    // At the bound the joint is within it, and before the first measurement anywhere.
    let tight = SafetyLimits { lower: [position], upper: [position], ..FAST };
    assert!(controller.set_limits(&tight, 1.0).is_ok());
    let away = SafetyLimits { lower: [1.0], ..FAST };
    assert!(self::controller::<CurrentTick>().set_limits(&away, 1.0).is_ok());
}

#[test]
fn the_range_of_a_circle_may_be_in_another_turn() {
    use core::f64::consts::TAU;
    type Wheel = MotionController<f64, 1, OnCircles<1, CurrentTick>>;
    let mut config = CONFIG;
    (config.supervisor.limits.lower, config.supervisor.limits.upper) = ([-3.0], [3.0]);
    let mut wheel = Wheel::try_new(config).expect("an arc");
    wheel.tick(Ok(&[-2.9]), &State::at([-2.9]), |_, _| [0.0]);
    let turned = SafetyLimits { lower: [3.2], upper: [4.0], ..FAST };
    assert!(wheel.set_limits(&turned, 1.0).is_ok());
    let command = wheel.tick(Ok(&[-2.9]), &State::at([-2.9]), |_, _| [0.0]);
    assert_eq!(command.status.fault, None);
    let error = wheel.set_limits(&SafetyLimits { lower: [3.5], ..turned }, 1.0).unwrap_err();
    let position = TAU - 2.9;
    assert!(
        matches!(error, ConfigError::Limits(SafetyLimitsError::Outside { joint: 0, position: at }) if (at - position).abs() < 1e-9)
    );
    let counted = SafetyLimits { lower: [-4.0], upper: [4.0], ..FAST };
    assert!(wheel.set_limits(&counted, 1.0).is_err());
}
