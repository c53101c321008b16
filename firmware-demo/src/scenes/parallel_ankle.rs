//! Scene `parallel_ankle`: the leg of a humanoid steps in the air, and two motors tilt its foot by
//! rods. The encoders are at the motors, and the trajectory is that of the foot.

use dynamics_core::Engine;
use dynamics_core::clusters::{Clustered, MotorTorques};
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, JointState, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::{JointLimits, Robot};
use dynamics_core::state::State;
use motion_control::limits::MotionLimits;
use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};

use crate::plant::ClusterPlant;
use crate::robots::{G1Ankle, SerialAnkle};
use crate::scene::clustered::{self, MotorReference};
use crate::scene::{Noise, PlantModel, Run, Scene, TICK, limits_of};
use crate::trajectories::{MID_STANCE, pass, stop};
use joint_drivers::Law;

/// Two steps of a humanoid's leg in the air: knee, pitch and roll of the ankle. The heel rises, the
/// leg swings, the heel comes down, and the foot follows the ground; it rolls to the left in the
/// first and to the right in the second.
const ANKLE_STEPS: [WayPoint<f32, 3>; 11] = [
    stop(MID_STANCE, 0),
    pass([0.75, 0.40, 0.08], [4.0, 0.0, 0.0], 220),
    pass([1.10, -0.05, 0.15], [0.0, -2.0, 0.0], 150),
    stop([0.08, -0.10, 0.06], 280),
    stop([0.30, 0.15, -0.06], 130),
    stop(MID_STANCE, 220),
    pass([0.75, 0.40, -0.08], [4.0, 0.0, 0.0], 220),
    pass([1.10, -0.05, -0.15], [0.0, -2.0, 0.0], 150),
    stop([0.08, -0.10, -0.06], 280),
    stop([0.30, 0.15, 0.06], 130),
    stop(MID_STANCE, 220),
];

pub type Effects = (Gravity, Inertia, Coriolis, Viscous<f32, 9>, Coulomb<f32, 9>, Armature<f32, 9>);

/// The effects' numbers, of knee and cranks.
///
/// The motors' rotors are those of mujocolab/mjlab, `g1_constants.py`: the inertias of rotors and
/// gears by the squares of their ratios. Friction is assumed, of the size in MuJoCo descriptions of
/// such legs.
pub const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous(at_motors([0.2, 0.05])),
    Coulomb { torque: at_motors([1.0, 0.2]), width: Width::f32(0.05) },
    Armature(at_motors(ROTORS)),
);

/// Rotor inertias of the knee's motor and of each of the ankle's, kg·m².
const ROTORS: [f32; 2] = [0.025_101_925, 0.003_609_725];

/// A number of the knee's motor and of each of the ankle's.
const fn at_motors([knee, ankle]: [f32; 2]) -> [f32; 9] {
    let mut all = [0.0; 9];
    let [of_knee, left, right] = G1Ankle::MOTORS;
    all[of_knee] = knee;
    all[left] = ankle;
    all[right] = ankle;
    all
}

#[derive(Clone, Copy, Debug)]
pub struct AnkleSteps;

impl Scene<9, 9, 9, 3> for AnkleSteps {
    type Robot = G1Ankle;
    type Effects = Effects;
    type Reference = MotorReference<G1Ankle, Trajectory<f32, 3, 11>, 9, 9>;
    /// The reference of knee and foot: y, ẏ and ÿ.
    type Environment = State<f32, 3, 3>;
    type Plant = ClusterPlant<G1Ankle, Effects, 9, 9, 3>;

    const NAME: &'static str = "parallel_ankle";
    const BOUND: f32 = 2e-3;
    const EFFECTS: Effects = EFFECTS;
    const CONSTANT_EFFECTS: bool = true;
    const GAIN_POSE_NAME: &'static str = "mid-stance";
    const LIMITS: [JointLimits<f32>; 3] = limits_of(&G1Ankle::MODEL, G1Ankle::MOTORS);
    const BASELINES: &'static [Run<Self, 9, 9, 9, 3>] =
        &[Run::of::<SerialJoints>(PlantModel::Exact, "serial-ankle")];

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        let limit = |velocity, acceleration| MotionLimits { velocity, acceleration };
        let limits = [limit(20.0, 150.0), limit(30.0, 250.0), limit(30.0, 250.0)];
        let y = Trajectory::new(&ANKLE_STEPS, TICK, &limits)?;
        Ok(MotorReference::new(y))
    }

    fn environment(reference: &Self::Reference, ticks: f32) -> Self::Environment {
        reference.y.at(ticks as u32)
    }

    fn inverse<E: Effect<f32, 9, 9>>(
        _: &State<f32, 3, 3>,
        y: &Self::Environment,
        effects: &E,
    ) -> [f32; 3] {
        clustered::inverse::<G1Ankle, E, 9, 9, 3>(y, effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        clustered::plant::<Self, 9, 9, 3>(
            MID_STANCE,
            noise,
            |(_, _, _, viscous, coulomb, _), noise| {
                noise.friction(&mut viscous.0);
                noise.friction(&mut coulomb.torque);
            },
        )
    }

    fn inertia(_: &Self::Environment) -> [f32; 3] {
        clustered::inertia::<Self, 9, 9, 3>(MID_STANCE).unwrap_or([0.0; 3])
    }
}

/// Feed-forward of a serial model, that of mujocolab/mjlab: the ankle is two joints in a chain,
/// without rods, with the rotors of both motors at each of them. G of the loops converts its
/// torques to those of the motors; friction is at the motors.
#[derive(Clone, Copy, Debug)]
pub struct SerialJoints;

impl Law<3, State<f32, 3, 3>> for SerialJoints {
    fn feedforward(motors: &State<f32, 3, 3>, y: &State<f32, 3, 3>) -> [f32; 3] {
        let [knee, ankle] = ROTORS;
        let rotors = Armature([knee, 2.0 * ankle, 2.0 * ankle]);
        let tau = Engine::<SerialAnkle>::rnea(y, &(RIGID_BODY, rotors));
        let motion = Clustered::<Engine<G1Ankle>>::motion(y);
        let torques = motion.and_then(|motion| motion.to_motors(&tau));
        let Ok(MotorTorques { mut tau, .. }) = torques else {
            return [0.0; 3];
        };
        let friction = const { (EFFECTS.3, EFFECTS.4) };
        for ((tau, v), qd) in tau.iter_mut().zip(G1Ankle::MOTORS).zip(motors.qd) {
            Effect::<f32, 9, 9>::torque(&friction, v, JointState::new(0.0, qd), tau);
        }
        tau
    }
}
