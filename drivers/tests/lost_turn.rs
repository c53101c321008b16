//! An encoder at the motor whose frames are lost in a motion.

use std::cell::Cell;
use std::convert::Infallible;
use std::f64::consts::TAU;
use std::rc::Rc;

use dynamics_core::state::State;
use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use joint_drivers::as5047p::{As5047p, FrameError, encode};
use joint_drivers::{
    ControlLoop, Direction, EncoderType, JointDrive, JointMapping, JointRange, Law, NoBrake,
};
use motion_control::{
    CurrentTick, Estimate, Fault, Gains, Mode, MotionController, MotionControllerConfig, Reference,
    ResetError, SafetyLimits, StopCategory, SupervisorConfig,
};

const RATIO: f32 = 100.0;
const TICK: f32 = 1e-3;
/// The end of the motion.
const END: f64 = 1.8;

const CONFIG: MotionControllerConfig<f32, 1> = MotionControllerConfig {
    supervisor: SupervisorConfig {
        limits: SafetyLimits {
            torque: [50.0],
            rate: [50.0],
            speed: [3.0],
            lower: [-3.0],
            upper: [3.0],
        },
        tick: TICK,
        resolution: 4e-6,
        ride_through_ticks: 5,
        hold_ticks: 100,
        reentry_ticks: 200,
    },
    observer_bandwidth: 250.0,
    decay_rate: 25.0,
    restart_distance: 0.15,
};

/// 2 rad/s to the end.
struct Ramp;

impl Reference<f32, 1> for Ramp {
    fn at(&self, tick: u32) -> State<f32, 1, 1> {
        let mut state = State::at([2e-3 * tick.min(900) as f32]);
        state.qd = [if tick < 900 { 2.0 } else { 0.0 }];
        state
    }
    fn ticks(&self) -> u32 {
        900
    }
}

/// A joint of 1 kg·m².
struct Unit;

impl Law<1> for Unit {
    fn feedforward(reference: &State<f32, 1, 1>, (): &()) -> [f32; 1] {
        reference.qdd
    }
}

const GAINS: Gains<f32, 1> = Gains {
    kp: [400.0],
    kd: [40.0],
};

/// The joint, its motor's encoder and its drive.
#[derive(Clone, Default)]
struct Joint {
    q: Rc<Cell<f64>>,
    qd: Rc<Cell<f64>>,
    torque: Rc<Cell<f32>>,
    is_broken: Rc<Cell<bool>>,
}

impl Joint {
    fn advance(&self, brake: bool) {
        let push = if brake {
            0.0
        } else {
            f64::from(self.torque.get()) * 1e-3
        };
        self.qd.set(if brake { 0.0 } else { self.qd.get() + push });
        self.q.set(self.q.get() + self.qd.get() * 1e-3);
    }
}

impl ErrorType for Joint {
    type Error = ErrorKind;
}

impl SpiDevice for Joint {
    fn transaction(&mut self, all: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        if self.is_broken.get() {
            return Err(ErrorKind::Other);
        }
        for operation in all {
            if let Operation::TransferInPlace(words) = operation {
                let turns = self.q.get() * f64::from(RATIO) / TAU;
                let raw = (turns * 16_384.0).round() as i64 as u16 & 0x3fff;
                words.copy_from_slice(&encode(raw).to_be_bytes());
            }
        }
        Ok(())
    }
}

impl JointDrive for Joint {
    type Error = Infallible;
    type Setpoint = f32;
    fn setpoint(&self, torque: f32) -> f32 {
        torque
    }
    fn set(&mut self, torque: f32) -> Result<(), Infallible> {
        self.torque.set(torque);
        Ok(())
    }
}

fn encoder(joint: &Joint) -> As5047p<Joint> {
    let mapping = JointMapping::new(0.0, Direction::Forward, RATIO).unwrap();
    // The motor turns by 0.3 rad in a tick at most: by half a turn in 11.
    let range = JointRange::Near(0.0);
    As5047p::new(
        joint.clone(),
        mapping.with_range(range, 3.0 * TICK).unwrap(),
    )
}

/// Frames that are lost from tick 300 on; whether the turn is lost with them.
const LOST: [(u32, bool); 8] = [
    (4, false),
    (9, false),
    (10, true),
    (14, true),
    (18, true),
    (22, true),
    (26, true),
    (40, true),
];

