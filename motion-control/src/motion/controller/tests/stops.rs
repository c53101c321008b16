//! Stop categories on a joint that moves: an inertia of 2 kg·m² under a torque of gravity.

use super::*;
use crate::tests::Motion;

const INERTIA: f64 = 2.0;
const GRAVITY: f64 = -4.0;

/// The position and the velocity of a joint.
struct Joint(f64, f64);

impl Joint {
    fn step(&mut self, torque: f64) {
        self.1 += TICK * (torque + GRAVITY) / INERTIA;
        self.0 += TICK * self.1;
    }
}

/// The law of a model whose gravity is `share` of the joint's.
fn law(share: f64) -> impl Fn(&State<f64, 1, 1>, &Estimate<f64, 1>) -> [f64; 1] {
    move |reference, estimate| {
        let e = reference.q[0] - estimate.q[0];
        let ed = reference.qd[0] - estimate.qd[0];
        [INERTIA * reference.qdd[0] - share * GRAVITY + 1250.0 * e + 100.0 * ed]
    }
}

fn config() -> MotionControllerConfig<f64, 1> {
    let mut config = CONFIG;
    config.supervisor.hold_ticks = 150;
    config.supervisor.reentry_ticks = 200;
    config
}

type Controller = MotionController<f64, 1, CurrentTick>;

/// A controller whose joint follows [`CRUISE`] for 300 ticks.
fn cruising(category: StopCategory<f64, 1>) -> (Controller, Joint) {
    let controller = MotionController::try_new(config()).expect("every number is in its range");
    let (mut controller, mut joint) = (controller.with_stop(category), Joint(0.0, SPEED));
    (0..300).for_each(|_| _ = tick(&mut controller, &mut joint, 1.0));
    (controller, joint)
}

fn tick(controller: &mut Controller, joint: &mut Joint, share: f64) -> Command<f64, 1> {
    let command = controller.tick(Ok(&[joint.0]), &CRUISE, law(share));
    joint.step(command.torque[0]);
    command
}

#[test]
fn category_2_stays_at_rest_despite_model_errors() {
    let (mut controller, mut joint) = cruising(StopCategory::ControlledOff);
    controller.stop_by(Fault::External, StopCategory::ControlledHold);
    (0..400).for_each(|_| _ = tick(&mut controller, &mut joint, 0.9));
    let rest = joint.0;
    for _ in 0..5000 {
        let command = tick(&mut controller, &mut joint, 0.9);
        assert_eq!((command.status.mode, command.brake), (Mode::Hold, false));
        assert_eq!(command.status.fault, Some(Fault::External));
    }
    // 0.4 N·m of gravity at 1250 N·m/rad are 0.3 mrad.
    assert!((joint.0 - rest).abs() < 4e-4, "{} {rest}", joint.0);
    assert_eq!(controller.reset(&CRUISE), Ok(()));
    for _ in 0..1000 {
        let command = tick(&mut controller, &mut joint, 0.9);
        assert_eq!((command.status.fault, command.brake), (None, false));
    }
    let goal = controller.reference().q[0];
    assert!((joint.0 - goal).abs() < 4e-4, "{} {goal}", joint.0);
}

#[test]
fn a_sinking_joint_has_the_speed_of_gravity_over_damping() {
    let (mut controller, mut joint) = cruising(StopCategory::DampedLowering { damping: [20.0] });
    // A drive has failed: no controlled part.
    controller.stop(Fault::External);
    let mut fastest = 0.0_f64;
    for _ in 0..3000 {
        let command = tick(&mut controller, &mut joint, 1.0);
        assert_eq!(command.status.mode, Mode::Stopped);
        fastest = fastest.max(-joint.1);
    }
    assert!((joint.1 - GRAVITY / 20.0).abs() < 1e-6, "{}", joint.1);
    assert!(fastest < 1.05 * 0.2, "{fastest}");
}

