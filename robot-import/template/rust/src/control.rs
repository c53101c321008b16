//! One tick: read, compute, limit, write.

use core::fmt;

use motion_control::{
    Command, ConfigError, CurrentTick, Estimate, Gains, MotionController, MotionControllerConfig,
    SupervisorConfig, TrajectoryError, feedback,
};
use dynamics_core::state::State;
use embedded_hal::{digital::OutputPin, pwm::SetDutyCycle, spi::SpiDevice};

use crate::board::{Board, RESOLUTION};
use crate::scene::{self, Motion, N, OMEGA_N, TICK};

/// The torque for a reference and an estimate of the joints, N·m or N.
pub type Law = fn(&Gains<f32, N>, &State<f32, N, N>, &Estimate<f32, N>) -> [f32; N];

/// The model's torque, and feedback for what it does not know.
pub fn feed_forward(
    gains: &Gains<f32, N>,
    reference: &State<f32, N, N>,
    estimate: &Estimate<f32, N>,
) -> [f32; N] {
    let (model, pd) = (
        scene::inverse_dynamics(reference),
        feedback(gains, reference, estimate),
    );
    core::array::from_fn(|joint| model[joint] + pd[joint])
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

/// The reference, the gains and the safety gate of the robot.
#[derive(Debug)]
pub struct Control {
    controller: MotionController<f32, N, CurrentTick>,
    /// The reference.
    pub motion: Motion,
    gains: Gains<f32, N>,
}

impl Control {
    /// Of a robot that holds its position at the start of the motion.
    ///
    /// # Errors
    /// [`SetupError`]: a motion or limits that are impossible.
    pub fn new() -> Result<Self, SetupError> {
        let motion = scene::motion().map_err(SetupError::Motion)?;
        let config = config(&motion);
        Ok(Self {
            controller: MotionController::try_new(config).map_err(SetupError::Limits)?,
            motion,
            gains: Gains::from_inertia(&scene::inertia(), OMEGA_N, 1.0),
        })
    }

    /// One tick. Call it from a timer interrupt.
    #[inline(never)]
    pub fn tick<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin>(
        &mut self,
        board: &mut Board<Spi, Pwm, Brake>,
        law: Law,
    ) -> Command<f32, N> {
        let measured = board.positions();
        let gains = &self.gains;
        let command = self.controller.tick(
            measured.as_ref().map_err(|&fault| fault),
            &self.motion,
            |reference, estimate| law(gains, reference, estimate),
        );
        if let Err(fault) = board.drive(&command) {
            self.controller.stop(fault);
        }
        command
    }
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
