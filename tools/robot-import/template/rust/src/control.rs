//! The parts of the control loop of `joint-drivers`: the law, its gains, the controller with its
//! limits, and detectors.

use core::f32::consts::TAU;
use core::fmt;

use dynamics_core::effects::Effect;
use dynamics_core::state::State;
use joint_drivers::can::CanError;
use joint_drivers::h_bridge::DriveError;
use joint_drivers::{Direction, EncoderMapping, JointError, JointMapping, Law, MappingError};
use motion_control::law::AccelerationGains;
use motion_control::limits::ConfigError;
use motion_control::motion::{MeasurementAge, MotionController, MotionControllerConfig, OnCircles};
use motion_control::reference::TrajectoryError;
use motion_control::safety::{
    Detectors, FrozenEncoder, ReferenceStep, Saturation, SupervisorConfig,
};

use crate::board::RESOLUTION;
use crate::scene::{self, Effects, Motion, N, OMEGA_N, TICK};

/// Measurements of this age, on the circles of `scene.rs`.
pub type Measured<Age> = OnCircles<{ scene::CIRCLES.bits() }, Age>;
/// The detectors of faults, on these circles.
pub type Found = Detectors<f32, N, { scene::CIRCLES.bits() }>;

/// The model's torque for the acceleration of the reference and that of the feedback.
#[derive(Clone, Copy, Debug)]
pub struct FeedForward;

impl Law<N, (), Gains> for FeedForward {
    fn feedforward(reference: &State<f32, N, N>, (): &()) -> [f32; N] {
        // Without M there would be no feedback.
        const {
            assert!(
                <Effects as Effect<f32, N, N>>::ACCELERATIONS,
                "EFFECTS in scene.rs need Inertia"
            )
        };
        scene::inverse_dynamics(reference)
    }
}

/// The numbers of the safety gate and the observer.
pub fn config(motion: &Motion) -> MotionControllerConfig<f32, N> {
    MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: scene::limits(motion),
            tick: TICK,
            resolution: RESOLUTION,
            ride_through_ticks: 5,
            hold_ticks: 100,
            reentry_ticks: 200,
        },
        observer_bandwidth: 250.0,
        decay_rate: 25.0,
        restart_distance: 0.15,
    }
}

/// The controller, of a robot that holds its position at the start of the motion; `on_brake` of it
/// is for one that does not.
///
/// # Errors
/// [`SetupError::Limits`].
pub fn controller<A: MeasurementAge>(
    motion: &Motion,
) -> Result<MotionController<f32, N, Measured<A>>, SetupError> {
    MotionController::try_new(config(motion)).map_err(SetupError::Limits)
}

/// The mounting of the encoders: the angle of each at its joint's zero, rad, and which way the
/// joint turns while its angle increases.
///
/// # Errors
/// [`SetupError::Encoder`] names the joint.
pub fn encoder_mappings(
    motion: &Motion,
    zero: &[f32; N],
    directions: &[Direction; N],
) -> Result<[EncoderMapping; N], SetupError> {
    let (speed, ratios) = (scene::limits(motion).speed, scene::encoder_ratios());
    let mut mappings = [JointMapping::IDENTITY; N];
    let mut steps = [0.0; N];
    for joint in 0..N {
        let ratio = ratios[joint];
        let mapping = JointMapping::new(zero[joint], directions[joint], 1.0 / ratio);
        mappings[joint] =
            mapping.map_err(|error| SetupError::Encoder(JointError { joint, error }))?;
        // A joint without a limit of speed is taken to turn its encoder by a quarter turn in a
        // tick.
        steps[joint] = (speed[joint] * TICK).min(0.25 * TAU * ratio);
    }
    let ranges = scene::encoder_ranges();
    EncoderMapping::of(mappings, ranges, steps).map_err(SetupError::Encoder)
}

/// Gains of accelerations, which the model turns into torques. A law whose gains are N·m/rad has
/// `motion_control::law::Gains<f32, N>` here.
pub type Gains = AccelerationGains<f32, N>;

/// The gains of the feedback, 1/s² and 1/s.
pub fn gains() -> Gains {
    Gains::new(OMEGA_N, 1.0)
}

/// The detectors of faults beside the controller: an encoder that does not change in ten steps of
/// its reference, a reference that moves at twice the limit of speed, torques at their limits for
/// 50 ticks.
pub fn detectors(motion: &Motion) -> Found {
    let limits = scene::limits(motion);
    Detectors {
        frozen: FrozenEncoder::new(
            scene::encoder_ratios().map(|ratio| 10.0 * RESOLUTION * ratio),
            3,
        ),
        steps: ReferenceStep::new(limits.speed.map(|speed| 2.0 * speed * TICK)),
        saturation: Saturation::new(limits.torque, 50),
    }
    .on_circles()
}

/// The motion or the limits in `scene.rs`, or the devices in `board.rs`, are impossible.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// The trajectory is impossible.
    Motion(TrajectoryError),
    /// The limits are impossible.
    Limits(ConfigError),
    /// The mounting of an encoder.
    Encoder(JointError<MappingError>),
    /// The full scale of a drive.
    Drive(DriveError),
    /// A drive on CAN.
    Can(JointError<CanError>),
}

impl fmt::Display for SetupError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motion(error) => write!(out, "the motion in scene.rs: {error}"),
            Self::Limits(error) => write!(out, "the limits in scene.rs: {error}"),
            Self::Encoder(error) => write!(out, "the encoders in board.rs: {error}"),
            Self::Drive(error) => write!(out, "the drives in board.rs: {error}"),
            Self::Can(error) => write!(out, "the drives in board.rs: {error}"),
        }
    }
}

impl core::error::Error for SetupError {}
