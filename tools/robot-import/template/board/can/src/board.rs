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
use motion_control::{Detect, Gains, PreviousTick};

use crate::control::{Measured, controller, encoder_mappings};
use crate::scene;

pub use crate::control::{FeedForward as Law, Found, SetupError, detectors, gains};
pub use crate::scene::{Motion, N, TICK};

/// A drive in MIT mode.
pub type Drive = Damiao;

/// The motor of each joint: the greatest position, velocity and torque of its counts, which are the
/// registers PMAX, VMAX and TMAX of the drive.
pub const SCALES: [Scale; N] = [DM4310; N];
/// The number of each drive on the bus, its register ESC_ID; it replies as `0x10` and this, its
/// register MST_ID.
pub const NUMBERS: [u8; N] = numbers();
/// The angle that the drive of each joint reads at the joint's zero, rad. Its range is in
/// `scene.rs`.
pub const ZERO: [f32; N] = [0.0; N];
/// Which way each joint turns while its drive's angle increases.
pub const DRIVES: [Direction; N] = [Direction::Forward; N];

/// A count of the position, rad.
pub const RESOLUTION: f32 = 2.0 * 12.5 / 65_535.0;

/// 1, 2, 3 and so on, from the base to the tip.
const fn numbers() -> [u8; N] {
    let mut numbers = [1; N];
    let mut joint = 1;
    while joint < N {
        numbers[joint] = numbers[joint - 1] + 1;
        joint += 1;
    }
    numbers
}

/// The drives on their bus.
pub type Joints<Bus> = CanJoints<Bus, Drive, N>;
/// The control loop of the robot.
pub type Control<Bus, Brake, D> =
    ControlLoop<&'static Joints<Bus>, &'static Joints<Bus>, Brake, N, D, Measured<PreviousTick>>;

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
    *place = scene::motion().map_err(SetupError::Motion)?;
    Ok(())
}

/// The drive of a joint that can have the joint's greatest torque, or that of its motor.
fn drive(joint: usize, most: f32, mapping: EncoderMapping) -> Result<Drive, JointError<CanError>> {
    let number = NUMBERS[joint];
    let most = most.min(SCALES[joint].torque);
    let drive = Drive::new(
        number,
        0x10 + u16::from(number),
        SCALES[joint],
        most,
        mapping,
    );
    drive.map_err(|error| JointError { joint, error })
}

/// The loop of a robot that stands on its brake until `reset`.
///
/// # Errors
/// [`SetupError`].
pub fn on_brake<Bus: Can, Brake: OutputPin, D: Detect<f32, N>>(
    devices: Devices<Bus, Brake>,
    gains: Gains<f32, N>,
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
    let joints: &Joints<Bus> = devices.joints.insert(CanJoints::new(devices.bus, drives));
    Ok(ControlLoop::on_circles(
        joints,
        joints,
        devices.brake,
        gains,
        controller,
        detectors,
    ))
}

/// Lets the drives deliver torque: that of the last command, which is zero on the brake.
pub fn enable<Bus: Can>(drives: &mut &'static Joints<Bus>) {
    // A drive that is not enabled says so in its next reply.
    let _ = drives.enable();
}
