//! The drives of the robot: their kind, numbers and scales, and how they are mounted. Adapt them to
//! your parts.
//!
//! `joint-drivers` has further drives in MIT mode (`mit::robstride`, `mit::cubemars`), and moteus
//! and ODrive: all that implement `CanJoint`. Drives of several makers are of the type
//! `mit::AnyDrive`. A controller of fewer places than joints needs an `Outbox` as its bus.

use dynamics_core::model::Robot;
use embedded_hal::digital::OutputPin;
use joint_drivers::can::{CanError, Silence};
use joint_drivers::mit::Scale;
use joint_drivers::mit::damiao::{DM4310, DM4340, DM6006, DM8006, DM8009, Damiao};
use joint_drivers::{CanJoints, ControlLoop, Direction, EncoderMapping, JointBus, JointError};
use motion_control::limits::{Mode, Status};
use motion_control::motion::{PreviousTick, ResetError};
use motion_control::safety::Detect;

use crate::control::{Measured, controller, encoder_mappings};
use crate::say::Line;
use crate::scene::{self, Arm};

pub mod bus;

pub use crate::control::{FeedForward as Law, Found, Gains, SetupError, detectors, gains};
pub use crate::scene::{Motion, N, TICK};

/// A drive in MIT mode.
pub type Drive = Damiao;

/// The motor of each joint: the greatest position, velocity and torque of its counts, which are the
/// registers PMAX, VMAX and TMAX of the drive. Here it is the weakest motor that has the joint's
/// torque in the description: write down yours, such as `[DM4340, DM4340, DM4310]`.
///
/// A motor also brings its rotor and its friction, which act if the description states them
/// (`armature`, `frictionloss` and `damping` of a joint in MJCF; `armature`, `friction` and
/// `damping` of `<dynamics>` in URDF; then import again). At the joint, from public tables: the DM4310 has a rotor of 0.0018 kg·m² and Coulomb friction of
/// 0.05 to 0.17 N·m, the DM4340 0.032 and 0.17 to 0.4, the DM8009 0.0158 and 0.31.
pub const SCALES: [Scale; N] = {
    let (mut scales, mut joint) = ([DM4310; N], 0);
    while joint < N {
        scales[joint] = match Arm::MODEL.links[joint].limits.torque {
            ..=10.0 => DM4310,
            ..=20.0 => DM6006,
            ..=28.0 => DM4340,
            ..=40.0 => DM8006,
            _ => DM8009,
        };
        joint += 1;
    }
    scales
};
/// The angle that the drive of each joint reads at the joint's zero, rad. Its range is in
/// `scene.rs`.
pub const ZERO: [f32; N] = [0.0; N];
/// Which way each joint turns while its drive's angle increases.
pub const DRIVES: [Direction; N] = [Direction::Forward; N];

/// A count of the position, rad.
pub const RESOLUTION: f32 = 2.0 * 12.5 / 65_535.0;

/// The number of a joint's drive on the bus, its register ESC_ID: 1, 2, 3 and so on, from the base
/// to the tip. It replies as `0x10` and this, its register MST_ID.
pub const fn number(joint: usize) -> u8 {
    joint as u8 + 1
}

/// The drives on their bus.
pub type Joints<Bus> = CanJoints<Bus, Drive, N>;
/// The control loop of the robot.
pub type Control<Bus, Brake, D> =
    ControlLoop<On<Bus>, On<Bus>, Brake, N, D, Measured<PreviousTick>, Gains>;
type On<Bus> = &'static Joints<Bus>;

/// The connections of the board.
#[derive(Debug)]
pub struct Devices<Bus: 'static, Brake> {
    pub bus: Bus,
    /// The place of the drives.
    pub joints: &'static mut Option<Joints<Bus>>,
    /// A high level holds the joints.
    pub brake: Brake,
}

/// Plans the motion in its place.
///
/// # Errors
/// [`SetupError::Motion`], of way-points of your own.
pub fn plan(place: &mut Motion) -> Result<(), SetupError> {
    let planned = scene::motion().map_err(SetupError::Motion);
    planned.map(|motion| *place = motion)
}

