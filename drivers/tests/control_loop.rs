//! The promises of the control loop about devices that fail.

use std::cell::Cell;
use std::convert::Infallible;
use std::f32::consts::TAU;
use std::fmt;

use dynamics_core::state::State;
use dynamics_core::state::manifold::nearest_turn;
use embedded_hal::digital::{self, OutputPin};
use joint_drivers::{
    ControlLoop, DriveFault, DriveFaultKind, EncoderType, JointDrive, JointDrives, JointEncoder,
    JointEncoders, JointError, Law, NoBrake, Phase, Probe, Telemetry,
};
use motion_control::law::Gains;
use motion_control::limits::{Circles, Fault, Mode, SafetyLimits};
use motion_control::motion::{CurrentTick, MotionController, MotionControllerConfig, OnCircles};
use motion_control::reference::Reference;
use motion_control::safety::{
    Detectors, FrozenEncoder, ReferenceStep, Saturation, SupervisorConfig,
};

mod completion;

use super::Motion;

const RIDE: u32 = 3;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Broken {
    Wire,
    Disabled,
}

impl fmt::Display for Broken {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, out)
    }
}

impl core::error::Error for Broken {}

impl DriveFault for Broken {
    fn kind(&self) -> DriveFaultKind {
        match self {
            Self::Wire => DriveFaultKind::Failed,
            Self::Disabled => DriveFaultKind::NotReady,
        }
    }
}

/// The other end of a joint's wires.
#[derive(Default)]
struct Wire {
    error: Cell<Option<Broken>>,
    accesses: Cell<u32>,
    torque: Cell<f32>,
}

impl Wire {
    fn access(&self) -> Result<(), Broken> {
        self.accesses.set(self.accesses.get() + 1);
        self.error.get().map_or(Ok(()), Err)
    }
}

struct Encoder<'a>(&'a Wire);

impl EncoderType for Encoder<'_> {
    type Error = Broken;
    type Age = CurrentTick;
}

impl JointEncoder for Encoder<'_> {
    fn sample(&mut self) -> Result<(), Broken> {
        self.0.access()
    }
    fn position(&self) -> f32 {
        0.25
    }
}

struct Drive<'a>(&'a Wire);

impl JointDrive for Drive<'_> {
    type Error = Broken;
    type Setpoint = f32;
    fn setpoint(&self, torque: f32) -> f32 {
        torque
    }
    fn set(&mut self, torque: f32) -> Result<(), Broken> {
        self.0.access()?;
        self.0.torque.set(torque);
        Ok(())
    }
}

struct Brake<'a>(&'a Wire);

impl digital::Error for Broken {
    fn kind(&self) -> digital::ErrorKind {
        digital::ErrorKind::Other
    }
}

impl digital::ErrorType for Brake<'_> {
    type Error = Broken;
}

impl OutputPin for Brake<'_> {
    fn set_low(&mut self) -> Result<(), Broken> {
        Drive(self.0).set(0.0)
    }
    fn set_high(&mut self) -> Result<(), Broken> {
        Drive(self.0).set(1.0)
    }
}

/// As much torque as holds still.
struct One;

impl Law<2> for One {
    fn feedforward(_: &State<f32, 2, 2>, (): &()) -> [f32; 2] {
        [1.0, 2.0]
    }
}

#[derive(Default)]
struct Wires {
    encoders: [Wire; 2],
    drives: [Wire; 2],
    brake: Wire,
}

type Arm<'a> = ControlLoop<[Encoder<'a>; 2], [Drive<'a>; 2], Brake<'a>, 2>;

fn controller() -> MotionController<f32, 2, CurrentTick> {
    MotionController::new(config())
}

fn config() -> MotionControllerConfig<f32, 2> {
    let limits = SafetyLimits {
        torque: [10.0; 2],
        rate: [10.0; 2],
        speed: [3.0; 2],
        lower: [-1.0; 2],
        upper: [1.0; 2],
    };
    MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits,
            tick: 1e-3,
            resolution: 0.0,
            ride_through_ticks: RIDE,
            hold_ticks: 2,
            reentry_ticks: 10,
        },
        observer_bandwidth: 250.0,
        decay_rate: 25.0,
        restart_distance: 0.1,
    }
}

