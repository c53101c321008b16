//! The loop's ends: the law, the detectors, the brake, the clock of a timer.

use std::cell::RefCell;

use motion_control::law::AccelerationGains;
use motion_control::limits::{Command, MotionLimits, SafetyLimits, Status};
use motion_control::reference::Reference;
use motion_control::safety::{Detect, StopCategory};

use super::*;

/// The questions to the detectors, and the fault that each of them finds.
#[derive(Default)]
struct Watched {
    measured: RefCell<Vec<([f32; 2], [f32; 2])>>,
    referenced: RefCell<Vec<(State<f32, 2, 2>, Mode)>>,
    commanded: RefCell<Vec<Command<f32, 2>>>,
    restarts: Cell<u32>,
    faults: [Cell<Option<Fault>>; 3],
}

impl Watched {
    fn found(&self, which: usize) -> Result<(), Fault> {
        self.faults[which].get().map_or(Ok(()), Err)
    }
}

impl Detect<f32, 2> for &Watched {
    fn measured(&mut self, q: &[f32; 2], reference: &[f32; 2]) -> Result<(), Fault> {
        self.measured.borrow_mut().push((*q, *reference));
        self.found(0)
    }
    fn referenced(&mut self, reference: &State<f32, 2, 2>, mode: Mode) -> Result<(), Fault> {
        self.referenced.borrow_mut().push((*reference, mode));
        self.found(1)
    }
    fn commanded(&mut self, command: &Command<f32, 2>) -> Result<(), Fault> {
        self.commanded.borrow_mut().push(*command);
        self.found(2)
    }
    fn restart(&mut self) {
        self.restarts.set(self.restarts.get() + 1);
    }
}