/// The drive of a joint that can have the joint's greatest torque, or that of its motor.
fn drive(joint: usize, most: f32, mapping: EncoderMapping) -> Result<Drive, JointError<CanError>> {
    let (number, scale) = (number(joint), SCALES[joint]);
    let (host, most) = (0x10 + u16::from(number), most.min(scale.torque));
    let drive = Drive::new(number, host, scale, most, mapping);
    drive.map_err(|error| JointError { joint, error })
}

/// The loop of a robot that stands on its brake until `reset`.
///
/// # Errors
/// [`SetupError`].
pub fn on_brake<Bus: JointBus, Brake: OutputPin, D: Detect<f32, N>>(
    devices: Devices<Bus, Brake>,
    gains: Gains,
    detectors: D,
    motion: &Motion,
) -> Result<Control<Bus, Brake, D>, SetupError> {
    let controller = controller(motion)?.on_brake();
    let mappings = encoder_mappings(motion, &ZERO, &DRIVES)?;
    let torques = scene::limits(motion).torque;
    // A place in the array until each has its own.
    let first = drive(0, torques[0], mappings[0]).map_err(SetupError::Can)?;
    let mut drives = [first; N];
    for (joint, place) in drives.iter_mut().enumerate() {
        *place = drive(joint, torques[joint], mappings[joint]).map_err(SetupError::Can)?;
    }
    let Devices { bus, joints, brake } = devices;
    let on: &Joints<Bus> = joints.insert(CanJoints::new(bus, drives));
    let control = ControlLoop::on_circles(on, on, brake, gains, controller, detectors);
    Ok(control)
}

/// Says what is wrong on the bus, and starts a robot on its brake while the button is pressed.
#[derive(Debug)]
pub struct Operator {
    silence: Silence<N>,
    /// The drive that has not done what the button asks for, and since how many ticks.
    waits: Option<JointError<CanError>>,
    waited: u32,
    torques: Option<[f32; N]>,
}

/// Ticks of a second.
const SECOND: u32 = (1.0 / TICK) as u32;

impl Operator {
    pub fn new(motion: &Motion) -> Self {
        let torques = Some(scene::limits(motion).torque);
        Self { silence: Silence::new(SECOND), waits: None, waited: 0, torques }
    }

    /// After a tick that is not one of full operation; why the robot does not start.
    #[cold]
    #[inline(never)]
    pub fn tick<Bus: JointBus, Brake: OutputPin, D: Detect<f32, N>>(
        &mut self,
        (now, status): (u32, &Status),
        control: &mut Control<Bus, Brake, D>,
        motion: &Motion,
        is_pressed: bool,
        mut say: impl FnMut(Line),
    ) -> Option<ResetError> {
        if let Some(torques) = self.torques.take() {
            bus::advice(&torques, &mut say);
        }
        let drives: &Joints<Bus> = *control.encoders();
        let (unread, states) = (drives.unread(), drives.errors());
        let failed = control.encoder_error().map(|_| &unread);
        if let Some(silent) = self.silence.update(now, failed) {
            let sent = control.drive_error().map(|JointError { joint, error }| (joint, *error));
            bus::silent(&silent, &unread, sent, &mut say);
        }
        for (joint, state) in states.into_iter().enumerate() {
            match state {
                Ok(()) => {}
                // The button has not enabled it yet.
                Err(CanError::NotReady) if matches!(status.mode, Mode::Stopped) => {}
                Err(error) => say(bus::line(JointError { joint, error })),
            }
        }
        if !is_pressed || !self.silence.is_heard() {
            self.waited = 0;
            return None;
        }
        let asked = match drives.start_up() {
            Ok(true) => return control.reset(motion).err(),
            Ok(false) => None,
            Err(error) => Some(error),
        };
        let not_ready = states.iter().position(|state| *state == Err(CanError::NotReady));
        let of = |joint| JointError { joint, error: CanError::NotReady };
        let waits = asked.or(not_ready.map(of));
        self.waited = if self.waits == waits { self.waited + 1 } else { 0 };
        self.waits = waits;
        // A register is asked for in a tick or two, and a drive is then enabled.
        if let Some(waits) = waits.filter(|_| self.waited > SECOND / 10) {
            say(bus::line(waits));
        }
        None
    }
}