// A wrong measurement gives no torque.
#[test]
fn a_sinking_joint_is_damped_beyond_its_bounds() {
    let (mut controller, mut joint) = cruising(StopCategory::DampedLowering { damping: [20.0] });
    controller.stop(Fault::External);
    joint.0 = -2.1;
    (0..2000).for_each(|_| _ = tick(&mut controller, &mut joint, 1.0));
    assert!((joint.1 - GRAVITY / 20.0).abs() < 1e-6, "{}", joint.1);
    for wrong in [Ok(&[f64::NAN]), Ok(&[7.0]), Err(Fault::Stale)] {
        let command = controller.tick(wrong, &CRUISE, law(1.0));
        assert_eq!(command.torque, [0.0]);
        let command = controller.tick(Ok(&[joint.0]), &CRUISE, law(1.0));
        // The estimate of the velocity rises again from zero.
        let rising = (-1e-9..0.5 * -GRAVITY).contains(&command.torque[0]);
        assert!(rising, "{command:?}");
        (0..100).for_each(|_| _ = tick(&mut controller, &mut joint, 1.0));
    }
}

#[test]
fn a_reference_that_jumps_is_replaced_in_its_tick() {
    let (mut controller, joint) = cruising(StopCategory::ControlledOff);
    let mut steps = ReferenceStep::new([3.0 * TICK]);
    assert_eq!(steps.check(controller.reference()), Ok(()));
    // Another motion, a radian away.
    let away = Motion(|tick| {
        let mut state = CRUISE.at(tick);
        state.q[0] += 1.0;
        state
    });
    let mut step = controller.observe(Ok(&[joint.0])).reference(&away);
    let fault = steps.check(step.reference()).unwrap_err();
    step.stop_by(fault, StopCategory::ControlledOff);
    let (reference, estimate) = (*step.reference(), *step.estimate());
    assert_eq!((step.mode(), reference.q), (Mode::Hold, estimate.q));
    assert_eq!(reference.qdd, [-25.0 * estimate.qd[0]]);
    let command = step.command(&law(1.0)(&reference, &estimate));
    assert_eq!(command.status.fault, Some(Fault::Reference { joint: 0 }));
}

#[test]
fn too_many_missed_ticks_stop_the_arm() {
    for (ticks, fault) in [(2 + 150, None), (2 + 151, Some(Fault::Missed))] {
        let (mut controller, _) = cruising(StopCategory::ControlledOff);
        controller.missed(ticks, &CRUISE);
        let q = controller.estimate().q;
        let command = controller.tick(Ok(&q), &CRUISE, law(1.0));
        assert_eq!(command.status.fault, fault);
        assert_eq!(command.brake, fault.is_some());
    }
}

#[test]
fn a_reported_fault_is_ridden_through_and_forgotten() {
    let (mut controller, mut joint) = cruising(StopCategory::ControlledOff);
    let fault = Fault::NotReady { joint: 0 };
    for mode in [Mode::Full, Mode::Full, Mode::Hold] {
        controller.report(fault);
        controller.report(Fault::Overrun);
        let status = tick(&mut controller, &mut joint, 1.0).status;
        assert_eq!((status.mode, status.fault), (mode, Some(fault)));
    }
    let status = tick(&mut controller, &mut joint, 1.0).status;
    assert_eq!((status.mode, status.fault), (Mode::Full, None));
}

/// The observer has no position yet, and the first one is next to its zero.
#[test]
fn a_sinking_arm_is_known_from_its_first_measurement_on() {
    let category = StopCategory::DampedLowering { damping: [20.0] };
    let mut controller = Controller::new(config()).with_stop(category);
    controller.stop(Fault::Restarted);
    for tick in 0..3 {
        controller.tick(Ok(&[1e-3 * f64::from(tick)]), &CRUISE, law(1.0));
    }
    assert_eq!(controller.reset(&CRUISE), Ok(()));
}
