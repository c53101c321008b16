//! Scene `so101_teach`: an SO-101 follows a path that it was taught, under feed-forward as a duty
//! and under its servos' own position loops.
//!
//! A servo takes no torque. In its PWM mode it takes the duty d of the supply voltage U, and with
//! k_t and R at the joint its torque is τ = k_t (d U − k_t q̇) / R. Commands of the control loop
//! are here u = k_t d U / R, the torque of a duty at rest, so that feed-forward is u = τ + k_t² q̇
//! / R.
//!
//! # Sources
//!
//! - Servo: PyPI better-actuator-models 1.0.2 (Apache-2.0), identified on a pendulum:
//!   `params/feetech_sts3215_7_4V/m1.json` ([`TORQUE_CONSTANT`], [`RESISTANCE`], [`ARMATURE`],
//!   [`COULOMB`], [`VISCOUS`]) and `feetech/actuator.py` ([`SUPPLY`], [`MAX_DUTY`], [`MAX_SPEED`],
//!   [`SERVO_GAIN`], of its highest gain 32).
//! - Load-dependent friction: model M1 has none. [`LOAD`] is the M3 of the same package for the
//!   MX-106, of its servos with that term the one with the nearest armature (0.0248 to 0.0284
//!   kg·m²).
//! - The bus is half-duplex at 1 Mbit/s, ten bits per byte. A synchronous read of six positions
//!   takes 14 bytes and six answers of 8, a synchronous write of six duties 26: 88 bytes, 0.88 ms,
//!   and the servos' delays of response, at least 2 µs each (FT-SCS protocol of Feetech). 1 kHz
//!   leaves a tenth of the bus for delays and repetitions: the tick is 2 ms.
//! - Encoder: 12 bits per turn; duty: steps of 0.1 % (control table of the STS3215).
//!
//! The width of the smooth sign, path and gains are chosen, not measured.

use dynamics_core::Engine;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, LoadFriction, Viscous, Width,
};
use dynamics_core::model::{JointLimits, Robot};
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use motion_control::estimate::Estimate;
use motion_control::law::Gains;
use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};

use crate::plant::ServoPlant;
use crate::scene::{Noise, PlantModel, Run, Scene, limits_of, rigid, speeds};
use crate::trajectories::{SO101_START, stop};
use joint_drivers::Law;

/// A path that the SO-101 is taught: to a part, down, the jaw closes, up, over, down, and back;
/// ticks of 2 ms.
const TAUGHT: [WayPoint<f32, 6>; 8] = [
    stop(SO101_START, 0),
    stop([-0.6, -0.2, 0.5, 0.9, 0.4, 1.2], 600),
    stop([-0.6, 0.3, 0.3, 0.8, 0.4, 1.2], 350),
    stop([-0.6, 0.3, 0.3, 0.8, 0.4, 0.2], 350),
    stop([-0.6, -0.3, 0.6, 0.9, 0.4, 0.2], 350),
    stop([0.8, -0.2, 0.5, 0.9, -0.5, 0.2], 700),
    stop([0.8, 0.3, 0.2, 0.8, -0.5, 0.9], 400),
    stop(SO101_START, 850),
];

/// Torque constant and back-EMF constant at the joint, N·m/A and V·s/rad.
pub const TORQUE_CONSTANT: f32 = 1.211_641_4;
/// Resistance, Ω.
pub const RESISTANCE: f32 = 2.676_166_3;
/// Inertia of the rotor at the joint, kg·m².
pub const ARMATURE: f32 = 0.028_403_364;
/// Sliding friction, N·m.
pub const COULOMB: f32 = 0.052_392_96;
/// Viscous friction, N·m·s/rad.
pub const VISCOUS: f32 = 0.059_085_156;
/// Friction per torque of the motor and per torque of the load.
pub const LOAD: f32 = 0.108_240_37;
/// Supply, V.
pub const SUPPLY: f32 = 7.4;
pub const MAX_DUTY: f32 = 0.97;
/// The greatest speed of the servo's own set-point, rad/s: 3400 counts/s.
pub const MAX_SPEED: f32 = 3400.0 * RESOLUTION;
/// Duty per error of position in the servo's own loop, 1/rad.
pub const SERVO_GAIN: f32 = 32.0 * 0.166;
/// Resolution of the encoder, rad.
pub const RESOLUTION: f32 = core::f32::consts::TAU / 4096.0;

/// Torque at rest per duty, N·m.
pub const STALL: f32 = TORQUE_CONSTANT * SUPPLY / RESISTANCE;
/// Torque that the back-EMF takes per speed, N·m·s/rad.
pub const BACK_EMF: f32 = TORQUE_CONSTANT * TORQUE_CONSTANT / RESISTANCE;

pub type Effects = (
    Gravity,
    Inertia,
    Coriolis,
    Viscous<f32, 6>,
    Coulomb<f32, 6>,
    Armature<f32, 6>,
    LoadFriction<f32, 6>,
);

const DRY: Coulomb<f32, 6> = Coulomb { torque: [COULOMB; 6], width: Width::f32(0.05) };
/// [`LoadFriction::of_motor_and_load`] of [`LOAD`] for both.
const GEARS: LoadFriction<f32, 6> = LoadFriction {
    driving: [2.0 * LOAD / (1.0 - LOAD); 6],
    backdriving: [2.0 * LOAD / (1.0 + LOAD); 6],
    width: DRY.width,
};

