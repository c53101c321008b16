//! The feedback on the drive against torques alone: a joint of which the drive computes its sum at
//! 20 kHz, under a loop of 500 Hz.

use std::cell::Cell;

use dynamics_core::state::State as Motion;
use embedded_hal::digital::{self, OutputPin};
use joint_drivers::{ControlLoop, Law, NoBrake, PdDrives, PdOnDrives, Telemetry};
use motion_control::estimate::Estimate;
use motion_control::law::Gains;
use motion_control::limits::{Command, Fault, Mode, SafetyLimits};
use motion_control::motion::{MotionController, MotionControllerConfig};
use motion_control::safety::{Detect, StopCategory, SupervisorConfig};

use super::super::lost_turn::CONFIG;
use super::*;

const SCALE: Scale = damiao::DM4310;
const TICK: f64 = 2e-3;
/// Steps of the drive in a tick.
const STEPS: u32 = 40;
/// kg·m².
const INERTIA: f64 = 0.02;
const GAINS: Gains<f32, 1> = Gains { kp: [300.0], kd: [4.0] };

type Joints = CanJoints<Outbox<FdFrame, 1>, Damiao, 1>;

/// A joint without gravity, and the drive that acts on it.
struct Plant {
    q: f64,
    qd: f64,
    command: [f64; 5],
    load: f64,
    status: u8,
    /// The greatest distance from zero, rad.
    deviation: f64,
}

impl Plant {
    const REST: Self =
        Self { q: 0.0, qd: 0.0, command: [0.0; 5], load: 0.0, status: 1, deviation: 0.0 };

    /// The drive's sum at a state.
    fn sum(&self, q: f64, qd: f64) -> f64 {
        let [p, v, kp, kd, torque] = self.command;
        kp * (p - q) + kd * (v - qd) + torque
    }

    fn tick(&mut self) {
        let dt = TICK / f64::from(STEPS);
        for _ in 0..STEPS {
            let torque = self.sum(self.q, self.qd).clamp(-10.0, 10.0);
            self.qd += (torque + self.load) / INERTIA * dt;
            self.q += self.qd * dt;
            self.deviation = self.deviation.max(self.q.abs());
        }
    }

    /// The reply to a command that arrives now.
    fn reply(&self) -> FdFrame {
        let (is_enabled, error) = (self.status == 1, if self.status > 1 { self.status } else { 0 });
        let (angle, speed, command) = (self.q, self.qd, self.command);
        Drive { is_enabled, error, angle, speed, command, ..Drive::new(1, SCALE) }.reply()
    }
}

/// Against a weight of so many N·m.
struct Hold<const WEIGHT: i8 = 0>;

impl<const WEIGHT: i8> Law<1> for Hold<WEIGHT> {
    fn feedforward(_: &Motion<f32, 1, 1>, (): &()) -> [f32; 1] {
        [WEIGHT.into()]
    }
}

/// Notes the torque and the state at which the drives are to have it.
struct Noted<'a, D>(D, &'a Cell<Option<(f32, Estimate<f32, 1>)>>);

impl<D: JointDrives<1>> JointDrives<1> for Noted<'_, D> {
    type Error = D::Error;
    const HAVE_PD: bool = D::HAVE_PD;
    fn set_torques(&mut self, torques: &[f32; 1]) -> Result<(), JointError<D::Error>> {
        self.1.set(None);
        self.0.set_torques(torques)
    }
    fn set_with_pd(
        &mut self,
        torques: &[f32; 1],
        reference: &Motion<f32, 1, 1>,
        estimate: &Estimate<f32, 1>,
    ) -> Result<(), JointError<D::Error>> {
        self.1.set(Some((torques[0], *estimate)));
        self.0.set_with_pd(torques, reference, estimate)
    }
}

fn controller(rate: f32) -> MotionController<f32, 1> {
    let limits =
        SafetyLimits { torque: [8.0], rate: [rate], speed: [20.0], lower: [-1.0], upper: [1.0] };
    let tick = TICK as f32;
    let supervisor = SupervisorConfig { limits, tick, resolution: 4e-4, ..CONFIG.supervisor };
    let supervisor =
        SupervisorConfig { ride_through_ticks: 3, hold_ticks: 5, reentry_ticks: 5, ..supervisor };
    let config = MotionControllerConfig { supervisor, restart_distance: 0.1, ..CONFIG };
    MotionController::try_new(config).unwrap()
}

fn joints() -> Joints {
    let drive = Damiao::new(1, 0x11, SCALE, 10.0, identity()).unwrap();
    CanJoints::new(Outbox::new(), [drive])
}

type Arm<'a, D> = ControlLoop<&'a Joints, D, NoBrake, 1>;

fn arm<D: JointDrives<1>>(joints: &Joints, drives: D) -> Arm<'_, D> {
    let control = ControlLoop::new(joints, drives, NoBrake, GAINS, controller(16.0), ());
    joints.commands();
    joints.receive(&Plant::REST.reply());
    control
}

