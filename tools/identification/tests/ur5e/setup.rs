//! The arm, its limits, its excitation, and what differs from arm to arm.

use std::sync::LazyLock;

use dynamics_core::algorithms::inertial_parameters;
use dynamics_core::effects::{Coriolis, Gravity, Inertia, Payload, RIGID_BODY, Width};
use dynamics_core::model::{ArmModel, BodyInertia, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use identification::{
    BaseModel, ExcitationLimits, Fit, Fitted, FourierMotion, Search, TickRecording,
};
use motion_control::reference::{Reference, Trajectory};

use crate::generated;

/// Gravity, inertia and velocity products.
pub type Scene = (Gravity, Inertia, Coriolis);
pub type Arm = BaseModel<ArmModel<f64, 6>, Scene, 6, 6>;

pub const RATED: [f64; 6] = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];
/// Noise of the measured torque, N·m.
pub const NOISE: [f64; 6] = [1.5, 1.5, 1.5, 0.28, 0.28, 0.28];
pub const COUNT: f64 = std::f64::consts::TAU / 16384.0;
pub const TICK: f64 = 2e-3;
pub const PERIOD: f64 = 5.0;
pub const EACH: usize = 2500;
/// Periods of half a minute; the first one is not recorded.
pub const PERIODS: usize = 6;
pub const WIDTH: Width<f64> = Width::f64(0.05);

/// Clear of the ground before the arm.
pub const LIMITS: ExcitationLimits<6> = ExcitationLimits {
    lower: [-2.0, -2.3, -2.2, -2.5, -2.5, -2.5],
    upper: [2.0, -0.8, 2.2, 2.5, 2.5, 2.5],
    velocity: [2.0, 2.0, 2.5, 3.0, 3.0, 3.0],
    acceleration: [5.0, 5.0, 7.0, 12.0, 12.0, 12.0],
    torque: RATED,
};

pub const SEARCH: Search =
    Search { period: PERIOD, harmonics: 5, samples: 60, starts: 4, fresh: 20, steps: 500, seed: 1 };

pub static ARM: LazyLock<Arm> =
    LazyLock::new(|| BaseModel::new(Ur5e::MODEL, RIGID_BODY, WIDTH, LIMITS));

/// The result of the search, as the file for firmware has it.
pub static CHOSEN: LazyLock<FourierMotion<6>> = LazyLock::new(|| {
    let rows = |rows: &[[f32; 6]]| rows.iter().map(|row| row.map(f64::from)).collect();
    FourierMotion {
        period: PERIOD,
        centre: generated::CENTRE.map(f64::from),
        sines: rows(&generated::SINES),
        cosines: rows(&generated::COSINES),
    }
});

/// A number of arms: few without optimisation, and many where tests simulate.
pub const fn few_or_many(few: u64, many: u64) -> u64 {
    if cfg!(debug_assertions) { few } else { many }
}

/// States of a period.
pub fn states(motion: &FourierMotion<6>, count: u32) -> Vec<State<f64, 6, 6>> {
    let time = |k| motion.period * f64::from(k) / f64::from(count);
    (0..count).map(|k| motion.at(time(k))).collect()
}

/// Every twentieth tick of the pick and place.
pub fn pick_and_place() -> Vec<State<f64, 6, 6>> {
    let mut path = Trajectory::REST;
    firmware_demo::scenes::ur5e::plan(&mut path).expect("a path within the limits");
    let ticks = (0..Reference::<f32, 6>::ticks(&path)).step_by(20);
    let states = ticks.map(|tick| {
        let State { q, qd, qdd } = path.at(tick);
        State { q: q.map(f64::from), qd: qd.map(f64::from), qdd: qdd.map(f64::from) }
    });
    states.collect()
}

/// Viscous and Coulomb friction, armature and offset.
pub const JOINTS: [[f64; 4]; 6] = [
    [12.0, 8.0, 0.9, 0.0],
    [12.0, 8.0, 0.9, 0.0],
    [8.0, 6.0, 0.9, 0.0],
    [2.0, 1.5, 0.25, 0.0],
    [2.0, 1.5, 0.25, 0.0],
    [1.5, 1.2, 0.25, 0.0],
];

/// All parameters of an arm.
#[derive(Clone, Copy)]
pub struct Parameters {
    pub bodies: [[f64; 10]; 6],
    pub joints: [[f64; 4]; 6],
}

impl Parameters {
    pub fn nominal() -> Self {
        Self { bodies: inertial_parameters(&Ur5e::MODEL, &()), joints: JOINTS }
    }

    /// Each mass, each component of each centre of mass, the inertias of each body about its
    /// centre, and each number of a joint times another number between 0.7 and 1.3; offsets of up
    /// to 1 % of the rated torque.
    pub fn off(seed: u64) -> Self {
        let mut rng = fastrand::Rng::with_seed(seed);
        let mut factor = || 0.7 + 0.6 * rng.f64();
        let Self { bodies, mut joints } = Self::nominal();
        let bodies = bodies.map(|body| {
            let about = BodyInertia::about_com(&SpatialInertia::from_parameters(body));
            let inertia = factor();
            let off = BodyInertia {
                mass: about.mass * factor(),
                com: about.com.map(|c| c * factor()),
                inertia: about.inertia.map(|x| x * inertia),
            };
            Payload::<f64, 0>::from_inertia(off).0.parameters()
        });
        for (joint, rated) in joints.iter_mut().zip(RATED) {
            *joint = joint.map(|x| x * factor());
            joint[3] = 0.01 * rated * (factor() - 1.0) / 0.3;
        }
        Self { bodies, joints }
    }

    pub fn base(&self) -> Vec<f64> {
        ARM.of_all(&self.bodies, &self.joints)
    }
}

/// The fit of a recording with the nominal model as the prior.
pub fn fitted(arm: &Arm, recording: &TickRecording<6>, fit: Fit) -> Fitted<6> {
    let nominal = Parameters::nominal().base();
    fit.identify(arm, recording, &nominal, &vec![false; arm.len()], None).expect("a good motion")
}

/// A number of a normal distribution: Box & Muller.
pub fn normal(rng: &mut fastrand::Rng) -> f64 {
    let radius = (-2.0 * (1.0 - rng.f64()).ln()).sqrt();
    radius * (std::f64::consts::TAU * rng.f64()).cos()
}
