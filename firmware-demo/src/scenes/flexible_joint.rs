//! Scene `flexible_joint`: an arm with elastic transmissions, under a controller that models them
//! and under one that does not. Its encoders sit on the motors, as those of most arms do; what
//! counts is where the links are.

use dynamics_core::drivetrain::{ElasticJoints, ElasticReference};
use dynamics_core::effects::{Armature, Coriolis, Effect, Gravity, Inertia, Viscous};
use dynamics_core::model::Calibrated;
use dynamics_core::robots::Iiwa14;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use motion_control::estimate::Estimate;
use motion_control::law::{Gains, feedback};
use motion_control::reference::{RestToRest, TrajectoryError, WayPoint};

use crate::plant::FlexiblePlant;
use crate::scene::{Noise, OMEGA_N, PlantModel, Run, Scene, TICK, ZETA, speeds};
use crate::trajectories::stop;
use joint_drivers::Law;

/// The start of the iiwa 14's swing, rad.
const UPRIGHT: [f32; 7] = [0.0, 0.4, 0.0, -1.2, 0.0, 0.8, 0.0];

/// A swing of the iiwa 14 there and back.
const SWING: [WayPoint<f32, 7>; 4] = [
    stop(UPRIGHT, 0),
    stop([0.7, 0.9, 0.3, -0.8, 0.5, 0.3, 0.6], 1300),
    stop([-0.5, 0.7, -0.3, -1.5, -0.5, 1.0, -0.6], 2100),
    stop(UPRIGHT, 1300),
];

pub type Effects = (Gravity, Inertia, Coriolis, Viscous<f32, 7>);

/// Assumed, of the order of harmonic drives of this size: the maker publishes neither stiffness nor
/// rotors.
const JOINTS: ElasticJoints<f32, 7> = ElasticJoints {
    stiffness: [1.6e4, 1.6e4, 1.2e4, 1.2e4, 9e3, 5e3, 5e3],
    rotor: [3.0, 3.0, 2.5, 2.5, 1.2, 0.5, 0.5],
    friction: [15.0, 15.0, 10.0, 10.0, 5.0, 2.0, 2.0],
};

/// The inertias of the gains, kg·m²: the motors with their links in the upright posture.
const INERTIA: [f32; 7] = [3.1, 7.5, 2.6, 4.0, 1.3, 0.6, 0.5];

#[derive(Clone, Copy, Debug)]
pub struct CompliantArm;

impl Scene<7, 7, 7, 7> for CompliantArm {
    type Robot = Iiwa14;
    type Effects = Effects;
    type Reference = RestToRest<f32, 7, 4>;
    /// The reference to its fourth derivative.
    type Environment = ElasticReference<f32, 7, 7>;
    type Plant = FlexiblePlant<Iiwa14, Effects, 7>;

    const NAME: &'static str = "flexible_joint";
    const BOUND: f32 = 2e-3;
    const EFFECTS: Effects =
        (Gravity::EARTH, Inertia, Coriolis, Viscous([2.0, 2.0, 1.5, 1.5, 1.0, 0.5, 0.5]));
    const GAIN_POSE: [f32; 7] = UPRIGHT;
    const GAIN_POSE_NAME: &'static str = "upright";
    const BASELINES: &'static [Run<Self, 7, 7, 7, 7>] =
        &[Run::of::<RigidJoints>(PlantModel::Exact, "rigid-joints")];
    // Inverse dynamics of compliant joints needs `Inertia` and `Coriolis`.
    const ABLATIONS: &'static [Run<Self, 7, 7, 7, 7>] = &[Run::without::<0>(), Run::without::<3>()];

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        RestToRest::new(&SWING, TICK, &speeds(&Self::LIMITS, [8.0; 7]))
    }

    fn environment(reference: &Self::Reference, ticks: f32) -> ElasticReference<f32, 7, 7> {
        reference.elastic_reference(ticks as u32)
    }

    fn inverse<E: Effect<f32, 7, 7>>(
        reference: &State<f32, 7, 7>,
        course: &ElasticReference<f32, 7, 7>,
        effects: &E,
    ) -> [f32; 7] {
        let course = ElasticReference { state: *reference, ..*course };
        let wanted = Engine::<Iiwa14>::elastic_inverse_dynamics(&JOINTS, &course, effects);
        // The loop feeds back q_d − θ; the motors are to be at θ_d.
        let gains = Gains::from_inertia(&INERTIA, OMEGA_N, ZETA);
        let motors = State { q: wanted.position, qd: wanted.velocity, qdd: [0.0; 7] };
        let joints = Estimate { q: reference.q, qd: reference.qd };
        let wound = feedback(&gains, &motors, &joints);
        core::array::from_fn(|j| wanted.torque[j] + wound[j])
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        let (mut robot, mut joints, mut effects) = (Calibrated::nominal(), JOINTS, Self::EFFECTS);
        if let Some(noise) = noise {
            noise.masses(&mut robot);
            noise.friction(&mut joints.stiffness);
            noise.friction(&mut joints.friction);
            noise.friction(&mut effects.3.0);
        }
        let weight = Core::<Iiwa14>::rnea(&State::at(SWING[0].q), &Gravity::EARTH);
        let wound = core::array::from_fn(|j| SWING[0].q[j] + weight[j] / JOINTS.stiffness[j]);
        FlexiblePlant::new(robot, joints, effects, [SWING[0].q, wound])
    }

    fn inertia(_: &ElasticReference<f32, 7, 7>) -> [f32; 7] {
        INERTIA
    }
}

/// Feed-forward that takes the joints for rigid: links and rotors as one.
#[derive(Clone, Copy, Debug)]
pub struct RigidJoints;

impl Law<7, ElasticReference<f32, 7, 7>> for RigidJoints {
    fn feedforward(reference: &State<f32, 7, 7>, _: &ElasticReference<f32, 7, 7>) -> [f32; 7] {
        let (gravity, inertia, coriolis, Viscous(links)) = CompliantArm::EFFECTS;
        let friction = core::array::from_fn(|j| links[j] + JOINTS.friction[j]);
        let motors = (Armature(JOINTS.rotor), Viscous(friction));
        Core::<Iiwa14>::rnea(reference, &(gravity, inertia, coriolis, motors))
    }
}
