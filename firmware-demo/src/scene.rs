//! A scene: one trajectory run under several laws, on a plant that the controller knows exactly and
//! on one that it does not, with the tracking errors of each, and then without each of its effects
//! in turn.

use dynamics_core::Core;
use dynamics_core::effects::Effect;
use dynamics_core::model::{Calibrated, JointLimits, Model, Robot};
use dynamics_core::state::State;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;
use joint_drivers::ControlLoop;
use joint_drivers::as5047p::RESOLUTION;
use motion_control::law::Gains;
use motion_control::limits::MotionLimits;
use motion_control::reference::{Reference, Trajectory, TrajectoryError, WayPoint};
use motion_control::safety::{Detect, Detectors, FrozenEncoder, ReferenceStep, Saturation};

use crate::plant::{Plant, Simulated, last};

mod ablation;
mod app;
pub mod clustered;
mod errors;
mod firmware;
mod noise;
mod run;
mod trial;

pub use ablation::{Current, CurrentWithout, Effects, Without, name};
pub use app::{
    App, QUEUE, Record, STEPS, SimLoop, StartError, devices, marked_tick, simulated_loop,
};
#[cfg(feature = "telemetry")]
pub(crate) use app::{SETTLE, start};
pub use errors::{Errors, larger};
use firmware::SATURATED;
pub use firmware::{
    Devices, HOLD, NEAR, OMEGA_N, REENTRY, RIDE, SceneLoop, SetupError, Start, TICK, ZETA,
};
pub use noise::Noise;
pub use run::{Full, FullWithout, PdOnly, Run};
pub use trial::{Batch, Figures, Less, Other, PlantModel, Term, Trial};

/// The data sheet of a scene: a robot of B bodies, Q position and V velocity coordinates whose last
/// N joints are driven.
pub trait Scene<const B: usize, const Q: usize, const V: usize, const N: usize>:
    Sized + 'static
{
    type Robot: Robot<B, Q, V>;
    /// The effects that act, in control and in the plant.
    type Effects: Effects<Self, B, Q, V, N>;
    /// The reference of the driven joints.
    type Reference: Reference<f32, N> + Send;
    /// The surroundings that act on the robot; the controller knows them by other sensors than the
    /// encoders.
    type Environment;
    type Plant: Simulated<Self::Environment, N> + Send;

    /// The name on the command line.
    const NAME: &'static str;
    /// The largest error of a joint, under feed-forward by all effects on the exact plant, rad or
    /// m.
    const BOUND: f32;
    /// The effects at the start.
    const EFFECTS: Self::Effects;
    /// Whether the environment leaves the effects as they are: their numbers are then known while
    /// compiling.
    const CONSTANT_EFFECTS: bool = size_of::<Self::Environment>() == 0;
    /// The pose whose M sets the gains: only the default of [`Scene::inertia`] reads it.
    const GAIN_POSE: [f32; Q] = [0.0; Q];
    /// A tick, s.
    const TICK: f32 = TICK;
    /// The resolution of an encoder, rad or m.
    const RESOLUTION: f32 = RESOLUTION;
    /// Steps of the simulated robot in a tick.
    const STEPS: u32 = STEPS;
    /// The name of that pose; a name that ends in `inertia` says what [`Scene::inertia`] is
    /// instead.
    const GAIN_POSE_NAME: &'static str;
    /// The driven joints' limits.
    const LIMITS: [JointLimits<f32>; N] =
        limits_of(&<Self::Robot as Robot<B, Q, V>>::MODEL, last_places::<V, N>());

    /// The runs of every scene.
    const RUNS: [Run<Self, B, Q, V, N>; 4] = [
        Run::of::<Full<Self, B, Q, V>>(PlantModel::Exact, "feedforward"),
        Run::of::<PdOnly>(PlantModel::Exact, "pd"),
        Run::of::<Full<Self, B, Q, V>>(PlantModel::Mismatched, "feedforward"),
        Run::of::<PdOnly>(PlantModel::Mismatched, "pd"),
    ];
    /// Other laws that it compares.
    const BASELINES: &'static [Run<Self, B, Q, V, N>] = &[];
    /// Feed-forward less an effect.
    const ABLATIONS: &'static [Run<Self, B, Q, V, N>] =
        <Self::Effects as Effects<Self, B, Q, V, N>>::ABLATIONS;

    /// The reference trajectory.
    ///
    /// # Errors
    /// A trajectory that the arm's limits do not allow.
    fn reference() -> Result<Self::Reference, TrajectoryError>;

    /// The environment `ticks` after the start.
    fn environment(reference: &Self::Reference, ticks: f32) -> Self::Environment;

    /// Sets the effects to what they are in an environment.
    fn apply(_: &mut Self::Effects, _: &Self::Environment) {}

    /// The effects as they are in an environment.
    #[inline(always)]
    fn current(environment: &Self::Environment) -> Self::Effects {
        let mut effects = Self::EFFECTS;
        Self::apply(&mut effects, environment);
        effects
    }

    /// The torques that bring the reference about under some effects.
    fn inverse<E: Effect<f32, B, V>>(
        reference: &State<f32, N, N>,
        environment: &Self::Environment,
        effects: &E,
    ) -> [f32; N];

    /// The robot at the start, with noise if the controller is not to know it exactly.
    fn plant(noise: Option<&mut Noise>) -> Self::Plant;

    /// The inertia that each driven joint's gains are for, kg·m² or kg: M's diagonal.
    fn inertia(environment: &Self::Environment) -> [f32; N] {
        let effects = Self::current(environment);
        let m = Core::<Self::Robot>::crba(&Self::GAIN_POSE, &effects);
        last(&core::array::from_fn::<f32, V, _>(|j| m.get(j, j)))
    }

    /// The gains of the feedback on that inertia.
    fn gains(environment: &Self::Environment) -> Gains<f32, N> {
        Gains::from_inertia(&Self::inertia(environment), OMEGA_N, ZETA)
    }

    /// Detectors beside the supervisor, for a loop that is to have them: ten steps of an encoder
    /// without a change of its position, twice the speed limit from one reference to the next,
    /// torques at their limits for 50 ticks.
    fn detectors() -> Detectors<f32, N> {
        let limits = Self::LIMITS;
        Detectors {
            frozen: FrozenEncoder::new([10.0 * Self::RESOLUTION; N], 3),
            steps: ReferenceStep::new(limits.map(|limit| 2.0 * limit.velocity * Self::TICK)),
            saturation: Saturation::new(limits.map(|limit| limit.torque), SATURATED),
        }
    }

    /// The loop on some devices, with the gains of [`Scene::gains`], and [`Scene::detectors`] or
    /// `()`. Encoders and drives have the joints' own zero and direction.
    ///
    /// # Errors
    /// [`SetupError`]: a limit of torque or speed of the scene is not above zero.
    fn control_loop<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin, D: Detect<f32, N>>(
        devices: Devices<Spi, Pwm, Brake, N>,
        gains: Gains<f32, N>,
        detectors: D,
        start: Start,
    ) -> Result<SceneLoop<Spi, Pwm, Brake, N, D>, SetupError> {
        let new = ControlLoop::new;
        firmware::control_loop::<Self, _, _, _, _, B, Q, V, N>(
            devices, gains, detectors, start, new,
        )
    }
}

