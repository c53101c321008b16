//! A scene: one trajectory run under several laws, on a plant that the controller knows exactly and
//! on one that it does not, with the tracking errors of each.

use core::convert::Infallible;
use core::marker::PhantomData;

use dynamics_core::control::{Status, Trajectory, TrajectoryError, WayPoint};
use dynamics_core::effects::Effect;
use dynamics_core::model::{Calibrated, Robot};
use dynamics_core::state::State;
use embedded_hal::digital::{self, OutputPin};
use heapless::spsc::Producer;

use crate::control_loop::{ControlLoop, Law, Telemetry};
use crate::plant::{Plant, SimDrive, SimEncoder, Wires};

mod firmware;

pub use firmware::{HOLD, OMEGA_N, REENTRY, RIDE, TICK, ZETA, control_loop, limits, trajectory};

/// Steps of the simulated robot in a tick.
const STEPS: u32 = 4;
/// Ticks that each run goes on after the trajectory's end.
const SETTLE: u32 = 200;

/// The data sheet of a scene.
pub trait Scene<const B: usize, const N: usize, const W: usize>: 'static {
    /// The arm.
    type Robot: Robot<B, N, N>;
    /// The effects that act, in control and in the plant.
    type Effects: Effect<f32, B, N> + Send + 'static;
    /// With the arm's full model.
    type FeedForward: Law<N>;
    /// With gravity alone.
    type Gravity: Law<N>;

    /// The name on the command line.
    const NAME: &'static str;
    /// Where the arm passes and when.
    const WAY_POINTS: [WayPoint<f32, N>; W];
    /// Greatest acceleration of each joint on the way, rad/s² or m/s².
    const ACCELERATION: [f32; N];
    /// The pose whose M sets the gains.
    const GAIN_POSE: [f32; N];
    /// What that pose is called.
    const GAIN_POSE_NAME: &'static str;

    /// The effects as the controller knows them.
    fn effects() -> Self::Effects;
    /// The effects of a plant whose friction is off by a factor from `noise` for each joint.
    fn disturbed(noise: &mut Noise) -> Self::Effects;
}

/// No feed-forward at all.
#[derive(Clone, Copy, Debug)]
pub struct PdOnly;

impl<const N: usize> Law<N> for PdOnly {
    const ACCELERATES: bool = false;

    fn feedforward(_: &State<f32, N, N>) -> [f32; N] {
        [0.0; N]
    }
}

/// Factors about one, from a fixed seed (Marsaglia's xorshift32, 2003).
#[derive(Clone, Copy, Debug)]
pub struct Noise(u32);

impl Noise {
    /// The same factors each time.
    pub const fn seeded() -> Self {
        Self(0x5eed_1234)
    }

    /// A factor in 1 ± `spread`.
    pub fn factor(&mut self, spread: f32) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        1.0 + spread * (self.0 as f32 * (2.0 / 4_294_967_296.0) - 1.0)
    }
}

/// The runs of every scene: plant and law, as the log names them.
pub const RUNS: [(&str, &str); 6] = [
    ("exact", "feedforward"),
    ("exact", "gravity"),
    ("exact", "pd"),
    ("mismatched", "feedforward"),
    ("mismatched", "gravity"),
    ("mismatched", "pd"),
];

/// A tick's telemetry with the truth that only a simulation knows.
#[derive(Clone, Copy, Debug)]
pub struct Record<const N: usize> {
    /// Index in [`RUNS`].
    pub run: usize,
    /// Ticks since the run's start.
    pub tick: u32,
    /// The loop's own words.
    pub telemetry: Telemetry<N>,
    /// Where the joints truly are.
    pub actual: [f32; N],
    /// The plant failed in this tick: its mass matrix is not positive definite, and no record
    /// follows.
    pub broken: bool,
}

/// A brake that only a simulation has.
#[derive(Clone, Copy, Debug)]
pub struct SimBrake;

impl digital::ErrorType for SimBrake {
    type Error = Infallible;
}

impl OutputPin for SimBrake {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// The robot of a scene, simulated.
type ScenePlant<S, const B: usize, const N: usize, const W: usize> =
    Plant<<S as Scene<B, N, W>>::Robot, <S as Scene<B, N, W>>::Effects, B, N>;

/// The firmware on simulated devices.
type SimLoop<const N: usize> = ControlLoop<SimEncoder, SimDrive, SimBrake, N>;

/// The scene at work: what the interrupt calls.
pub struct App<S: Scene<B, N, W>, const B: usize, const N: usize, const W: usize> {
    trajectory: Trajectory<f32, N, W>,
    wires: &'static Wires<N>,
    plant: ScenePlant<S, B, N, W>,
    control: SimLoop<N>,
    records: Producer<'static, Record<N>>,
    run: usize,
    tick: u32,
    /// The plant has no forward dynamics in its present state.
    broken: bool,
    scene: PhantomData<S>,
}

impl<S: Scene<B, N, W>, const B: usize, const N: usize, const W: usize> App<S, B, N, W> {
    /// The scene at the start of its first run.
    ///
    /// # Errors
    /// Way-points that the arm's limits do not allow.
    pub fn new(
        wires: &'static Wires<N>,
        records: Producer<'static, Record<N>>,
    ) -> Result<Self, TrajectoryError> {
        let trajectory = trajectory::<S, B, N, W>()?;
        let (plant, control) = start::<S, B, N, W>(wires, 0);
        let scene = PhantomData;
        Ok(Self {
            trajectory,
            wires,
            plant,
            control,
            records,
            run: 0,
            tick: 0,
            broken: false,
            scene,
        })
    }

