use super::*;
use crate::tests::{Motion, controlled, safety_limits};
use crate::{estimate::*, law::*, limits::*, motion::*, reference::*, safety::*};

mod clock;
mod hand_over;
mod limits;
mod restart;
mod stops;

const TICK: f64 = 1e-3;
const RIDE: u32 = 2;
const HOLD: u32 = 3;

const CONFIG: MotionControllerConfig<f64, 1> = controlled(
    safety_limits([10.0], [10.0], [3.0], [-2.0], [2.0]),
    TICK,
    [RIDE, HOLD, 4],
    [250.0, 25.0, 0.1],
);

const LOST: Result<&[f64; 1], Fault> = Err(Fault::Encoder { joint: 0 });

const SPEED: f64 = 0.5;
/// One joint at constant speed.
const CRUISE: Motion<fn(u32) -> State<f64, 1, 1>> =
    Motion(|tick| State { q: [SPEED * TICK * f64::from(tick)], qd: [SPEED], qdd: [0.0] });

fn controller<A: MeasurementAge>() -> MotionController<f64, 1, A> {
    MotionController::try_new(CONFIG).expect("every number is in its range")
}

/// A controller whose joint has followed for this many ticks, measurements being `late` ticks old.
fn following<A: MeasurementAge>(ticks: u32, late: u32) -> MotionController<f64, 1, A> {
    let mut controller = controller();
    for tick in 0..ticks {
        let q = CRUISE.at(tick.saturating_sub(late)).q;
        let command = controller.tick(Ok(&q), &CRUISE, |_, _| [1.0]);
        assert_eq!(command.status.fault, None);
    }
    controller
}

#[test]
fn measurements_of_either_age_give_the_estimate_of_now() {
    let now = CRUISE.at(399).q[0];
    for estimate in [
        *following::<PreviousTick>(400, 1).estimate(),
        *following::<CurrentTick>(400, 0).estimate(),
    ] {
        assert!((estimate.q[0] - now).abs() < 1e-9, "{estimate:?}");
        assert!((estimate.qd[0] - SPEED).abs() < 1e-6, "{estimate:?}");
    }
}

// This holds for measurements of either age.
#[test]
fn after_a_hold_the_position_is_current() {
    fn error<A: MeasurementAge>(late: u32) -> f64 {
        let mut controller = following::<A>(400, late);
        for _ in 0..=RIDE {
            controller.tick(LOST, &CRUISE, |_, _| [1.0]);
        }
        let q = CRUISE.at(400 + RIDE + 1 - late).q;
        controller.tick(Ok(&q), &CRUISE, |_, _| [1.0]);
        controller.estimate().q[0] - CRUISE.at(400 + RIDE + 1).q[0]
    }
    // A tick at what its speed decays by meanwhile.
    let slower = SPEED * TICK * 25.0 * TICK * 2.0;
    assert!(error::<PreviousTick>(1).abs() < slower);
    assert!(error::<CurrentTick>(0).abs() < 1e-15);
}

#[test]
fn the_steps_of_a_tick_are_those_of_the_closure() {
    let [mut whole, mut steps] = [(); 2].map(|()| following::<PreviousTick>(50, 1));
    let law = |reference: &State<f64, 1, 1>, estimate: &Estimate<f64, 1>| {
        [reference.q[0] - estimate.q[0] + 3.0]
    };
    for tick in 50..100 {
        let q = CRUISE.at(tick - 1).q;
        let measured = if tick % 20 < 4 { LOST } else { Ok(&q) };
        let command = whole.tick(measured, &CRUISE, law);
        let step = steps.observe(measured).reference(&CRUISE);
        let tau = law(step.reference(), step.estimate());
        assert_eq!(step.command(&tau), command);
        assert_eq!(steps, whole);
    }
}

#[test]
fn missed_ticks_move_the_estimate_and_the_trajectory_on() {
    let mut controller = following::<PreviousTick>(100, 1);
    controller.missed(4, &CRUISE);
    assert_eq!(controller.reference(), &CRUISE.at(103));
    assert_eq!(controller.trajectory_tick(), 104);
    let mut followed = [0.0];
    let q = CRUISE.at(103).q;
    let command = controller.tick(Ok(&q), &CRUISE, |reference, _| {
        followed = reference.q;
        [1.0]
    });
    assert_eq!(command.status.fault, None);
    assert_eq!(followed, CRUISE.at(104).q);
    assert!((controller.estimate().q[0] - followed[0]).abs() < 1e-9);
    // The work is bounded, whatever a timer says.
    controller.missed(u32::MAX, &CRUISE);
    assert_eq!(controller.trajectory_tick(), 105 + RIDE + HOLD);
}

