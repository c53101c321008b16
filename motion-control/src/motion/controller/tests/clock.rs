//! The clock of the trajectory, the reference, and the estimate, in ticks that were missed or had
//! no measurement.

use super::*;
use crate::tests::Motion;

/// The ticks of a return onto the trajectory.
const RETURN: u32 = 200;

type Controller = MotionController<f64, 1, CurrentTick>;

fn tick(controller: &mut Controller, q: f64) -> Command<f64, 1> {
    controller.tick(Ok(&[q]), &CRUISE, |_, _| [1.0])
}

/// A controller in its return after a fault, of which this many ticks have passed, on a joint that
/// follows.
fn returning(ticks: u32) -> Controller {
    let mut config = CONFIG;
    config.supervisor.reentry_ticks = RETURN;
    let mut controller = Controller::new(config).on_brake();
    tick(&mut controller, 0.05);
    assert_eq!(controller.reset(&CRUISE), Ok(()));
    let mut q = 0.05;
    for _ in 0..ticks {
        assert_eq!(tick(&mut controller, q).status.fault, None);
        q = controller.reference().q[0];
    }
    controller
}

#[test]
fn an_arm_on_its_brake_begins_at_the_first_point() {
    let mut controller = Controller::new(CONFIG).on_brake();
    for _ in 0..3 {
        tick(&mut controller, 0.0);
    }
    assert_eq!(controller.trajectory_tick(), 0);
}

#[test]
fn without_measurements_the_estimate_moves_on() {
    let mut controller = following::<CurrentTick>(400, 0);
    for tick in 400..400 + RIDE {
        controller.tick(LOST, &CRUISE, |_, _| [1.0]);
        let gap = controller.estimate().q[0] - CRUISE.at(tick).q[0];
        assert!(gap.abs() < 1e-9, "{tick}: {gap}");
    }
}

// The clock of a return is not that of the motion, until it ends.
#[test]
fn a_hold_in_a_return_keeps_what_it_advanced() {
    // ∫w over three quarters is 0.257 of the whole.
    let advanced = 45..=51;
    let mut controller = returning(RETURN * 3 / 4);
    let before = controller.trajectory_tick();
    controller.stop_by(Fault::External, StopCategory::ControlledHold);
    let q = controller.estimate().q[0];
    tick(&mut controller, q);
    let held = controller.trajectory_tick();
    assert!(advanced.contains(&(held - before)), "{before} {held}");
    // The next ticks of the hold begin a return that has not advanced.
    tick(&mut controller, q);
    assert_eq!(controller.trajectory_tick(), held);
}

#[test]
fn excess_speed_is_a_fault_of_its_tick() {
    let mut controller = controller::<CurrentTick>();
    // Less than a jump, which is twice the greatest speed.
    let q = |tick: u32| [1.5 * 3.0 * TICK * f64::from(tick)];
    let found = (0..50).find_map(|tick| {
        let command = controller.tick(Ok(&q(tick)), &CRUISE, |_, _| [1.0]);
        command.status.fault
    });
    assert_eq!(found, Some(Fault::Speed { joint: 0 }));
}

#[test]
fn a_predicted_excess_speed_is_a_fault() {
    // A reference that accelerates by 2 rad/s in a tick.
    let steep = Motion(|_| State { qdd: [2.0 / TICK], ..State::at([0.0]) });
    let mut controller = controller::<CurrentTick>();
    controller.tick(Ok(&[0.0]), &steep, |_, _| [1.0]);
    let mut lost = || controller.tick(LOST, &steep, |_, _| [1.0]).status;
    assert_eq!(lost().fault, LOST.err());
    let status = lost();
    let speed = Some(Fault::Speed { joint: 0 });
    assert_eq!((status.mode, status.fault), (Mode::Hold, speed));
}

#[test]
fn a_reaction_from_outside_begins_in_the_next_tick() {
    for (fault, mode) in [
        (Fault::Overrun, Mode::Full),
        (Fault::External, Mode::Hold),
        (Fault::Drive { joint: 0 }, Mode::Stopped),
    ] {
        let mut controller = following::<CurrentTick>(50, 0);
        controller.react(fault);
        let status = tick(&mut controller, CRUISE.at(50).q[0]).status;
        assert_eq!((status.mode, status.fault), (mode, Some(fault)));
        // In place of a measurement it acts in its own tick.
        let mut controller = following::<CurrentTick>(50, 0);
        let status = controller.tick(Err(fault), &CRUISE, |_, _| [1.0]).status;
        assert_eq!((status.mode, status.fault), (mode, Some(fault)));
    }
}
