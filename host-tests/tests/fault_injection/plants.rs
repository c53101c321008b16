//! The arms that faults are injected into: a pendulum without brakes, and the UR5e.

use dynamics_core::Core;
use dynamics_core::control::{Estimate, Gains, MotionLimits, SafetyLimits, StopCategory, feedback};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::model::model;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;

/// A tick, s.
pub const TICK: f32 = 1e-3;
const OMEGA: f32 = 25.0;

/// An arm with the law that knows it.
pub trait Plant<const V: usize> {
    const NAME: &'static str;
    const LIMITS: SafetyLimits<f32, V>;
    const HOME: [f32; V];
    const AWAY: [f32; V];
    const MOTION: MotionLimits<f32>;
    /// What follows a controlled stop.
    const STOP: StopCategory<f32, V>;
    /// Whether a brake holds the arm.
    const BRAKE: bool;

    fn gains() -> Gains<f32, V>;
    fn feed_forward(reference: &State<f32, V, V>) -> [f32; V];
    fn step(state: &mut State<f32, V, V>, tau: &[f32; V]);
    /// Kinetic energy, and the most that joints at these speeds can have, J.
    fn kinetic(state: &State<f32, V, V>) -> [f32; 2];

    fn law(
        gains: &Gains<f32, V>,
        reference: &State<f32, V, V>,
        estimate: &Estimate<f32, V>,
    ) -> [f32; V] {
        let mut tau = Self::feed_forward(reference);
        let pd = feedback(gains, reference, estimate);
        tau.iter_mut().zip(pd).for_each(|(tau, pd)| *tau += pd);
        tau
    }
}

/// A joint of 2 kg·m² with 8 N·m of gravity, and no brake.
pub struct Pendulum;

impl Plant<1> for Pendulum {
    const NAME: &'static str = "pendulum";
    const LIMITS: SafetyLimits<f32, 1> = SafetyLimits {
        torque: [60.0],
        rate: [30.0],
        speed: [3.0],
        lower: [-2.0],
        upper: [2.0],
    };
    const HOME: [f32; 1] = [0.0];
    const AWAY: [f32; 1] = [1.0];
    const MOTION: MotionLimits<f32> = MotionLimits {
        velocity: 1.3,
        acceleration: 10.0,
    };
    const STOP: StopCategory<f32, 1> = StopCategory::DampedLowering { damping: [30.0] };
    const BRAKE: bool = false;

    fn gains() -> Gains<f32, 1> {
        Gains::from_inertia(&[2.0], OMEGA, 1.0)
    }

    fn feed_forward(reference: &State<f32, 1, 1>) -> [f32; 1] {
        [2.0 * reference.qdd[0] + 8.0 * reference.q[0].cos()]
    }

    fn step(state: &mut State<f32, 1, 1>, tau: &[f32; 1]) {
        state.qd[0] += TICK * (tau[0] - 8.0 * state.q[0].cos()) / 2.0;
        state.q[0] += TICK * state.qd[0];
    }

    fn kinetic(state: &State<f32, 1, 1>) -> [f32; 2] {
        [state.qd[0], Self::LIMITS.speed[0]].map(|speed| speed * speed)
    }
}

const SCENE: (Gravity, Inertia, Coriolis, Armature<f32, 6>) = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]),
);

/// The UR5e on its brakes.
pub struct Ur5eArm;

impl Plant<6> for Ur5eArm {
    const NAME: &'static str = "ur5e";
    const LIMITS: SafetyLimits<f32, 6> = SafetyLimits {
        torque: [150.0, 150.0, 150.0, 28.0, 28.0, 28.0],
        rate: [75.0, 75.0, 75.0, 14.0, 14.0, 14.0],
        speed: [3.2; 6],
        lower: [-6.2; 6],
        upper: [6.2; 6],
    };
    const HOME: [f32; 6] = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
    const AWAY: [f32; 6] = [0.8, -1.2, 1.2, -1.2, -1.0, 0.7];
    const MOTION: MotionLimits<f32> = MotionLimits {
        velocity: 1.1,
        acceleration: 8.0,
    };
    const STOP: StopCategory<f32, 6> = StopCategory::ControlledOff;
    const BRAKE: bool = true;

    fn gains() -> Gains<f32, 6> {
        let m = Core::<Ur5e>::crba(&Self::HOME, &SCENE);
        Gains::from_inertia(&core::array::from_fn(|j| m.get(j, j)), OMEGA, 1.0)
    }

    fn feed_forward(reference: &State<f32, 6, 6>) -> [f32; 6] {
        Core::<Ur5e>::rnea(reference, &SCENE)
    }

    fn step(state: &mut State<f32, 6, 6>, tau: &[f32; 6]) {
        let robot = model::<f32, Ur5e, 6, 6, 6>();
        semi_implicit(robot, state, tau, &SCENE, TICK).expect("M is positive definite");
    }

    fn kinetic(state: &State<f32, 6, 6>) -> [f32; 2] {
        let m = Core::<Ur5e>::crba(&state.q, &SCENE);
        let (mut kinetic, mut rated) = (0.0, 0.0);
        for i in 0..6 {
            for j in 0..6 {
                kinetic += 0.5 * m.get(i, j) * state.qd[i] * state.qd[j];
                rated += 0.5 * m.get(i, j).abs() * Self::LIMITS.speed[i] * Self::LIMITS.speed[j];
            }
        }
        [kinetic, rated]
    }
}