const GAINS: Gains<f32, 2> = Gains { kp: [0.0; 2], kd: [0.0; 2] };

impl Wires {
    fn arm(&self) -> Arm<'_> {
        let brake = Brake(&self.brake);
        ControlLoop::new(self.encoders(), self.drives(), brake, GAINS, controller(), ())
    }

    fn encoders(&self) -> [Encoder<'_>; 2] {
        self.encoders.each_ref().map(Encoder)
    }

    fn drives(&self) -> [Drive<'_>; 2] {
        self.drives.each_ref().map(Drive)
    }

    fn braked(&self) -> bool {
        self.brake.torque.get() == 1.0
    }
}

fn tick(arm: &mut Arm<'_>) -> Telemetry<2> {
    arm.tick::<One, _, ()>(&at_rest(), &())
}

/// A reference that stays where the encoders are.
fn at_rest() -> State<f32, 2, 2> {
    State::at([0.25; 2])
}

/// The broken wire of the first joint.
const WIRE: JointError<&Broken> = JointError { joint: 0, error: &Broken::Wire };

#[test]
fn an_encoder_error_names_its_joint() {
    let wires = Wires::default();
    let mut arm = wires.arm();
    assert_eq!(tick(&mut arm).status.fault, None);
    wires.encoders[0].error.set(Some(Broken::Wire));
    let fault = Some(Fault::Encoder { joint: 0 });
    assert_eq!(tick(&mut arm).status.fault, fault);
    assert_eq!(arm.encoder_error(), Some(WIRE));
    assert_eq!(wires.encoders[1].accesses.get(), 2);
    wires.encoders[0].error.set(None);
    assert_eq!(tick(&mut arm).status.fault, None);
    assert_eq!(arm.encoder_error(), None);
}

#[test]
fn a_failed_drive_sets_the_brake() {
    let wires = Wires::default();
    let mut arm = wires.arm();
    tick(&mut arm);
    assert!(!wires.braked());
    wires.drives[0].error.set(Some(Broken::Wire));
    tick(&mut arm);
    assert!(wires.braked());
    assert_eq!(wires.drives[1].torque.get(), 2.0);
    assert_eq!(arm.drive_error(), Some(WIRE));
    let (status, fault) = (tick(&mut arm).status, Fault::Drive { joint: 0 });
    assert_eq!((status.mode, status.fault), (Mode::Stopped, Some(fault)));
}

#[test]
fn a_drive_may_be_unready_for_a_moment() {
    let wires = Wires::default();
    let mut arm = wires.arm();
    tick(&mut arm);
    wires.drives[1].error.set(Some(Broken::Disabled));
    for _ in 0..RIDE {
        let status = tick(&mut arm).status;
        assert_eq!((status.mode, wires.braked()), (Mode::Full, false));
    }
    wires.drives[1].error.set(None);
    let (status, fault) = (tick(&mut arm).status, Fault::NotReady { joint: 1 });
    assert_eq!((status.mode, status.fault), (Mode::Full, Some(fault)));
    assert_eq!(tick(&mut arm).status.fault, None);
}

#[test]
fn of_two_drives_the_one_that_failed_is_named() {
    let wires = Wires::default();
    for (errors, joint) in [
        ([Broken::Disabled, Broken::Wire], 1),
        ([Broken::Wire, Broken::Disabled], 0),
        ([Broken::Wire, Broken::Wire], 0),
        ([Broken::Disabled, Broken::Disabled], 0),
    ] {
        for (wire, error) in wires.drives.iter().zip(errors) {
            wire.error.set(Some(error));
        }
        let error = errors[joint];
        let set = wires.drives().set_torques(&[0.0; 2]);
        assert_eq!(set, Err(JointError { joint, error }));
    }
}