type Watching<'a> = ControlLoop<[Encoder<'a>; 2], [Drive<'a>; 2], Brake<'a>, 2, &'a Watched>;

fn arm<'a>(wires: &'a Wires, watched: &'a Watched) -> Watching<'a> {
    let (encoders, drives) = (wires.encoders(), wires.drives());
    let brake = Brake(&wires.brake);
    ControlLoop::new(encoders, drives, brake, GAINS, controller(), watched)
}

fn status(arm: &mut Watching<'_>) -> Status {
    arm.tick::<One, _, ()>(&at_rest(), &()).status
}

/// A motion of 1 mrad in each tick of 1 ms, through where the encoders are.
const MOVING: Motion<fn(u32) -> State<f32, 2, 2>> =
    Motion(|tick| State { qd: [1.0, -1.0], ..State::at([0.25 + 1e-3 * tick as f32; 2]) });

#[test]
fn a_brake_that_fails_stops_the_arm_in_the_next_tick() {
    let (wires, watched) = Default::default();
    let mut arm = arm(&wires, &watched);
    assert_eq!(status(&mut arm).fault, None);
    wires.brake.error.set(Some(Broken::Wire));
    assert_eq!(status(&mut arm).fault, None);
    let after = status(&mut arm);
    let fault = Some(Fault::Brake);
    assert_eq!((after.mode, after.fault), (Mode::Stopped, fault));
    // One that fails while it is set is a fault as well, and a failed drive is the reason if both
    // fail.
    for (drive, fault) in [(None, Fault::Brake), (Some(Broken::Wire), Fault::Drive { joint: 0 })] {
        arm.reset(&at_rest()).unwrap();
        wires.drives[0].error.set(drive);
        status(&mut arm);
        let after = status(&mut arm);
        assert_eq!((after.mode, after.fault), (Mode::Stopped, Some(fault)));
    }
}

#[test]
fn a_fault_of_completion_is_that_of_the_next_tick() {
    for (fault, mode) in [
        (Fault::Saturated { joint: 1 }, Mode::Stopped),
        (Fault::External, Mode::Hold),
        (Fault::Overrun, Mode::Full),
    ] {
        let (wires, watched): (Wires, Watched) = Default::default();
        let mut arm = arm(&wires, &watched);
        watched.faults[2].set(Some(fault));
        let now = status(&mut arm);
        assert_eq!((now.mode, now.fault), (Mode::Full, None));
        watched.faults[2].set(None);
        let after = status(&mut arm);
        assert_eq!((after.mode, after.fault), (mode, Some(fault)));
    }
}

#[test]
fn a_detected_measurement_is_a_fault_of_its_tick() {
    let (wires, watched): (Wires, Watched) = Default::default();
    let mut arm = arm(&wires, &watched);
    status(&mut arm);
    let fault = Some(Fault::Frozen { joint: 1 });
    watched.faults[0].set(fault);
    for tick in 0..=RIDE {
        let now = status(&mut arm);
        let mode = if tick < RIDE { Mode::Full } else { Mode::Hold };
        assert_eq!((now.mode, now.fault), (mode, fault));
    }
}

#[test]
fn a_detected_reference_holds_the_arm_in_its_tick() {
    let (wires, watched): (Wires, Watched) = Default::default();
    let mut arm = arm(&wires, &watched);
    arm.tick::<One, _, ()>(&MOVING, &());
    let fault = Some(Fault::Reference { joint: 1 });
    watched.faults[1].set(fault);
    let telemetry = arm.tick::<One, _, ()>(&MOVING, &());
    let status = telemetry.status;
    assert_eq!((status.mode, status.fault), (Mode::Hold, fault));
    // The law is that of the hold: where the arm is, not where the reference went.
    assert_eq!(telemetry.reference, [0.25; 2]);
    // Category 1: after `hold_ticks` the arm is stopped.
    watched.faults[1].set(None);
    let after = [(); 3].map(|()| arm.tick::<One, _, ()>(&MOVING, &()).status.mode);
    assert_eq!(after, [Mode::Hold, Mode::Hold, Mode::Stopped]);
}

#[test]
fn detectors_see_what_acted_and_what_was_commanded() {
    let (wires, watched): (Wires, Watched) = Default::default();
    let mut arm = arm(&wires, &watched);
    let ticks = [(); 2].map(|()| arm.tick::<One, _, ()>(&MOVING, &()));
    // The reference of the tick before acted until this measurement.
    let measured = [[0.0; 2], MOVING.at(0).q].map(|acted| ([0.25; 2], acted));
    assert_eq!(*watched.measured.borrow(), measured);
    let referenced = [0, 1].map(|tick| (MOVING.at(tick), Mode::Full));
    assert_eq!(*watched.referenced.borrow(), referenced);
    for (command, tick) in watched.commanded.borrow().iter().zip(ticks) {
        assert_eq!((command.torque, command.status), (tick.torque, tick.status));
    }
    assert_eq!(watched.commanded.borrow().len(), 2);
    // A position that no encoder measured is not examined; the torque is that of every mode.
    wires.encoders[1].error.set(Some(Broken::Wire));
    arm.tick::<One, _, ()>(&MOVING, &());
    assert_eq!(watched.measured.borrow().len(), 2);
    assert_eq!(watched.commanded.borrow().len(), 3);
}

#[test]
fn detectors_restart_after_missed_ticks_and_a_reset_alone() {
    let (wires, watched): (Wires, Watched) = Default::default();
    let mut arm = arm(&wires, &watched);
    let count = Cell::new(7);
    let mut missed_before = |now: u32| {
        count.set(now);
        let restarts = watched.restarts.get();
        let (telemetry, completed) = arm.tick_at::<One, _, ()>(&MOVING, &(), || count.get());
        assert!(completed.is_some(), "it ended in time");
        (telemetry.tick, watched.restarts.get() - restarts)
    };
    // The trajectory goes on in the ticks that were missed.
    let restarts = [7, 8, 10, 11, 14].map(&mut missed_before);
    assert_eq!(restarts, [(0, 0), (1, 0), (3, 1), (4, 0), (7, 1)]);
    assert_eq!(arm.tick::<One, _, ()>(&MOVING, &()).status.fault, None);
    arm.stop_by(Fault::External, StopCategory::TorqueOff);
    let stopped = arm.tick::<One, _, ()>(&MOVING, &()).status;
    assert_eq!((stopped.mode, watched.restarts.get()), (Mode::Stopped, 2));
    assert_eq!(stopped.fault, Some(Fault::External));
    arm.reset(&MOVING).unwrap();
    assert_eq!(watched.restarts.get(), 3);
    assert_eq!(arm.tick::<One, _, ()>(&MOVING, &()).status.mode, Mode::Full);
    // A reset of an arm that is not stopped is refused.
    assert!(arm.reset(&MOVING).is_err());
}

#[test]
fn a_tick_that_ends_late_completes_none_and_is_a_fault() {
    let (wires, watched): (Wires, Watched) = Default::default();
    let mut arm = arm(&wires, &watched);
    let count = Cell::new(0);
    let late = || count.replace(count.get() + 1);
    let (telemetry, completed) = arm.tick_at::<One, _, ()>(&at_rest(), &(), late);
    assert_eq!((telemetry.status.fault, completed), (None, None));
    let (telemetry, completed) = arm.tick_at::<One, _, ()>(&at_rest(), &(), || count.get());
    assert_eq!(telemetry.status.fault, Some(Fault::Overrun));
    assert!(completed.is_some());
}

/// A law without inertia, whose feed-forward is the velocity of its reference; or the same law,
/// said to have it.
struct OfVelocity<const INERTIA: bool>;

impl<const INERTIA: bool> Law<2> for OfVelocity<INERTIA> {
    const ACCELERATES: bool = INERTIA;
    fn feedforward(reference: &State<f32, 2, 2>, (): &()) -> [f32; 2] {
        reference.qd
    }
}

/// The torque of a law in the full mode, and in a hold of an arm that still moves.
fn full_and_held<L: Law<2>>() -> [[f32; 2]; 2] {
    let [encoders, drives] = [1e-3, 0.0].map(|step| Bus { q: 0.0, step });
    let mut arm = ControlLoop::new(encoders, drives, NoBrake, GAINS, controller(), ());
    let full = [(); 20].map(|()| arm.tick::<L, _, ()>(&MOVING, &()).torque);
    arm.stop_by(Fault::External, StopCategory::ControlledHold);
    [full[19], arm.tick::<L, _, ()>(&MOVING, &()).torque]
}

#[test]
fn the_limits_of_a_loop_change_between_ticks() {
    let [encoders, drives] = [1e-3, 0.0].map(|step| Bus { q: 0.0, step });
    let mut arm = ControlLoop::new(encoders, drives, NoBrake, GAINS, controller(), ());
    let weak = SafetyLimits {
        torque: [0.5; 2],
        rate: [1.0; 2],
        speed: [100.0; 2],
        lower: [-10.0; 2],
        upper: [10.0; 2],
    };
    assert_eq!(arm.set_limits(&weak, 1.0), Ok(true));
    let torques = [(); 20].map(|()| arm.tick::<OfVelocity<true>, _, ()>(&MOVING, &()).torque);
    assert_eq!(torques[19], [0.5, -0.5]);
    assert!(arm.set_limits(&SafetyLimits { torque: [f32::NAN; 2], ..weak }, 1.0).is_err());
}

/// The acceleration of a joint of 2 kg·m², whose gains are those of accelerations.
struct Inertia;

impl Law<2, (), AccelerationGains<f32, 2>> for Inertia {
    fn feedforward(reference: &State<f32, 2, 2>, (): &()) -> [f32; 2] {
        reference.qdd.map(|qdd| 2.0 * qdd)
    }
}

#[test]
fn gains_of_accelerations_act_through_the_model() {
    let [encoders, drives] = [0.0; 2].map(|step| Bus { q: 0.0, step });
    let gains = AccelerationGains { kp: [30.0; 2], kd: [0.0; 2] };
    let mut arm = ControlLoop::new(encoders, drives, NoBrake, gains, controller(), ());
    let ahead = State::at([0.05, -0.025]);
    let torques = [(); 20].map(|()| arm.tick::<Inertia, _, ()>(&ahead, &()).torque);
    assert_eq!(torques[19], [2.0 * 30.0 * 0.05, -2.0 * 30.0 * 0.025]);
}

type Still = ControlLoop<Bus, Bus, NoBrake, 2>;

#[test]
fn a_loop_stops_and_is_led_back_as_its_controller() {
    let [encoders, drives] = [0.0; 2].map(|step| Bus { q: 0.5, step });
    let mut arm = ControlLoop::new(encoders, drives, NoBrake, GAINS, controller(), ());
    fn tick(arm: &mut Still, to: &impl Reference<f32, 2>) -> Option<Fault> {
        arm.tick::<OfVelocity<true>, _, ()>(to, &()).status.fault
    }
    let place = State::at([0.5; 2]);
    let first = arm.trajectory_tick();
    assert_eq!((tick(&mut arm, &place), arm.mode()), (None, Mode::Full));
    assert_eq!((arm.trajectory_tick(), arm.estimate().q), (first + 1, [0.5; 2]));
    arm.react(Fault::External);
    assert_eq!(tick(&mut arm, &place), Some(Fault::External));
    arm.stop(Fault::Model);
    assert_eq!((tick(&mut arm, &place), arm.mode()), (Some(Fault::Model), Mode::Stopped));
    // The reference is too far away for a reset, but not for a way there.
    let far = State::at([-0.5; 2]);
    assert!(arm.reset(&far).is_err());
    let limits = [MotionLimits { velocity: 1.0, acceleration: 10.0 }; 2];
    let path = arm.approach(&far, &limits, &config().supervisor.limits).expect("a way");
    assert_eq!(arm.reset(&path), Ok(()));
    assert_eq!((tick(&mut arm, &path), arm.mode()), (None, Mode::Full));
}

#[test]
fn a_law_without_inertia_holds_at_zero_velocity() {
    let without = full_and_held::<OfVelocity<false>>();
    assert_eq!(without, [[1.0, -1.0], [0.0; 2]]);
    let [full, held] = full_and_held::<OfVelocity<true>>();
    assert_eq!(full, [1.0, -1.0]);
    let near = |speed: &f32| (speed - 1.0).abs() < 0.1;
    assert!(held.iter().all(near), "{held:?}");
}

#[test]
fn the_law_is_feedforward_and_feedback() {
    let mut reference = State::at([0.5, 0.0]);
    reference.qd = [0.25, -1.0];
    let (q, qd) = ([0.25, 0.5], [0.5, -1.5]);
    let estimate = motion_control::estimate::Estimate { q, qd };
    let (kp, kd) = ([8.0, 2.0], [4.0, 16.0]);
    // 1 + 8 · 0.25 − 4 · 0.25 and 2 − 2 · 0.5 + 16 · 0.5.
    let torque = One::torque(&Gains { kp, kd }, &reference, &estimate, &());
    assert_eq!(torque, [2.0, 9.0]);
}
