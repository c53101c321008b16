//! The drives of the robot: their kind, numbers and scales, and how they are mounted. Adapt them to
//! your parts.
//!
//! `joint-drivers` has further drives in MIT mode (`mit::robstride`, `mit::cubemars`), and moteus
//! and ODrive: all that implement `CanJoint`.

use core::mem::{replace, take};

use dynamics_core::model::Robot;
use embedded_can::nb::Can;
use embedded_hal::digital::OutputPin;
use joint_drivers::can::CanError;
use joint_drivers::mit::Scale;
use joint_drivers::mit::damiao::{DM4310, DM4340, DM6006, DM8006, DM8009, Damiao};
use joint_drivers::{
    CanJoints, ControlLoop, Direction, DriveFault, DriveFaultKind, EncoderMapping, JointError,
};
use motion_control::limits::{Mode, Status};
use motion_control::motion::{PreviousTick, ResetError};
use motion_control::{law::Gains, safety::Detect};

use crate::control::{Measured, controller, encoder_mappings};
use crate::say::Line;
use crate::scene::{self, Arm};

pub mod bus;

pub use crate::control::{FeedForward as Law, Found, SetupError, detectors, gains};
pub use crate::scene::{Motion, N, TICK};

/// A drive in MIT mode.
pub type Drive = Damiao;

/// The motor of each joint: the greatest position, velocity and torque of its counts, which are the
/// registers PMAX, VMAX and TMAX of the drive. Here it is the weakest motor that has the joint's
/// torque in the description: write down yours, such as `[DM4340, DM4340, DM4310]`.
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
    let Devices { bus, joints, brake } = devices;
    let on: &Joints<Bus> = joints.insert(CanJoints::new(bus, drives));
    let control = ControlLoop::on_circles(on, on, brake, gains, controller, detectors);
    Ok(control)
}

/// Lets the drives deliver torque: that of the last command, which is zero on the brake. Returns
/// whether all do, without an error: the first calls, one in each tick, clear the errors that a
/// drive keeps, and ask the drives for their scales and modes.
///
/// # Errors
/// The drive that has another scale than [`SCALES`] or another mode, or has no frame.
pub fn enable<Bus: Can>(drives: &Joints<Bus>) -> Result<bool, JointError<CanError>> {
    let has_failed = |state: &Result<(), CanError>| {
        state.is_err_and(|error| error.kind() == DriveFaultKind::Failed)
    };
    if let Some(joint) = drives.errors().iter().position(has_failed) {
        return drives.clear_errors(joint).map(|()| false);
    }
    drives.enable()?;
    Ok(drives.errors().iter().all(Result::is_ok))
}

/// Says what is wrong on the bus, and starts a robot on its brake while the button is pressed.
#[derive(Debug)]
pub struct Operator {
    /// The first tick of this second, and in how many since then each joint had no position.
    since: u32,
    unread: [u8; N],
    /// Ticks for which the same drive has not done what the button asks for.
    waited: u32,
    last: Option<JointError<CanError>>,
    advice: bool,
    torques: [f32; N],
}

/// Ticks of a second, and so many of them until a silence or a wait is said.
const SECOND: u32 = (1.0 / TICK) as u32;
const FEW: u8 = 3;
const LONG: u32 = SECOND / 10;

impl Operator {
    pub fn new(motion: &Motion) -> Self {
        Self {
            since: 0,
            unread: [0; N],
            waited: 0,
            last: None,
            advice: true,
            torques: scene::limits(motion).torque,
        }
    }

    /// After a tick that is not one of full operation; why the robot does not start.
    #[cold]
    #[inline(never)]
    pub fn tick<Bus: Can, Brake: OutputPin, D: Detect<f32, N>>(
        &mut self,
        now: u32,
        status: &Status,
        control: &mut Control<Bus, Brake, D>,
        motion: &Motion,
        is_pressed: bool,
        mut say: impl FnMut(Line),
    ) -> Option<ResetError> {
        if take(&mut self.advice) {
            bus::advice(&self.torques, &mut say);
        }
        let drives: &Joints<Bus> = *control.encoders();
        let (failed, sent) = (control.encoder_error().is_some(), control.drive_error());
        let is_heard = self.readings(now, drives, failed, sent, &mut say);
        let states = drives.errors();
        for (joint, state) in states.into_iter().enumerate() {
            match state {
                Ok(()) => {}
                // The button has not enabled it yet.
                Err(CanError::NotReady) if matches!(status.mode, Mode::Stopped) => {}
                Err(error) => say(bus::line(JointError { joint, error })),
            }
        }
        if !is_pressed || !is_heard {
            self.waited = 0;
            return None;
        }
        match enable(drives) {
            Ok(true) => return control.reset(motion).err(),
            // An error of this kind may last: the drive is asked again.
            Err(error) if !matches!(error.error, CanError::Missing(_)) => say(bus::line(error)),
            other => {
                let not_ready =
                    || states.iter().position(|state| *state == Err(CanError::NotReady));
                let of = |joint| JointError { joint, error: CanError::NotReady };
                let waits = other.err().or_else(|| not_ready().map(of));
                let is_same = replace(&mut self.last, waits) == waits && waits.is_some();
                self.waited = if is_same { self.waited.saturating_add(1) } else { 0 };
                if let Some(waits) = waits.filter(|_| self.waited > LONG) {
                    say(bus::line(waits));
                }
            }
        }
        None
    }

    /// Says which joints had no position a few times in this second, and returns whether none had.
    fn readings<Bus: Can>(
        &mut self,
        now: u32,
        drives: &Joints<Bus>,
        has_failed: bool,
        sent: Option<JointError<&CanError>>,
        say: &mut impl FnMut(Line),
    ) -> bool {
        if now.wrapping_sub(self.since) >= SECOND {
            (self.since, self.unread) = (now, [0; N]);
        }
        let unread = drives.unread();
        for (count, unread) in self.unread.iter_mut().zip(&unread).filter(|_| has_failed) {
            *count = count.saturating_add(unread.is_err().into());
        }
        let silent = self.unread.map(|count| count >= FEW);
        let is_heard = !silent.contains(&true);
        if is_heard || !has_failed {
            return is_heard;
        }
        // Without room none of the joints behind it is heard.
        let is_of_bus = |sent: &JointError<&CanError>| {
            let is_it = matches!(sent.error, CanError::Full | CanError::Bus(_));
            is_it && silent.iter().skip(sent.joint).all(|&silent| silent)
        };
        if let Some(JointError { joint, error: &error }) = sent.filter(is_of_bus) {
            say(bus::line(JointError { joint, error }));
        }
        let heard = silent.iter().rposition(|&silent| !silent).map_or(0, |last| last + 1);
        // Heard now, and not before.
        if (0..N).any(|joint| silent[joint] && unread[joint].is_ok()) {
            say(bus::LOSSY);
            return false;
        }
        let is_none = |joint: usize| unread[joint] == Err(CanError::NoReply);
        let is_cut = N - heard > 1 && (heard..N).all(is_none);
        if is_cut {
            say(if heard == 0 { bus::SILENT } else { bus::broken(heard) });
        }
        let one_by_one = 0..if is_cut { heard } else { N };
        for joint in one_by_one.filter(|&joint| silent[joint]) {
            if let Err(error) = unread[joint] {
                say(bus::line(JointError { joint, error }));
            }
        }
        false
    }
}
