//! Encoders and drives of the robot: their kinds, and how they are mounted. Adapt them to your
//! parts.
//!
//! `joint-drivers` has further kinds; its control loop takes all that implement `JointEncoder` and
//! `JointDrive`.

use embedded_hal::{digital::OutputPin, pwm::SetDutyCycle, spi::SpiDevice};
use joint_drivers::as5047p::{As5047p, FrameError};
use joint_drivers::h_bridge::{FullScale, LockedAntiphase};
use joint_drivers::{ControlLoop, Direction, EncoderType};
use motion_control::limits::Status;
use motion_control::{motion::ResetError, safety::Detect};

use crate::control::{Measured, controller, encoder_mappings};
use crate::say::Line;
use crate::scene;

pub use crate::control::{FeedForward as Law, Found, Gains, SetupError, detectors, gains};
pub use crate::scene::{Motion, N, TICK};
pub use joint_drivers::as5047p::RESOLUTION;

/// The angle that the encoder of each joint reads at the joint's zero, rad. Its range is in
/// `scene.rs`.
pub const ZERO: [f32; N] = [0.0; N];
/// Which way each joint turns while its encoder's angle increases.
pub const ENCODERS: [Direction; N] = [Direction::Forward; N];
/// Which way each joint turns under a duty above 50 %.
pub const DRIVES: [Direction; N] = [Direction::Forward; N];

/// The torque of each joint at a duty of 100 %, N·m or N: current limit times torque constant times
/// gear ratio. Here each drive is taken as one that delivers the joint's limit of torque: replace
/// it by the figures of your drives.
pub fn full_scale(motion: &Motion) -> [f32; N] {
    scene::limits(motion).torque
}

/// An absolute encoder at a joint.
pub type Encoder<Spi> = As5047p<Spi>;
/// A current-controlled drive: a duty of 50 % is zero torque.
pub type Drive<Pwm> = LockedAntiphase<Pwm>;
/// The control loop of the robot.
pub type Control<Spi, Pwm, Brake, D> =
    ControlLoop<[Encoder<Spi>; N], [Drive<Pwm>; N], Brake, N, D, Measured<Age<Spi>>, Gains>;
/// The age of its positions.
pub type Age<Spi> = <Encoder<Spi> as EncoderType>::Age;

/// The connections of the board: a part of the bus for each encoder, a PWM channel for each drive.
#[derive(Debug)]
pub struct Devices<Spi, Pwm, Brake> {
    pub encoders: [Spi; N],
    pub drives: [Pwm; N],
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

/// Says what is wrong with the devices, and starts a robot on its brake while the button is pressed.
/// Of the drives nothing is known: their enable input belongs to the emergency stop.
#[derive(Debug)]
pub struct Operator;

impl Operator {
    pub const fn new(_: &Motion) -> Self {
        Self
    }

    /// After a tick that is not one of full operation; why the robot does not start.
    #[cold]
    #[inline(never)]
    pub fn tick<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin, D: Detect<f32, N>>(
        &mut self,
        (_, _): (u32, &Status),
        control: &mut Control<Spi, Pwm, Brake, D>,
        motion: &Motion,
        is_pressed: bool,
        mut say: impl FnMut(Line),
    ) -> Option<ResetError> {
        if let Some(failed) = control.encoder_error() {
            say(Line::of(
                failed.joint,
                match failed.error {
                    FrameError::LostTurn => {
                        "its encoder may have turned unseen: stand it at its home and restart \
                         the board, or place_near of its encoder"
                    }
                    _ => "its encoder does not answer, or wrongly: supply, select, wires, magnet",
                },
            ));
        }
        let refused = || control.reset(motion).err();
        is_pressed.then(refused).flatten()
    }
}

/// The loop of a robot that stands on its brake until `reset`.
///
/// # Errors
/// [`SetupError`].
pub fn on_brake<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin, D: Detect<f32, N>>(
    devices: Devices<Spi, Pwm, Brake>,
    gains: Gains,
    detectors: D,
    motion: &Motion,
) -> Result<Control<Spi, Pwm, Brake, D>, SetupError> {
    let scales = FullScale::of(full_scale(motion)).map_err(SetupError::Drive)?;
    let controller = controller(motion)?.on_brake();
    let mappings = encoder_mappings(motion, &ZERO, &ENCODERS)?;
    // Each device in its turn.
    let mut joint = 0..N;
    let encoders = devices.encoders.map(|spi| {
        let joint = joint.next().unwrap_or_default();
        Encoder::new(spi, mappings[joint])
    });
    let mut joint = 0..N;
    let drives = devices.drives.map(|pwm| {
        let joint = joint.next().unwrap_or_default();
        Drive::new(pwm, scales[joint], DRIVES[joint])
    });
    Ok(ControlLoop::on_circles(encoders, drives, devices.brake, gains, controller, detectors))
}
