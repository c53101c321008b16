//! The drives of the robot: their kind, numbers and scales, and how they are mounted. Adapt them to
//! your parts.
//!
//! `joint-drivers` has further drives in MIT mode (`mit::robstride`, `mit::cubemars`), and moteus
//! and ODrive: all that implement `CanJoint`.

use embedded_can::nb::Can;
use embedded_hal::digital::OutputPin;
use joint_drivers::can::CanError;
use joint_drivers::mit::Scale;
use joint_drivers::mit::damiao::{DM4310, Damiao};
use joint_drivers::{CanJoints, ControlLoop, Direction, EncoderMapping, JointError};
use motion_control::{motion::PreviousTick, safety::Detect};

use crate::control::{Gains, Measured, controller, encoder_mappings};
use crate::scene;

pub use crate::control::{FeedForward as Law, Found, SetupError, detectors, gains};
pub use crate::scene::{Motion, N, TICK};

/// A drive in MIT mode.
pub type Drive = Damiao;

/// The motor of each joint: the greatest position, velocity and torque of its counts, which are the
/// registers PMAX, VMAX and TMAX of the drive.
pub const SCALES: [Scale; N] = [DM4310; N];
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
pub fn on_brake<Bus: Can, Brake: OutputPin, D: Detect<f32, N>>(
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

/// Lets the drives deliver torque: that of the last command, which is zero on the brake. Returns
/// whether they do: the first calls, one in each tick, ask them for their scales.
///
/// # Errors
/// [`SetupError::Can`]: a drive has another scale than [`SCALES`], or has no frame.
pub fn enable<Bus: Can>(drives: &mut &'static Joints<Bus>) -> Result<bool, SetupError> {
    match drives.enable() {
        Err(error) if matches!(error.error, CanError::Missing(_)) => Ok(false),
        enabled => enabled.map(|()| true).map_err(SetupError::Can),
    }
}
