//! The effect of a reset on a stop.

use super::*;

type Controller = MotionController<f64, 1, CurrentTick>;

const WAY: [MotionLimits<f64>; 1] = [MotionLimits {
    velocity: 1.0,
    acceleration: 4.0,
}];
const HOLDS: StopCategory<f64, 1> = StopCategory::ControlledHold;

/// A controller whose torque changes slowly, and that has followed for 100 ticks.
fn slow(hold_ticks: u32) -> Controller {
    let mut config = CONFIG;
    config.supervisor.limits.rate = [0.5];
    config.supervisor.hold_ticks = hold_ticks;
    let mut controller = Controller::new(config);
    for k in 0..100 {
        tick(&mut controller, Cruise.at(k).q[0]);
    }
    controller
}

fn tick(controller: &mut Controller, q: f64) -> Command<f64, 1> {
    controller.tick(Ok(&[q]), &Cruise, |_, _| [4.0])
}

/// The same, stopped and at rest for many ticks.
fn stopped(category: StopCategory<f64, 1>) -> (Controller, f64) {
    let mut controller = slow(HOLD);
    controller.stop_by(Fault::External, category);
    let q = Cruise.at(100).q[0];
    for _ in 0..500 {
        tick(&mut controller, q);
    }
    (controller, q)
}

#[test]
fn a_held_arm_is_reset_under_its_torque() {
    let (mut controller, q) = stopped(HOLDS);
    assert_eq!(controller.reset(&Cruise), Ok(()));
    let command = tick(&mut controller, q);
    assert_eq!((command.torque, command.brake), ([4.0], false));
    assert_eq!(command.status.fault, None);
}

#[test]
fn a_stopped_arm_is_reset_under_its_brake() {
    let (mut controller, q) = stopped(StopCategory::TorqueOff);
    assert_eq!(controller.reset(&Cruise), Ok(()));
    for k in 1..=8 {
        let command = tick(&mut controller, q);
        assert_eq!(command.torque, [0.5 * f64::from(k)]);
        assert_eq!((command.brake, command.status.fault), (k < 8, None));
    }
}

#[test]
fn a_reset_arm_follows_its_approach_from_the_begin() {
    let off = StopCategory::TorqueOff;
    for (category, later) in [(HOLDS, false), (off, false), (HOLDS, true), (off, true)] {
        let (mut controller, q) = stopped(category);
        assert!(controller.trajectory_tick() >= 100);
        let bounds = CONFIG.supervisor.limits;
        let motion = State::at([-0.5]);
        let way = controller.approach(&motion, &WAY, &bounds);
        let way = way.expect("an arm that is stopped");
        assert_eq!(controller.trajectory_tick(), 0);
        if later {
            // An operator confirms the start.
            for _ in 0..5 {
                tick(&mut controller, q);
                assert_eq!(controller.trajectory_tick(), 0);
            }
        }
        assert_eq!(controller.reset(&way), Ok(()));
        let mut at = q;
        for _ in 0..20 {
            controller.tick(Ok(&[at]), &way, |_, _| [4.0]);
            at = controller.reference().q[0];
        }
        // It has left its begin by no more than a few ticks.
        assert!(controller.trajectory_tick() < 20);
        assert!((at - q).abs() < 1e-3, "{at} {q}");
    }
}

#[test]
fn an_arm_that_moves_gets_no_approach() {
    let bounds = CONFIG.supervisor.limits;
    let mut controller = slow(HOLD);
    let refused = controller.approach(&Cruise, &WAY, &bounds);
    let refused = refused.map(|way| way.path_ticks()).unwrap_err();
    assert_eq!(refused, ApproachError::Reset(ResetError::NotStopped));
    assert_eq!(controller.trajectory_tick(), 100);
}

// The acceleration of a hold does not act on an arm that is released from it.
#[test]
fn a_reset_ends_the_deceleration() {
    let mut held = slow(0);
    held.stop_by(Fault::External, HOLDS);
    tick(&mut held, Cruise.at(100).q[0]);
    let lowering = StopCategory::DampedLowering { damping: [1.0] };
    let mut sinking = slow(HOLD).with_stop(lowering);
    sinking.stop(Fault::External);
    tick(&mut sinking, Cruise.at(100).q[0]);
    for mut controller in [held, sinking] {
        assert!(controller.reference().qdd[0] < -1.0);
        assert_eq!(controller.reset(&Cruise), Ok(()));
        assert_eq!(controller.reference().qdd, [0.0]);
    }
}

#[test]
fn a_reset_after_missed_ticks_begins_where_the_arm_is() {
    let mut held = slow(0);
    held.stop_by(Fault::External, HOLDS);
    let lowering = StopCategory::DampedLowering { damping: [1.0] };
    let mut sinking = slow(HOLD).with_stop(lowering);
    sinking.stop(Fault::External);
    for mut controller in [held, sinking] {
        tick(&mut controller, Cruise.at(100).q[0]);
        let before = controller.estimate().q;
        controller.missed(2, &Cruise);
        let estimate = *controller.estimate();
        assert!(estimate.q[0] > before[0]);
        assert_eq!(controller.reset(&Cruise), Ok(()));
        let begin = controller.resume.at(&Cruise, 0.0);
        assert_eq!((begin.q, begin.qd), (estimate.q, estimate.qd));
    }
}

#[test]
fn the_first_stop_of_category_2_decelerates() {
    let mut controller = slow(0);
    controller.stop_by(Fault::External, HOLDS);
    tick(&mut controller, Cruise.at(100).q[0]);
    let (reference, estimate) = (controller.reference(), controller.estimate());
    assert!(estimate.qd[0] > 0.4, "{estimate:?}");
    assert_eq!(reference.qd, estimate.qd);
}

#[test]
fn a_second_reset_needs_another_measurement() {
    let (mut controller, q) = stopped(StopCategory::TorqueOff);
    assert_eq!(controller.reset(&Cruise), Ok(()));
    controller.stop(Fault::External);
    assert_eq!(controller.reset(&Cruise), Err(ResetError::NoMeasurement));
    tick(&mut controller, q);
    assert_eq!(controller.reset(&Cruise), Ok(()));
}

#[test]
fn an_arm_at_the_restart_distance_is_near_enough() {
    let config = MotionControllerConfig {
        restart_distance: 0.125,
        ..CONFIG
    };
    for (q, reset) in [
        (0.125, Ok(())),
        (0.126, Err(ResetError::TooFar { joint: 0 })),
    ] {
        let mut controller = Controller::new(config).on_brake();
        let motion = State::at([0.0]);
        controller.tick(Ok(&[q]), &motion, |_, _| [0.0]);
        assert_eq!(controller.reset(&motion), reset);
    }
}
