//! The effect of a reset on a stop.

use super::*;
use crate::tests::motion_limits;

type Controller = MotionController<f64, 1, CurrentTick>;

const WAY: [MotionLimits<f64>; 1] = [motion_limits(1.0, 4.0)];
const HOLDS: StopCategory<f64, 1> = StopCategory::ControlledHold;

/// A controller whose torque changes slowly, and that has followed for 100 ticks.
fn slow(hold_ticks: u32) -> Controller {
    let mut config = CONFIG;
    config.supervisor.limits.rate = [0.5];
    config.supervisor.hold_ticks = hold_ticks;
    let mut controller = Controller::new(config);
    for k in 0..100 {
        tick(&mut controller, CRUISE.at(k).q[0]);
    }
    controller
}

fn tick(controller: &mut Controller, q: f64) -> Command<f64, 1> {
    controller.tick(Ok(&[q]), &CRUISE, |_, _| [4.0])
}

/// The same, stopped and at rest for many ticks.
fn stopped(category: StopCategory<f64, 1>) -> (Controller, f64) {
    let mut controller = slow(HOLD);
    controller.stop_by(Fault::External, category);
    let q = CRUISE.at(100).q[0];
    for _ in 0..500 {
        tick(&mut controller, q);
    }
    (controller, q)
}

/// One that is held and one that sinks, in their first tick.
fn decelerating() -> [Controller; 2] {
    let (mut held, damping) = (slow(0), [1.0]);
    held.stop_by(Fault::External, HOLDS);
    let mut sinking = slow(HOLD).with_stop(StopCategory::DampedLowering { damping });
    sinking.stop(Fault::External);
    let mut both = [held, sinking];
    for one in &mut both {
        tick(one, CRUISE.at(100).q[0]);
    }
    both
}

#[test]
fn a_held_arm_is_reset_under_its_torque() {
    let (mut controller, q) = stopped(HOLDS);
    assert_eq!(controller.reset(&CRUISE), Ok(()));
    let command = tick(&mut controller, q);
    assert_eq!((command.torque, command.brake), ([4.0], false));
    assert_eq!(command.status.fault, None);
}

#[test]
fn a_stopped_arm_is_reset_under_its_brake() {
    let (mut controller, q) = stopped(StopCategory::TorqueOff);
    assert_eq!(controller.reset(&CRUISE), Ok(()));
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

// The acceleration of a hold does not act on an arm that is released from it.
#[test]
fn a_reset_ends_the_deceleration() {
    for mut controller in decelerating() {
        assert!(controller.reference().qdd[0] < -1.0);
        assert_eq!(controller.reset(&CRUISE), Ok(()));
        assert_eq!(controller.reference().qdd, [0.0]);
    }
}

#[test]
fn a_reset_after_missed_ticks_begins_where_the_arm_is() {
    for mut controller in decelerating() {
        let before = controller.estimate().q;
        controller.missed(2, &CRUISE);
        let estimate = *controller.estimate();
        assert!(estimate.q[0] > before[0]);
        assert_eq!(controller.reset(&CRUISE), Ok(()));
        let begin = controller.resume.at(&CRUISE, 0.0);
        assert_eq!((begin.q, begin.qd), (estimate.q, estimate.qd));
    }
}

#[test]
fn the_first_stop_of_category_2_decelerates() {
    let mut controller = slow(0);
    controller.stop_by(Fault::External, HOLDS);
    tick(&mut controller, CRUISE.at(100).q[0]);
    let (reference, estimate) = (controller.reference(), controller.estimate());
    assert!(estimate.qd[0] > 0.4, "{estimate:?}");
    assert_eq!(reference.qd, estimate.qd);
}

#[test]
fn a_second_reset_needs_another_measurement() {
    let (mut controller, q) = stopped(StopCategory::TorqueOff);
    assert_eq!(controller.reset(&CRUISE), Ok(()));
    controller.stop(Fault::External);
    assert_eq!(controller.reset(&CRUISE), Err(ResetError::NoMeasurement));
    tick(&mut controller, q);
    assert_eq!(controller.reset(&CRUISE), Ok(()));
}

#[test]
fn an_arm_at_the_restart_distance_is_near_enough() {
    let config = MotionControllerConfig { restart_distance: 0.125, ..CONFIG };
    for (q, reset) in [(0.125, Ok(())), (0.126, Err(ResetError::TooFar { joint: 0 }))] {
        let mut controller = Controller::new(config).on_brake();
        let motion = State::at([0.0]);
        controller.tick(Ok(&[q]), &motion, |_, _| [0.0]);
        assert_eq!(controller.reset(&motion), reset);
    }
}
