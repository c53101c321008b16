//! An encoder at the motor whose frames are lost in a motion.

use std::cell::Cell;
use std::convert::Infallible;
use std::f64::consts::TAU;
use std::rc::Rc;

use dynamics_core::state::State;
use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use joint_drivers::as5047p::{As5047p, FrameError, encode};
use joint_drivers::{ControlLoop, Direction, JointDrive, JointMapping, JointRange, Law, NoBrake};
use motion_control::law::Gains;
use motion_control::limits::{Fault, Mode, SafetyLimits};
use motion_control::motion::{MotionController, MotionControllerConfig, ResetError};
use motion_control::safety::{StopCategory, SupervisorConfig};

use super::Motion;

const RATIO: f32 = 100.0;
const TICK: f32 = 1e-3;
/// The end of the motion.
const END: f64 = 1.8;

pub(super) const CONFIG: MotionControllerConfig<f32, 1> = MotionControllerConfig {
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
const RAMP: Motion<fn(u32) -> State<f32, 1, 1>> = Motion(|tick| State {
    qd: [if tick < 900 { 2.0 } else { 0.0 }],
    ..State::at([2e-3 * tick.min(900) as f32])
});

/// A joint of 1 kg·m².
struct Unit;

impl Law<1> for Unit {
    fn feedforward(reference: &State<f32, 1, 1>, (): &()) -> [f32; 1] {
        reference.qdd
    }
}

const GAINS: Gains<f32, 1> = Gains { kp: [400.0], kd: [40.0] };

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
        let pushed = self.qd.get() + f64::from(self.torque.get()) * 1e-3;
        self.qd.set(if brake { 0.0 } else { pushed });
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
    let mapping = mapping.with_range(JointRange::Near(0.0), 3.0 * TICK);
    As5047p::new(joint.clone(), mapping.unwrap())
}

type Control = ControlLoop<[As5047p<Joint>; 1], [Joint; 1], NoBrake, 1>;

fn control(joint: &Joint, category: StopCategory<f32, 1>) -> Control {
    let controller = MotionController::try_new(CONFIG).unwrap();
    let (encoders, drives) = ([encoder(joint)], [joint.clone()]);
    let controller = controller.with_stop(category);
    ControlLoop::new(encoders, drives, NoBrake, GAINS, controller, ())
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

#[test]
fn no_ride_through_ends_a_lost_turn_which_its_place_clears() {
    let categories = [StopCategory::ControlledOff, StopCategory::ControlledHold];
    for (lost, category) in LOST.iter().flat_map(|lost| categories.map(|one| (lost, one))) {
        let (lost, is_unknown) = *lost;
        let joint = Joint::default();
        joint.qd.set(2.0);
        let mut control = control(&joint, category);
        let (mut full, mut first) = (0, None);
        let mut run = |control: &mut Control, ticks: core::ops::Range<u32>| {
            let mut last = None;
            for tick in ticks {
                joint.is_broken.set((300..300 + lost).contains(&tick));
                let status = control.tick::<Unit, _, _>(&RAMP, &()).status;
                joint.advance(status.mode == Mode::Stopped);
                full += u32::from(status.mode == Mode::Full);
                first = first.or(status.fault);
                last = Some(status);
            }
            (last.unwrap(), full, first)
        };
        let near_end = || assert!((joint.q.get() - END).abs() < 1e-3, "{lost}");
        let (status, full, first) = run(&mut control, 0..2000);
        assert_eq!(first, Some(Fault::Encoder { joint: 0 }));
        if !is_unknown {
            assert_eq!((status.mode, status.fault), (Mode::Full, None), "{lost}");
            near_end();
            continue;
        }
        let fault = Fault::LostTurn { joint: 0 };
        assert_eq!((status.mode, status.fault), (Mode::Stopped, Some(fault)));
        assert!(full <= 305, "{lost}: {full}");
        let error = control.encoder_error().map(|error| *error.error);
        assert_eq!(error, Some(FrameError::LostTurn));
        let refused = control.reset(&RAMP);
        assert!(matches!(refused, Err(ResetError::NoMeasurement)), "{lost}");
        // Another sensor, or a hand that moved the joint, says where it is.
        let place = joint.q.get() as f32 + 0.02;
        control.encoders()[0].place_near(place).unwrap();
        run(&mut control, 2000..2001);
        control.reset(&RAMP).unwrap();
        let (status, ..) = run(&mut control, 2001..4000);
        assert_eq!((status.mode, status.fault), (Mode::Full, None));
        near_end();
    }
}

#[test]
fn ticks_that_a_timer_missed_are_missing_readings() {
    for (missed, is_unknown) in [(4, false), (9, false), (10, true), (17, true)] {
        let joint = Joint::default();
        let mut control = control(&joint, StopCategory::ControlledOff);
        let mut fault = None;
        for tick in (0..100).chain(100 + missed..200) {
            let (telemetry, _) = control.tick_at::<Unit, _, _>(&RAMP, &(), || tick);
            fault = telemetry.status.fault.or(fault);
            joint.q.set(2e-3 * f64::from(tick + 1));
        }
        let lost = fault == Some(Fault::LostTurn { joint: 0 });
        assert_eq!(lost, is_unknown, "{missed}");
    }
}