/// The effects whose compensation lets a hand move the arm without effort at any speed.
pub type Compensation = (Gravity, Viscous<f32, 6>, Coulomb<f32, 6>, LoadFriction<f32, 6>);

/// The compensation of this arm; the back-EMF is viscous friction of the command, and not part of
/// it.
pub const COMPENSATION: Compensation = (Gravity::EARTH, Viscous([VISCOUS; 6]), DRY, GEARS);

/// Commands from torques: what the back-EMF takes is added.
#[inline(always)]
pub fn with_back_emf(mut torque: [f32; 6], velocity: &[f32; 6]) -> [f32; 6] {
    for (torque, velocity) in torque.iter_mut().zip(velocity) {
        *torque += BACK_EMF * velocity;
    }
    torque
}

#[derive(Clone, Copy, Debug)]
pub struct TaughtPath;

impl Scene<6, 6, 6, 6> for TaughtPath {
    type Robot = So101;
    type Effects = Effects;
    type Reference = Trajectory<f32, 6, 8>;
    type Environment = ();
    type Plant = ServoPlant<So101, Effects, 6>;

    const NAME: &'static str = "so101_teach";
    const BOUND: f32 = 3e-3;
    const EFFECTS: Effects =
        (Gravity::EARTH, Inertia, Coriolis, COMPENSATION.1, DRY, Armature([ARMATURE; 6]), GEARS);
    const TICK: f32 = 2e-3;
    const RESOLUTION: f32 = RESOLUTION;
    const GAIN_POSE_NAME: &'static str = "half a rotor's inertia";
    /// Those of the source, with the torque and speed of the servo.
    const LIMITS: [JointLimits<f32>; 6] = {
        let mut limits = limits_of(&So101::MODEL, [0, 1, 2, 3, 4, 5]);
        let mut j = 0;
        while j < 6 {
            (limits[j].velocity, limits[j].torque) = (MAX_SPEED, MAX_DUTY * STALL);
            j += 1;
        }
        limits
    };
    const BASELINES: &'static [Run<Self, 6, 6, 6, 6>] = &[
        Run::of::<PositionLoop>(PlantModel::Exact, "position-loop"),
        Run::of::<PositionLoop>(PlantModel::Mismatched, "position-loop"),
        Run::of::<GravityAndFriction>(PlantModel::Exact, "gravity-and-friction"),
        Run::of::<GravityAndFriction>(PlantModel::Mismatched, "gravity-and-friction"),
        Run::of::<GravityOnly>(PlantModel::Exact, "gravity"),
        Run::of::<GravityOnly>(PlantModel::Mismatched, "gravity"),
    ];

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        Trajectory::new(&TAUGHT, Self::TICK, &speeds(&Self::LIMITS, [30.0; 6]))
    }

    fn environment(_: &Self::Reference, _: f32) {}

    fn inverse<E: Effect<f32, 6, 6>>(
        reference: &State<f32, 6, 6>,
        (): &(),
        effects: &E,
    ) -> [f32; 6] {
        with_back_emf(Engine::<So101>::rnea(reference, effects), &reference.qd)
    }

    fn plant(mut noise: Option<&mut Noise>) -> Self::Plant {
        let (mut gain, mut back_emf) = ([1.0; 6], [BACK_EMF; 6]);
        if let Some(noise) = noise.as_deref_mut() {
            noise.friction(&mut gain);
            noise.friction(&mut back_emf);
        }
        ServoPlant {
            arm: rigid::<Self, 6, 6, 6, 6>(
                SO101_START,
                noise,
                |(.., viscous, coulomb, _, gears), noise| {
                    noise.friction(&mut viscous.0);
                    noise.friction(&mut coulomb.torque);
                    noise.friction(&mut gears.driving);
                    noise.friction(&mut gears.backdriving);
                },
            ),
            gain,
            back_emf,
            step: 1e-3 * STALL,
            resolution: RESOLUTION,
        }
    }

    /// Half a rotor's: a K_p of half of what the servo's own loop has.
    fn inertia((): &()) -> [f32; 6] {
        [0.5 * ARMATURE; 6]
    }
}

/// The servo's own position loop, whose set-points are the reference.
#[derive(Clone, Copy, Debug)]
pub struct PositionLoop;

impl Law<6> for PositionLoop {
    const ACCELERATES: bool = false;

    fn feedforward(_: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
        [0.0; 6]
    }

    fn torque(
        _: &Gains<f32, 6>,
        reference: &State<f32, 6, 6>,
        estimate: &Estimate<f32, 6>,
        (): &(),
    ) -> [f32; 6] {
        core::array::from_fn(|j| SERVO_GAIN * STALL * (reference.q[j] - estimate.q[j]))
    }
}

/// Gravity compensation with friction, of a motion without acceleration.
#[derive(Clone, Copy, Debug)]
pub struct GravityAndFriction;

impl Law<6> for GravityAndFriction {
    const ACCELERATES: bool = false;

    fn feedforward(reference: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
        with_back_emf(Engine::<So101>::rnea(reference, &COMPENSATION), &reference.qd)
    }
}

#[derive(Clone, Copy, Debug)]
pub struct GravityOnly;

impl Law<6> for GravityOnly {
    const ACCELERATES: bool = false;

    fn feedforward(reference: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
        with_back_emf(Engine::<So101>::rnea(reference, &Gravity::EARTH), &reference.qd)
    }
}
