//! The arms that faults are injected into: a pendulum without brakes, a gimbal of three joints, and
//! the UR5e.

use dynamics_core::Core;
use dynamics_core::effects::{Armature, Coriolis, Effect, Gravity, Inertia};
use dynamics_core::model::{Robot, model};
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;
use dynamics_core::trig::sin_cos;
use firmware_demo::robots::Gimbal;
use motion_control::{Estimate, Gains, MotionLimits, SafetyLimits, StopCategory, feedback};

/// A tick, s.
pub const TICK: f32 = 1e-3;
const OMEGA: f32 = 25.0;

/// An arm with the law that knows it.
pub trait Plant<const V: usize> {
    const NAME: &'static str;
    /// The rated torque, rate, speed and range.
    const LIMITS: SafetyLimits<f32, V>;
    /// Decay rate of a held arm, 1/s: at the speeds of the motion its torque is below the limits.
    const DECAY: f32;
    /// The start and end of its motion.
    const HOME: [f32; V];
    /// The place where it stops in between.
    const AWAY: [f32; V];
    /// The limits of the path to the motion.
    const MOTION: MotionLimits<f32>;
    const STOP: StopCategory<f32, V>;
    /// Whether a brake holds the arm.
    const BRAKE: bool;

    fn gains() -> Gains<f32, V>;
    /// The torque of a reference, N·m.
    fn feed_forward(reference: &State<f32, V, V>) -> [f32; V];
    fn step(state: &mut State<f32, V, V>, tau: &[f32; V]);
    /// Kinetic energy, and the most that joints at these speeds can have, J.
    fn kinetic(state: &State<f32, V, V>) -> [f32; 2];

    /// Feed-forward and feedback, N·m.
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

fn cos(angle: f32) -> f32 {
    sin_cos(angle).1
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
    const DECAY: f32 = 15.0;
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
        [2.0 * reference.qdd[0] + 8.0 * cos(reference.q[0])]
    }

    fn step(state: &mut State<f32, 1, 1>, tau: &[f32; 1]) {
        state.qd[0] += TICK * (tau[0] - 8.0 * cos(state.q[0])) / 2.0;
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
    const DECAY: f32 = 25.0;
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
        step::<Ur5e, _, 6>(state, tau, &SCENE);
    }

    fn kinetic(state: &State<f32, 6, 6>) -> [f32; 2] {
        let m = Core::<Ur5e>::crba(&state.q, &SCENE);
        energies(&state.qd, &Self::LIMITS.speed, |i, j| m.get(i, j))
    }
}

const HEAVY: (Gravity, Inertia, Coriolis) = (Gravity::EARTH, Inertia, Coriolis);

/// A gimbal of three joints on its brakes.
pub struct GimbalArm;

impl Plant<3> for GimbalArm {
    const NAME: &'static str = "gimbal";
    const LIMITS: SafetyLimits<f32, 3> = SafetyLimits {
        torque: [60.0, 60.0, 30.0],
        rate: [30.0, 30.0, 15.0],
        speed: [2.0; 3],
        lower: [-0.6, -0.6, -3.1],
        upper: [0.6, 0.6, 3.1],
    };
    const DECAY: f32 = 15.0;
    const HOME: [f32; 3] = [0.0; 3];
    const AWAY: [f32; 3] = [0.2, -0.2, 0.6];
    const MOTION: MotionLimits<f32> = MotionLimits {
        velocity: 0.8,
        acceleration: 6.0,
    };
    const STOP: StopCategory<f32, 3> = StopCategory::ControlledOff;
    const BRAKE: bool = true;

    fn gains() -> Gains<f32, 3> {
        let m = Core::<Gimbal>::crba(&Self::HOME, &HEAVY);
        Gains::from_inertia(&core::array::from_fn(|j| m.get(j, j)), OMEGA, 1.0)
    }

    fn feed_forward(reference: &State<f32, 3, 3>) -> [f32; 3] {
        Core::<Gimbal>::rnea(reference, &HEAVY)
    }

    fn step(state: &mut State<f32, 3, 3>, tau: &[f32; 3]) {
        step::<Gimbal, _, 3>(state, tau, &HEAVY);
    }

    fn kinetic(state: &State<f32, 3, 3>) -> [f32; 2] {
        let m = Core::<Gimbal>::crba(&state.q, &HEAVY);
        energies(&state.qd, &Self::LIMITS.speed, |i, j| m.get(i, j))
    }
}

/// A tick of a robot's forward dynamics. A state without them stays, and its velocity is not a
/// number.
fn step<T: Robot<V, V, V>, E: Effect<f32, V, V>, const V: usize>(
    state: &mut State<f32, V, V>,
    tau: &[f32; V],
    effects: &E,
) {
    if semi_implicit(model::<f32, T, V, V, V>(), state, tau, effects, TICK).is_err() {
        state.qd = [f32::NAN; V];
    }
}

/// ½ q̇ᵀ M q̇, and the same of the rated speeds with the absolute values of M, J.
fn energies<const V: usize>(
    qd: &[f32; V],
    rated: &[f32; V],
    m: impl Fn(usize, usize) -> f32,
) -> [f32; 2] {
    let mut energies = [0.0; 2];
    for i in 0..V {
        for j in 0..V {
            energies[0] += 0.5 * m(i, j) * qd[i] * qd[j];
            energies[1] += 0.5 * m(i, j).abs() * rated[i] * rated[j];
        }
    }
    energies
}
