//! The law of the robot, and its control loop: `tick` of it reads, computes, limits and writes.

use core::fmt;

use dynamics_core::state::State;
use embedded_hal::{digital::OutputPin, pwm::SetDutyCycle, spi::SpiDevice};
use joint_drivers::{ControlLoop, Law};
use motion_control::{
    ConfigError, Gains, MotionController, MotionControllerConfig, SupervisorConfig, TrajectoryError,
};

use crate::board::{Drive, Encoder, RESOLUTION};
use crate::scene::{self, Motion, N, OMEGA_N, TICK};

/// The model's torque, and feedback for what it does not know.
#[derive(Clone, Copy, Debug)]
pub struct FeedForward;

impl Law<N> for FeedForward {
    fn feedforward(reference: &State<f32, N, N>, (): &()) -> [f32; N] {
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
        observer_bandwidth: 10.0 * OMEGA_N,
        decay_rate: OMEGA_N,
        restart_distance: 0.15,
    }
}

/// The control loop: call its `tick` or `tick_at` from a timer interrupt.
pub type Control<Spi, Pwm, Brake> = ControlLoop<[Encoder<Spi>; N], [Drive<Pwm>; N], Brake, N>;

/// The loop of a robot that holds its position at the start of the motion. High at the brake holds the joints.
///
/// # Errors
/// [`SetupError::Limits`].
pub fn control<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin>(
    encoders: [Encoder<Spi>; N],
    drives: [Drive<Pwm>; N],
    brake: Brake,
    motion: &Motion,
) -> Result<Control<Spi, Pwm, Brake>, SetupError> {
    with_inertia(encoders, drives, brake, motion, &scene::inertia())
}

/// The same with gains of other inertias, kg·m² or kg, for motions that go elsewhere.
///
/// # Errors
/// [`SetupError::Limits`].
pub fn with_inertia<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin>(
    encoders: [Encoder<Spi>; N],
    drives: [Drive<Pwm>; N],
    brake: Brake,
    motion: &Motion,
    inertia: &[f32; N],
) -> Result<Control<Spi, Pwm, Brake>, SetupError> {
    let controller = MotionController::try_new(config(motion)).map_err(SetupError::Limits)?;
    let gains = Gains::from_inertia(inertia, OMEGA_N, 1.0);
    Ok(ControlLoop::new(
        encoders,
        drives,
        brake,
        gains,
        controller,
        (),
    ))
}

/// The motion or the limits in `scene.rs` are impossible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SetupError {
    /// The motion.
    Motion(TrajectoryError),
    /// The limits.
    Limits(ConfigError),
}

impl fmt::Display for SetupError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motion(error) => write!(out, "the motion in scene.rs: {error}"),
            Self::Limits(error) => write!(out, "the limits in scene.rs: {error}"),
        }
    }
}

impl core::error::Error for SetupError {}