/// The limits of the joints at these coordinates; a coordinate of no joint does not compile.
///
/// ```
/// use dynamics_core::{model::{JointLimits, Robot}, robots::Ur5e};
/// const WRIST: [JointLimits<f32>; 1] = firmware_demo::scene::limits_of(&Ur5e::MODEL, [5]);
/// assert_eq!(WRIST[0], Ur5e::MODEL.to_f32().links[5].limits);
/// ```
///
/// ```compile_fail,E0080
/// use dynamics_core::{model::{JointLimits, Robot}, robots::Ur5e};
/// const NONE: [JointLimits<f32>; 1] = firmware_demo::scene::limits_of(&Ur5e::MODEL, [6]);
/// assert_eq!(NONE[0], Ur5e::MODEL.to_f32().links[5].limits);
/// ```
pub const fn limits_of<const B: usize, const Q: usize, const V: usize, const N: usize>(
    model: &Model<f64, B, Q, V>,
    coordinates: [usize; N],
) -> [JointLimits<f32>; N] {
    let links = model.to_f32().links;
    let mut limits = [links[0].limits; N];
    let mut n = 0;
    while n < N {
        // From the last, since a body without a joint has the index of the next joint.
        let mut i = B - 1;
        while links[i].idx_v != coordinates[n] {
            i -= 1;
        }
        limits[n] = links[i].limits;
        n += 1;
    }
    limits
}

/// The places of the last N of V coordinates.
const fn last_places<const V: usize, const N: usize>() -> [usize; N] {
    let mut places = [V - N; N];
    let mut n = 0;
    while n < N {
        places[n] += n;
        n += 1;
    }
    places
}

/// A robot at rest at q: the scene's, or one whose masses the controller does not know, nor of the
/// effects what `disturb` changes.
pub fn rigid<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    q: [f32; Q],
    noise: Option<&mut Noise>,
    disturb: fn(&mut S::Effects, &mut Noise),
) -> Plant<S::Robot, S::Effects, S::Environment, B, Q, V>
where
    S: Scene<B, Q, V, N>,
{
    let mut effects = S::EFFECTS;
    let mut robot = Calibrated::nominal();
    if let Some(noise) = noise {
        noise.masses(&mut robot);
        disturb(&mut effects, noise);
    }
    Plant::new(robot, effects, q, S::apply)
}

/// A trajectory through way-points within the limits' speeds and these accelerations, rad/s² or
/// m/s².
///
/// # Errors
/// Way-points that the limits do not allow.
pub fn through<const N: usize, const W: usize>(
    points: &[WayPoint<f32, N>; W],
    limits: &[JointLimits<f32>; N],
    acceleration: [f32; N],
) -> Result<Trajectory<f32, N, W>, TrajectoryError> {
    Trajectory::new(points, TICK, &speeds(limits, acceleration))
}

/// The speeds of some limits, with these accelerations, rad/s² or m/s².
pub fn speeds<const N: usize>(
    limits: &[JointLimits<f32>; N],
    acceleration: [f32; N],
) -> [MotionLimits<f32>; N] {
    core::array::from_fn(|j| MotionLimits {
        velocity: limits[j].velocity,
        acceleration: acceleration[j],
    })
}