    /// Ticks of one run.
    pub fn ticks(&self) -> u32 {
        self.trajectory.ticks() + SETTLE
    }

    /// One tick of the present run; nothing after the last, nor after a plant that failed.
    pub fn tick(&mut self) {
        if self.run >= RUNS.len() || self.broken {
            return;
        }
        let telemetry = match self.run % 3 {
            0 => self.control.tick::<S::FeedForward, W>(&self.trajectory),
            1 => self.control.tick::<S::Gravity, W>(&self.trajectory),
            _ => self.control.tick::<PdOnly, W>(&self.trajectory),
        };
        let actual = self.plant.state.q;
        let step = TICK / STEPS as f32;
        self.broken = self.plant.advance(self.wires, STEPS, step).is_err();
        let record = Record {
            run: self.run,
            tick: self.tick,
            telemetry,
            actual,
            broken: self.broken,
        };
        // A full queue loses the record; the reader sees the gap in the ticks and says so.
        let _ = self.records.enqueue(record);
        if self.broken {
            return;
        }
        self.tick += 1;
        if self.tick == self.ticks() {
            self.run += 1;
            self.tick = 0;
            (self.plant, self.control) = start::<S, B, N, W>(self.wires, self.run);
        }
    }
}

/// A plant at rest on the first way-point and a loop that knows it so.
fn start<S, const B: usize, const N: usize, const W: usize>(
    wires: &'static Wires<N>,
    run: usize,
) -> (ScenePlant<S, B, N, W>, SimLoop<N>)
where
    S: Scene<B, N, W>,
{
    let (mut robot, mut effects) = (Calibrated::nominal(), S::effects());
    if run >= 3 {
        let mut noise = Noise::seeded();
        disturb(&mut robot, &mut noise);
        effects = S::disturbed(&mut noise);
    }
    let torque = limits::<S, B, N, W>().map(|l| l.torque);
    let plant = Plant::new(robot, effects, torque, S::WAY_POINTS[0].q);
    plant.publish(wires);
    let encoders = core::array::from_fn(|j| wires.encoder(j));
    let drives = core::array::from_fn(|j| wires.drive(j));
    let control = control_loop::<S, _, _, _, B, N, W>(encoders, drives, SimBrake);
    (plant, control)
}

/// Masses off by up to 3 %, each body's inertia with its mass.
fn disturb<T, const B: usize, const N: usize>(
    robot: &mut Calibrated<T, f32, B, N, N>,
    noise: &mut Noise,
) where
    T: Robot<B, N, N>,
{
    for inertia in robot.inertias() {
        let factor = noise.factor(0.03);
        inertia.mass *= factor;
        inertia.moment *= factor;
        inertia.inertia *= factor;
    }
}

/// Tracking errors of one run, gathered outside the interrupt.
#[derive(Clone, Copy, Debug)]
pub struct Errors<const N: usize> {
    count: u32,
    squares: [f64; N],
    /// Largest absolute error of each joint.
    pub max: [f32; N],
    /// The first status with a fault or a limit in effect, or else the last.
    pub status: Option<Status>,
}

impl<const N: usize> Default for Errors<N> {
    fn default() -> Self {
        Self {
            count: 0,
            squares: [0.0; N],
            max: [0.0; N],
            status: None,
        }
    }
}

impl<const N: usize> Errors<N> {
    /// Takes a tick in.
    pub fn add(&mut self, record: &Record<N>) {
        self.count += 1;
        for j in 0..N {
            let error = record.actual[j] - record.telemetry.reference[j];
            self.squares[j] += f64::from(error) * f64::from(error);
            self.max[j] = self.max[j].max(error.abs());
        }
        let plain = |s: &Status| s.fault.is_none() && !s.limited;
        if self.status.is_none_or(|s| plain(&s)) {
            self.status = Some(record.telemetry.status);
        }
    }

    /// Root mean square of each joint.
    pub fn rms(&self) -> [f32; N] {
        self.squares.map(|s| self.root(s))
    }

    /// Root mean square over all joints.
    pub fn total(&self) -> f32 {
        self.root(self.squares.iter().sum::<f64>() / N as f64)
    }

    /// Ticks taken in.
    pub fn count(&self) -> u32 {
        self.count
    }

    fn root(&self, squares: f64) -> f32 {
        libm::sqrt(squares / f64::from(self.count.max(1))) as f32
    }
}
