use super::*;
use crate::*;

mod clock;
mod restart;
mod stops;

const TICK: f64 = 1e-3;
const RIDE: u32 = 2;
const HOLD: u32 = 3;

const CONFIG: MotionControllerConfig<f64, 1> = MotionControllerConfig {
    supervisor: SupervisorConfig {
        limits: SafetyLimits {
            torque: [10.0],
            rate: [10.0],
            speed: [3.0],
            lower: [-2.0],
            upper: [2.0],
        },
        tick: TICK,
        resolution: 0.0,
        ride_through_ticks: RIDE,
        hold_ticks: HOLD,
        reentry_ticks: 4,
    },
    observer_bandwidth: 250.0,
    decay_rate: 25.0,
    restart_distance: 0.1,
};

const LOST: Result<&[f64; 1], Fault> = Err(Fault::Encoder { joint: 0 });

/// One joint at constant speed.
struct Cruise;

const SPEED: f64 = 0.5;

impl Reference<f64, 1> for Cruise {
    fn at(&self, tick: u32) -> State<f64, 1, 1> {
        State {
            q: [SPEED * TICK * f64::from(tick)],
            qd: [SPEED],
            qdd: [0.0],
        }
    }
    fn ticks(&self) -> u32 {
        u32::MAX
    }
}

fn controller<A: MeasurementAge>() -> MotionController<f64, 1, A> {
    MotionController::try_new(CONFIG).expect("every number is in its range")
}

/// A controller whose joint has followed for this many ticks, measurements being `late` ticks old.
fn following<A: MeasurementAge>(ticks: u32, late: u32) -> MotionController<f64, 1, A> {
    let mut controller = controller();
    for tick in 0..ticks {
        let q = Cruise.at(tick.saturating_sub(late)).q;
        let command = controller.tick(Ok(&q), &Cruise, |_, _| [1.0]);
        assert_eq!(command.status.fault, None);
    }
    controller
}

#[test]
fn measurements_of_either_age_give_the_estimate_of_now() {
    let now = Cruise.at(399).q[0];
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
            controller.tick(LOST, &Cruise, |_, _| [1.0]);
        }
        let q = Cruise.at(400 + RIDE + 1 - late).q;
        controller.tick(Ok(&q), &Cruise, |_, _| [1.0]);
        controller.estimate().q[0] - Cruise.at(400 + RIDE + 1).q[0]
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
        let q = Cruise.at(tick - 1).q;
        let measured = if tick % 20 < 4 { LOST } else { Ok(&q) };
        let command = whole.tick(measured, &Cruise, law);
        let step = steps.observe(measured).reference(&Cruise);
        let tau = law(step.reference(), step.estimate());
        assert_eq!(step.command(&tau), command);
        assert_eq!(steps, whole);
    }
}

#[test]
fn a_tick_without_command_faults_the_next() {
    let mut controller = following::<PreviousTick>(50, 1);
    let _ = controller.observe(Ok(&Cruise.at(49).q));
    let command = controller.tick(Ok(&Cruise.at(50).q), &Cruise, |_, _| [1.0]);
    assert_eq!(command.status.fault, Some(Fault::Unfinished));
    assert_eq!(command.status.mode, Mode::Full);
    for _ in 0..RIDE + HOLD {
        let _ = controller.observe(Ok(&Cruise.at(50).q));
    }
    let command = controller.tick(Ok(&Cruise.at(50).q), &Cruise, |_, _| [1.0]);
    assert_eq!((command.torque, command.brake), ([0.0], true));
}

#[test]
fn missed_ticks_move_the_estimate_and_the_trajectory_on() {
    let mut controller = following::<PreviousTick>(100, 1);
    controller.missed(4, &Cruise);
    assert_eq!(controller.trajectory_tick(), 104);
    let mut followed = [0.0];
    let q = Cruise.at(103).q;
    let command = controller.tick(Ok(&q), &Cruise, |reference, _| {
        followed = reference.q;
        [1.0]
    });
    assert_eq!(command.status.fault, None);
    assert_eq!(followed, Cruise.at(104).q);
    assert!((controller.estimate().q[0] - followed[0]).abs() < 1e-9);
    // The work is bounded, whatever a timer says.
    controller.missed(u32::MAX, &Cruise);
    assert_eq!(controller.trajectory_tick(), 105 + RIDE + HOLD);
}

