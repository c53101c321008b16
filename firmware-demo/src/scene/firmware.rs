//! The control loop that follows from a scene's data sheet, whatever its devices are.

use core::fmt;

use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;
use joint_drivers::as5047p::As5047p;
use joint_drivers::h_bridge::{DriveError, FullScale, LockedAntiphase};
use joint_drivers::{ControlLoop, Direction, JointMapping, JointRange, MappingError};
use motion_control::law::Gains;
use motion_control::limits::SafetyLimits;
use motion_control::motion::{MotionController, MotionControllerConfig};
use motion_control::safety::{Detect, SupervisorConfig};

use super::Scene;

/// A tick, s, unless a scene sets another one.
pub const TICK: f32 = 1e-3;
/// Natural frequency of the feedback on M's diagonal, rad/s.
pub const OMEGA_N: f32 = core::f32::consts::TAU * 4.0;
/// Damping ratio of the same.
pub const ZETA: f32 = 1.0;
/// Bandwidth of the observer, rad/s.
const OBSERVER: f32 = core::f32::consts::TAU * 40.0;
/// Ticks that a fault is ridden through.
pub const RIDE: u32 = 5;
/// Ticks of bringing the arm to rest before a fault stops it.
pub const HOLD: u32 = 100;
/// Ticks of the return to the trajectory after a fault.
pub const REENTRY: u32 = 200;
/// Ticks that a torque may be at its limit, for those who detect it.
pub(super) const SATURATED: u32 = 50;
/// The largest distance of a joint from its reference for a restart, rad or m.
pub const NEAR: f32 = 0.15;

/// The state of an arm when its loop starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// At rest at the start of its trajectory, and held there by torque.
    OnTrajectory,
    /// On its brake, until [`ControlLoop::reset`].
    OnBrake,
}

/// The reason why the devices of a scene are impossible.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// A torque limit is no full scale of a drive.
    Drive(DriveError),
    /// A speed limit is no step of an encoder.
    Encoder(MappingError),
}

impl fmt::Display for SetupError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Drive(error) => error.fmt(out),
            Self::Encoder(error) => error.fmt(out),
        }
    }
}

impl core::error::Error for SetupError {}

/// The devices of a control loop.
#[derive(Debug)]
pub struct Devices<Spi, Pwm, Brake, const N: usize> {
    pub encoders: [Spi; N],
    pub drives: [Pwm; N],
    /// The brake; high holds.
    pub brake: Brake,
}

/// The control loop of a scene on AS5047P encoders and drives in locked antiphase.
pub type SceneLoop<Spi, Pwm, Brake, const N: usize, D = ()> =
    ControlLoop<[As5047p<Spi>; N], [LockedAntiphase<Pwm>; N], Brake, N, D>;

/// [`ControlLoop::new`] on the devices of a scene.
pub(super) type New<Spi, Pwm, Brake, const N: usize, D> = fn(
    [As5047p<Spi>; N],
    [LockedAntiphase<Pwm>; N],
    Brake,
    Gains<f32, N>,
    MotionController<f32, N>,
    D,
) -> SceneLoop<Spi, Pwm, Brake, N, D>;

/// The loop of a scene, by `new`: [`Scene::control_loop`].
#[inline(always)]
pub(super) fn control_loop<
    S,
    Spi,
    Pwm,
    Brake,
    D,
    const B: usize,
    const Q: usize,
    const V: usize,
    const N: usize,
>(
    devices: Devices<Spi, Pwm, Brake, N>,
    gains: Gains<f32, N>,
    detectors: D,
    start: Start,
    new: New<Spi, Pwm, Brake, N, D>,
) -> Result<SceneLoop<Spi, Pwm, Brake, N, D>, SetupError>
where
    S: Scene<B, Q, V, N>,
    Spi: SpiDevice,
    Pwm: SetDutyCycle,
    Brake: OutputPin,
    D: Detect<f32, N>,
{
    let Devices { encoders, drives, brake } = devices;
    let scales = FullScale::of(S::LIMITS.map(|limit| limit.torque)).map_err(SetupError::Drive)?;
    // The plants start within half a turn of zero. One mapping for all joints, with the speed of
    // the fastest, takes less stack than one for each.
    let fastest = S::LIMITS.iter().fold(0.0_f32, |most, limit| most.max(limit.velocity));
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), fastest * S::TICK);
    let mapping = mapping.map_err(SetupError::Encoder)?;
    let mut joint = 0;
    let drives = drives.map(|pwm| {
        let drive = LockedAntiphase::new(pwm, scales[joint], Direction::Forward);
        joint += 1;
        drive
    });
    let controller = MotionController::new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: SafetyLimits::from(S::LIMITS).with_rate_share(0.5),
            tick: S::TICK,
            resolution: S::RESOLUTION,
            ride_through_ticks: RIDE,
            hold_ticks: HOLD,
            reentry_ticks: REENTRY,
        },
        observer_bandwidth: OBSERVER,
        // Half of what K_d does: at full speed the torques for more are not to be had.
        decay_rate: ZETA * OMEGA_N,
        restart_distance: NEAR,
    });
    let controller = match start {
        Start::OnTrajectory => controller,
        Start::OnBrake => controller.on_brake(),
    };
    let encoders = encoders.map(|spi| As5047p::new(spi, mapping));
    Ok(new(encoders, drives, brake, gains, controller, detectors))
}