#[test]
fn a_probe_sees_each_phase_once_and_in_order() {
    #[derive(Default)]
    struct Seen(Vec<(Phase, bool)>, Option<Telemetry<2>>);
    impl Probe<2> for Seen {
        fn begin(&mut self, phase: Phase) {
            self.0.push((phase, true));
        }
        fn end(&mut self, phase: Phase) {
            self.0.push((phase, false));
        }
        fn record(&mut self, telemetry: &Telemetry<2>) {
            self.1 = Some(*telemetry);
        }
    }
    let (wires, mut seen) = (Wires::default(), Seen::default());
    let mut arm = wires.arm();
    let telemetry = arm.tick_probed::<One, _, ()>(&at_rest(), &(), &mut seen);
    use Phase::{Dynamics, Read, Reference, Safety, Tick, Write};
    let inner = [Read, Reference, Dynamics, Safety, Write];
    let inner = inner.map(|phase| [(phase, true), (phase, false)]);
    let whole = [&[(Tick, true)], inner.as_flattened(), &[(Tick, false)]];
    assert_eq!((seen.0, seen.1), (whole.concat(), Some(telemetry)));
}

/// One exchange for all joints, as on a bus; in each reading they have moved by a step.
struct Bus {
    q: f32,
    step: f32,
}

impl EncoderType for Bus {
    type Error = Infallible;
    type Age = CurrentTick;
}

impl JointEncoders<2> for Bus {
    fn start(&mut self) {}
    fn read(&mut self) -> Result<[f32; 2], JointError<Infallible>> {
        self.q += self.step;
        Ok([self.q; 2])
    }
}

impl JointDrives<2> for Bus {
    type Error = Infallible;
    fn set_torques(&mut self, _: &[f32; 2]) -> Result<(), JointError<Infallible>> {
        Ok(())
    }
}

#[test]
fn devices_of_all_joints_at_once_are_encoders_and_drives() {
    let buses = [0.25; 2].map(|q| Bus { q, step: 0.0 });
    let [encoders, drives] = buses;
    let mut arm = ControlLoop::new(encoders, drives, NoBrake, GAINS, controller(), ());
    let telemetry = arm.tick::<One, _, ()>(&at_rest(), &());
    assert_eq!(telemetry.status.fault, None);
    assert_eq!(telemetry.torque, [1.0, 2.0]);
}

/// An encoder of a joint without end, which gives the angle within a turn.
struct Endless<'a>(&'a Cell<f32>);

impl EncoderType for Endless<'_> {
    type Error = Infallible;
    type Age = CurrentTick;
}

impl JointEncoder for Endless<'_> {
    fn sample(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
    fn position(&self) -> f32 {
        nearest_turn(self.0.get(), 0.0)
    }
}

#[test]
fn a_loop_on_circles_turns_without_end() {
    const BOTH: u128 = Circles::NONE.with(0).with(1).bits();
    // Both joints cruise at 2.5 rad/s.
    let cruise = Motion(|tick| {
        // The angle of a whole number of ticks, of which 2513 are a turn.
        let q = TAU / 2513.0 * (tick % 2513) as f32;
        let qd = TAU / 2.513;
        State { q: [q, -q], qd: [qd, -qd], qdd: [0.0; 2] }
    });
    let mut config = config();
    let limits = &mut config.supervisor.limits;
    (limits.lower, limits.upper) = ([f32::NEG_INFINITY; 2], [f32::INFINITY; 2]);
    let controller = MotionController::<f32, 2, OnCircles<BOTH, CurrentTick>>::try_new(config);
    let controller = controller.expect("circles without bounds");
    let (q, wires) = ([Cell::new(0.0), Cell::new(0.0)], Wires::default());
    let encoders = q.each_ref().map(Endless);
    let drives = wires.drives();
    let detectors = Detectors {
        frozen: FrozenEncoder::new([0.01; 2], 3),
        steps: ReferenceStep::new([6e-3; 2]),
        saturation: Saturation::new([10.0; 2], 5),
    };
    let detectors = detectors.on_circles::<BOTH>();
    let mut arm = ControlLoop::on_circles(encoders, drives, NoBrake, GAINS, controller, detectors);
    for tick in 0..10_000 {
        let telemetry = arm.tick::<One, _, ()>(&cruise, &());
        assert_eq!(telemetry.status.fault, None, "{tick}");
        let [off, _] = core::array::from_fn(|i| telemetry.reference[i] - telemetry.estimate[i]);
        assert!(off.abs() < 0.01, "{tick}: {off}");
        // A joint that follows.
        for (q, aim) in q.iter().zip(cruise.at(tick + 1).q) {
            q.set(aim);
        }
    }
}