#[test]
fn a_held_arm_slows_down_and_its_trajectory_waits() {
    let mut controller = following::<PreviousTick>(100, 1);
    for _ in 0..RIDE {
        controller.tick(LOST, &Cruise, |_, _| [1.0]);
    }
    let step = controller.observe(LOST).reference(&Cruise);
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

// It acts in its own tick.
#[test]
fn an_external_stop_lasts_until_a_reset() {
    let mut controller = following::<PreviousTick>(50, 1);
    assert_eq!(controller.reset(&Cruise), Err(ResetError::NotStopped));
    let q = Cruise.at(49).q;
    let mut step = controller.observe(Ok(&q)).reference(&Cruise);
    step.stop(Fault::External);
    let command = step.command(&[1.0]);
    assert_eq!((command.torque, command.brake), ([0.0], true));
    assert_eq!(command.status.fault, Some(Fault::External));

    assert!(controller.tick(LOST, &Cruise, |_, _| [1.0]).brake);
    assert_eq!(controller.reset(&Cruise), Err(ResetError::NoMeasurement));
    let far = [q[0] + 0.2];
    assert!(controller.tick(Ok(&far), &Cruise, |_, _| [1.0]).brake);
    assert_eq!(
        controller.reset(&Cruise),
        Err(ResetError::TooFar { joint: 0 })
    );
    assert!(controller.tick(Ok(&q), &Cruise, |_, _| [1.0]).brake);
    assert_eq!(controller.reset(&Cruise), Ok(()));
    let command = controller.tick(Ok(&q), &Cruise, |_, _| [1.0]);
    assert_eq!((command.torque, command.status.fault), ([1.0], None));
}

#[test]
fn numbers_outside_their_range_are_refused_by_name() {
    use core::error::Error;
    let of = |change: fn(&mut MotionControllerConfig<f64, 1>)| {
        let mut config = CONFIG;
        change(&mut config);
        MotionController::<f64, 1>::try_new(config).unwrap_err()
    };
    for (error, parameter) in [
        (of(|c| c.supervisor.tick = 0.0), ConfigParameter::Tick),
        (
            of(|c| c.supervisor.resolution = -1.0),
            ConfigParameter::Resolution,
        ),
        (
            of(|c| c.observer_bandwidth = f64::NAN),
            ConfigParameter::Bandwidth,
        ),
        (of(|c| c.decay_rate = -1.0), ConfigParameter::DecayRate),
        (
            of(|c| c.restart_distance = f64::NAN),
            ConfigParameter::RestartDistance,
        ),
    ] {
        assert_eq!(error, ConfigError::OutOfRange { parameter });
        assert!(error.source().is_none());
    }
    let error = of(|c| c.supervisor.limits.torque = [-1.0]);
    assert!(error.source().is_none());
    assert_eq!(
        error.to_string(),
        "joint 0: its torque limit, -1, is negative"
    );
}

// The arm has to be near its trajectory.
#[test]
fn a_braked_arm_starts_only_by_a_near_reset() {
    let mut controller = controller::<PreviousTick>().on_brake();
    assert_eq!(controller.reset(&Cruise), Err(ResetError::NoMeasurement));
    for q in [[0.2], [0.2]] {
        let command = controller.tick(Ok(&q), &Cruise, |_, _| [1.0]);
        assert_eq!((command.torque, command.brake), ([0.0], true));
        assert_eq!(
            (command.status.mode, command.status.fault),
            (Mode::Stopped, None)
        );
    }
    let far = ResetError::TooFar { joint: 0 };
    assert_eq!(controller.reset(&Cruise), Err(far));

    let mut config = CONFIG;
    config.supervisor.reentry_ticks = 200;
    let controller = MotionController::<f64, 1>::try_new(config);
    let mut controller = controller.expect("every number is in its range").on_brake();
    controller.tick(Ok(&[0.05]), &Cruise, |_, _| [1.0]);
    assert_eq!(controller.reset(&Cruise), Ok(()));
    let (mut brakes, mut q) = (0, [0.05]);
    for _ in 0..2000 {
        let command = controller.tick(Ok(&q), &Cruise, |_, _| [1.0]);
        q = controller.reference().q;
        assert_eq!(command.status.fault, None);
        brakes += u32::from(command.brake);
    }
    assert!(brakes < 5, "{brakes}");
    let reference = controller.reference().q[0];
    let on = Cruise.at(controller.clock - 1).q[0];
    assert!((reference - on).abs() < 1e-9, "{reference} {on}");
}