#[test]
fn a_held_arm_slows_down_and_its_trajectory_waits() {
    let mut controller = following::<PreviousTick>(100, 1);
    for _ in 0..RIDE {
        controller.tick(LOST, &CRUISE, |_, _| [1.0]);
    }
    let step = controller.observe(LOST).reference(&CRUISE);
    let (estimate, reference) = (*step.estimate(), *step.reference());
    assert_eq!(step.mode(), Mode::Hold);
    assert_eq!((reference.q, reference.qd), (estimate.q, estimate.qd));
    assert_eq!(reference.qdd, [-25.0 * estimate.qd[0]]);
    // 1/λ of 40 ticks.
    assert_eq!(step.trajectory_tick(), 100 + RIDE + 40);
    let step = step.without_inertia();
    assert_eq!(step.reference().qd, [0.0]);
    let command = step.command(&[1.0]);
    assert_eq!((command.torque, command.brake), ([1.0], false));
    assert_eq!(controller.trajectory_tick(), 100 + RIDE + 40);
}

#[test]
fn a_stop_within_a_tick_acts_in_it() {
    let mut controller = following::<PreviousTick>(50, 1);
    assert_eq!(controller.reset(&CRUISE), Err(ResetError::NotStopped));
    let q = CRUISE.at(49).q;
    let mut step = controller.observe(Ok(&q)).reference(&CRUISE);
    step.stop(Fault::External);
    let command = step.command(&[1.0]);
    assert_eq!((command.torque, command.brake), ([0.0], true));
    assert_eq!(command.status.fault, Some(Fault::External));
}

#[test]
fn numbers_outside_their_range_are_refused_by_name() {
    use core::error::Error;
    type Change = fn(&mut MotionControllerConfig<f64, 1>);
    let of = |change: Change| {
        let mut config = CONFIG;
        change(&mut config);
        MotionController::<f64, 1>::try_new(config).unwrap_err()
    };
    let changes: [(Change, _); 5] = [
        (|c| c.supervisor.tick = 0.0, ConfigParameter::Tick),
        (|c| c.supervisor.resolution = -1.0, ConfigParameter::Resolution),
        (|c| c.observer_bandwidth = f64::NAN, ConfigParameter::Bandwidth),
        (|c| c.decay_rate = -1.0, ConfigParameter::DecayRate),
        (|c| c.restart_distance = f64::NAN, ConfigParameter::RestartDistance),
    ];
    for (change, parameter) in changes {
        assert_eq!(of(change), ConfigError::OutOfRange { parameter });
    }
    let error = of(|c| c.supervisor.limits.torque = [-1.0]);
    assert!(error.source().is_none());
    let text = "joint 0: its torque limit, -1, is negative";
    assert_eq!(error.to_string(), text);
}

// The arm has to be near its trajectory.
#[test]
fn a_braked_arm_starts_only_by_a_near_reset() {
    let mut controller = controller::<PreviousTick>().on_brake();
    assert_eq!(controller.reset(&CRUISE), Err(ResetError::NoMeasurement));
    for q in [[0.2], [0.2]] {
        let command = controller.tick(Ok(&q), &CRUISE, |_, _| [1.0]);
        assert_eq!((command.torque, command.brake), ([0.0], true));
        let status = command.status;
        assert_eq!((status.mode, status.fault), (Mode::Stopped, None));
    }
    let far = ResetError::TooFar { joint: 0 };
    assert_eq!(controller.reset(&CRUISE), Err(far));

    let mut config = CONFIG;
    config.supervisor.reentry_ticks = 200;
    let controller = MotionController::<f64, 1>::try_new(config);
    let mut controller = controller.expect("every number is in its range").on_brake();
    controller.tick(Ok(&[0.05]), &CRUISE, |_, _| [1.0]);
    assert_eq!(controller.reset(&CRUISE), Ok(()));
    let (mut brakes, mut q) = (0, [0.05]);
    for _ in 0..2000 {
        let command = controller.tick(Ok(&q), &CRUISE, |_, _| [1.0]);
        q = controller.reference().q;
        assert_eq!(command.status.fault, None);
        brakes += u32::from(command.brake);
    }
    assert!(brakes < 5, "{brakes}");
    let reference = controller.reference().q[0];
    let on = CRUISE.at(controller.clock - 1).q[0];
    assert!((reference - on).abs() < 1e-9, "{reference} {on}");
}