/// The distance of the joint from its measured position at the end, the modes of all ticks, and the
/// last fault.
fn alone(lost: u32, category: StopCategory<f32, 1>) -> (f64, [u32; 3], Option<Fault>) {
    let joint = Joint::default();
    joint.qd.set(2.0);
    let mut encoder = encoder(&joint);
    let controller = MotionController::<f32, 1, CurrentTick>::try_new(CONFIG).unwrap();
    let mut controller = controller.with_stop(category);
    let law = |reference: &State<f32, 1, 1>, estimate: &Estimate<f32, 1>| {
        Unit::torque(&GAINS, reference, estimate, &())
    };
    let (mut modes, mut fault, mut measured) = ([0; 3], None, 0.0);
    for tick in 0..2000 {
        joint.is_broken.set((300..300 + lost).contains(&tick));
        let read = encoder.read();
        measured = read.unwrap_or(measured);
        let read = read
            .map(|q| [q])
            .map_err(|error| As5047p::<Joint>::fault(&error, 0));
        let command = controller.tick(read.as_ref().map_err(|fault| *fault), &Ramp, law);
        modes[command.status.mode as usize] += 1;
        fault = command.status.fault.or(fault);
        joint.torque.set(command.torque[0]);
        joint.advance(command.brake);
    }
    ((joint.q.get() - f64::from(measured)).abs(), modes, fault)
}

#[test]
fn no_ride_through_ends_a_lost_turn() {
    for (lost, is_unknown) in LOST {
        for category in [StopCategory::ControlledOff, StopCategory::ControlledHold] {
            let (off, [full, _, stopped], fault) = alone(lost, category);
            if is_unknown {
                assert_eq!(fault, Some(Fault::LostTurn { joint: 0 }), "{lost}");
                assert!(full <= 305 && stopped > 1500, "{lost}: {full} {stopped}");
            } else {
                assert!(off < 1e-5 && stopped == 0, "{lost}: {off} {stopped}");
                assert_eq!(fault, Some(Fault::Encoder { joint: 0 }));
            }
        }
    }
}

#[test]
fn a_lost_turn_is_cleared_only_by_its_place() {
    for (lost, is_unknown) in LOST.into_iter().filter(|(lost, _)| *lost < 20) {
        let joint = Joint::default();
        joint.qd.set(2.0);
        let controller = MotionController::try_new(CONFIG).unwrap();
        let (encoders, drives) = ([encoder(&joint)], [joint.clone()]);
        let mut control = ControlLoop::new(encoders, drives, NoBrake, GAINS, controller, ());
        let run = |control: &mut ControlLoop<_, _, _, 1>, ticks: core::ops::Range<u32>| {
            let mut last = None;
            for tick in ticks {
                joint.is_broken.set((300..300 + lost).contains(&tick));
                let telemetry = control.tick::<Unit, _, _>(&Ramp, &());
                joint.advance(telemetry.status.mode == Mode::Stopped);
                last = Some(telemetry.status);
            }
            last.unwrap()
        };
        let status = run(&mut control, 0..1000);
        if !is_unknown {
            assert_eq!((status.mode, status.fault), (Mode::Full, None), "{lost}");
            continue;
        }
        let fault = Fault::LostTurn { joint: 0 };
        assert_eq!((status.mode, status.fault), (Mode::Stopped, Some(fault)));
        let error = control.encoder_error().map(|error| *error.error);
        assert_eq!(error, Some(FrameError::LostTurn));
        assert!(
            matches!(control.reset(&Ramp), Err(ResetError::NoMeasurement)),
            "{lost}"
        );
        // Another sensor, or a hand that moved the joint, says where it is.
        let place = joint.q.get() as f32 + 0.02;
        control.encoders()[0].place_near(place).unwrap();
        run(&mut control, 1000..1001);
        control.reset(&Ramp).unwrap();
        let status = run(&mut control, 1001..3000);
        assert_eq!((status.mode, status.fault), (Mode::Full, None));
        assert!(
            (joint.q.get() - END).abs() < 1e-3,
            "{lost}: {}",
            joint.q.get()
        );
    }
}

#[test]
fn ticks_that_a_timer_missed_are_missing_readings() {
    for (missed, is_unknown) in [(4, false), (9, false), (10, true), (17, true)] {
        let joint = Joint::default();
        let controller = MotionController::try_new(CONFIG).unwrap();
        let (encoders, drives) = ([encoder(&joint)], [joint.clone()]);
        let mut control = ControlLoop::new(encoders, drives, NoBrake, GAINS, controller, ());
        let mut fault = None;
        for tick in (0..100).chain(100 + missed..200) {
            let (telemetry, _) = control.tick_at::<Unit, _, _>(&Ramp, &(), || tick);
            fault = telemetry.status.fault.or(fault);
            joint.q.set(2e-3 * f64::from(tick + 1));
        }
        assert_eq!(
            fault == Some(Fault::LostTurn { joint: 0 }),
            is_unknown,
            "{missed}"
        );
    }
}