/// A tick of the loop, whose command the drive has at once and replies to; then the drive's time.
fn tick<D: JointDrives<1>>(
    arm: &mut Arm<'_, D>,
    joints: &Joints,
    plant: &mut Plant,
) -> Telemetry<1> {
    let at_rest = super::super::Motion(|_| Motion::at([0.0]));
    let telemetry = arm.tick::<Hold, _, ()>(&at_rest, &());
    let [frame] = joints.commands();
    plant.command = decoded(&frame.unwrap(), &SCALE);
    joints.receive(&plant.reply());
    telemetry
}

/// The greatest deviation under a load of 4 N·m for a quarter of a second, rad.
fn deviation<D: JointDrives<1>>(drives: impl FnOnce(&'static Joints) -> D) -> (f64, Mode) {
    let joints: &'static Joints = Box::leak(Box::new(joints()));
    let (mut arm, mut plant) = (arm(joints, drives(joints)), Plant::REST);
    let mut mode = Mode::Full;
    for time in 0..250 {
        plant.load = if (20..145).contains(&time) { 4.0 } else { 0.0 };
        mode = tick(&mut arm, joints, &mut plant).status.mode;
        plant.tick();
    }
    (plant.deviation, mode)
}

#[test]
fn the_drive_holds_stiffer_than_the_loop() {
    let (on_drive, mode) = deviation(|joints| PdOnDrives::new(joints, GAINS));
    assert_eq!(mode, Mode::Full);
    let (torques, in_torques) = deviation(|joints| joints);
    // The spring alone gives 4 / 300 rad. With torques that are two ticks old the joint swings.
    assert!(on_drive < 0.0137, "{on_drive}");
    assert_eq!(in_torques, Mode::Full);
    assert!(torques > 4.0 * on_drive, "{torques} {on_drive}");
}

#[test]
fn in_the_instant_of_a_tick_the_drive_has_the_torque_of_the_gate() {
    let (joints, noted) = (joints(), Cell::new(None));
    let mut arm = arm(&joints, Noted(PdOnDrives::new(&joints, GAINS), &noted));
    let mut plant = Plant::REST;
    let (mut worst, mut most) = (0.0_f64, 0.0_f64);
    for time in 0..500_u32 {
        plant.load = 5.0 * (f64::from(time) * 0.13).sin();
        let telemetry = tick(&mut arm, &joints, &mut plant);
        let (torque, at) = noted.get().expect("full operation");
        assert_eq!((torque, at.q), (telemetry.torque[0], telemetry.estimate));
        let sum = plant.sum(at.q[0].into(), at.qd[0].into());
        worst = worst.max((sum - f64::from(torque)).abs());
        most = most.max(sum.abs());
        assert!(plant.command[2] > 299.0 && plant.command[3] > 3.9);
        plant.tick();
    }
    // Half a count of ±10 N·m is 2.442 mN·m.
    assert!(worst < 2.45e-3 && most > 3.0, "{worst} {most}");
}

#[test]
fn a_fault_makes_the_gains_zero_in_its_tick() {
    let (joints, noted) = (joints(), Cell::new(None));
    let mut arm = arm(&joints, Noted(PdOnDrives::new(&joints, GAINS), &noted));
    let mut plant = Plant { q: 0.05, ..Plant::REST };
    let gains = |plant: &Plant| plant.command[2] + plant.command[3];
    for _ in 0..20 {
        tick(&mut arm, &joints, &mut plant);
        plant.tick();
    }
    assert!(gains(&plant) > 0.0);
    // A reply at the end of its scale takes the place of another one.
    (&joints).read().unwrap();
    joints.receive(&standard(0x11, &[0x11, FF, FF, 0x80, 8, 0, 30, 30]));
    let telemetry = tick(&mut arm, &joints, &mut plant);
    assert_eq!(telemetry.status.fault, Some(Fault::Encoder { joint: 0 }));
    let range = JointError { joint: 0, error: &CanError::Range };
    assert_eq!(arm.encoder_error(), Some(range));
    assert_eq!((telemetry.status.mode, gains(&plant)), (Mode::Full, 0.0));
    assert!((plant.sum(0.0, 0.0) - f64::from(telemetry.torque[0])).abs() < 2.45e-3);
    tick(&mut arm, &joints, &mut plant);
    assert!(gains(&plant) > 0.0);
    // A drive that is too hot.
    plant.status = 0xc;
    joints.receive(&plant.reply());
    tick(&mut arm, &joints, &mut plant);
    assert_eq!(gains(&plant), 0.0);
    let hot = CanError::OverTemperature(Component::Motor);
    assert_eq!(arm.drive_error(), Some(JointError { joint: 0, error: &hot }));
    let telemetry = tick(&mut arm, &joints, &mut plant);
    assert_eq!((telemetry.status.mode, gains(&plant)), (Mode::Stopped, 0.0));
    assert_eq!(telemetry.status.fault, Some(Fault::Drive { joint: 0 }));
}

/// A brake's pin, and what the detectors find.
#[derive(Default)]
struct Outside {
    brake: Cell<bool>,
    found: Cell<Option<Fault>>,
}

impl digital::ErrorType for &Outside {
    type Error = core::convert::Infallible;
}

impl OutputPin for &Outside {
    fn set_low(&mut self) -> Result<(), Self::Error> {
        self.brake.set(false);
        Ok(())
    }
    fn set_high(&mut self) -> Result<(), Self::Error> {
        self.brake.set(true);
        Ok(())
    }
}

impl Detect<f32, 1> for &Outside {
    fn measured(&mut self, _: &[f32; 1], _: &[f32; 1]) -> Result<(), Fault> {
        Ok(())
    }
    fn referenced(&mut self, _: &Motion<f32, 1, 1>, _: Mode) -> Result<(), Fault> {
        Ok(())
    }
    fn restart(&mut self) {}
    fn commanded(&mut self, _: &Command<f32, 1>) -> Result<(), Fault> {
        self.found.get().map_or(Ok(()), Err)
    }
}

#[test]
fn the_gains_are_zero_on_the_brake_and_in_a_stop() {
    let (joints, outside) = (joints(), Outside::default());
    let drives = PdOnDrives::new(&joints, GAINS);
    let controller = controller(2.0).on_brake();
    let mut arm = ControlLoop::new(&joints, drives, &outside, GAINS, controller, &outside);
    joints.commands();
    let path = super::super::Motion(|_| Motion::at([0.0]));
    let mut tick = |stop: bool| {
        if stop {
            arm.stop_by(Fault::External, StopCategory::ControlledHold);
        }
        joints.receive(&Plant::REST.reply());
        let status = arm.tick::<Hold<5>, _, ()>(&path, &()).status;
        if status.mode == Mode::Stopped {
            arm.reset(&path).unwrap();
        }
        let [frame] = joints.commands();
        let [_, _, kp, kd, _] = decoded(&frame.unwrap(), &SCALE);
        assert_eq!(kp > 0.0, kd > 0.0);
        (status, outside.brake.get(), kp > 0.0)
    };
    let (status, braked, stiff) = tick(false);
    assert_eq!((status.mode, braked, stiff), (Mode::Stopped, true, false));
    let (status, braked, stiff) = tick(false);
    assert_eq!((status.mode, braked, stiff), (Mode::Full, true, false));
    for found in [Some(Fault::External), None] {
        for time in 0..30 {
            let (status, braked, stiff) = tick(false);
            assert!(!(braked && stiff) && (stiff || time < 25), "{time}: {status:?}");
        }
        // A detector's finding in a command.
        outside.found.set(found);
        assert_eq!(tick(false).2, found.is_none());
        outside.found.set(None);
    }
    let (status, braked, stiff) = tick(true);
    assert_eq!((status.mode, braked, stiff), (Mode::Hold, false, false));
    for _ in 0..50 {
        let (status, braked, stiff) = tick(false);
        assert_eq!((status.mode, braked, stiff), (Mode::Hold, false, false), "{status:?}");
    }
}

#[test]
fn frames_of_a_task_are_those_of_a_bus() {
    use super::super::can_joints::heard;
    let drive = || Damiao::new(1, 0x11, SCALE, 10.0, identity()).unwrap();
    let inbox = joints();
    let wanted = |torque| SetpointAt {
        sum: setpoint([0.1, 0.0, 20.0, 1.0, torque]),
        ..SetpointAt::default()
    };
    for status in [1, 0, 0xb] {
        let reply = Plant { status, ..Plant::REST }.reply();
        let bus = CanJoints::new(heard(&[reply]), [drive()]);
        inbox.receive(&reply);
        assert_eq!((&inbox).read(), (&bus).read());
        assert_eq!((&inbox).read(), (&bus).read());
        let mut sent = Vec::new();
        for torque in [1.0, -30.0] {
            assert_eq!((&inbox).set_torques(&[torque]), (&bus).set_torques(&[torque]));
            sent.extend(inbox.commands().into_iter().flatten());
            assert_eq!((&inbox).set_sums(&[wanted(torque)]), (&bus).set_sums(&[wanted(torque)]));
            sent.extend(inbox.commands().into_iter().flatten());
        }
        assert_eq!((sent.len(), sent), (4, bus.release().sent));
    }
    // Frames that nobody takes.
    inbox.receive(&Plant::REST.reply());
    assert_eq!((&inbox).set_torques(&[0.0]), Ok(()));
    let full = Err(JointError { joint: 0, error: CanError::Full });
    assert_eq!((&inbox).set_torques(&[0.0]), full);
}
