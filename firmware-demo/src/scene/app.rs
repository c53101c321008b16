//! The scene at work: the firmware on simulated devices, run after run.

use core::fmt;

use dynamics_core::model::JointLimits;
use heapless::spsc::Producer;
use joint_drivers::as5047p::As5047p;
use joint_drivers::h_bridge::LockedAntiphase;
use joint_drivers::{ControlLoop, Law, NoBrake, Telemetry};
use motion_control::law::Gains;
use motion_control::motion::MotionController;
use motion_control::reference::{Reference, TrajectoryError};
use motion_control::safety::Detect;

use super::firmware::control_loop;
use super::{
    Devices, Effects, Noise, PlantModel, Run, Scene, SceneLoop, SetupError, Start, Term, Trial,
};
use crate::plant::{Rig, Simulated};
use crate::region::Marked;
use crate::sim_io::{SimDrive, SimEncoder, Wires};

/// Steps of the simulated robot in a tick, unless its scene sets another number.
pub const STEPS: u32 = 4;
/// Ticks that each run goes on after the reference's end.
pub(crate) const SETTLE: u32 = 200;
/// Records that wait for the log at most.
pub const QUEUE: usize = 32;

/// A tick's telemetry with the truth that only a simulation knows.
#[derive(Clone, Copy, Debug)]
pub struct Record<const N: usize> {
    /// The number of the run, from 0.
    pub run: usize,
    /// Ticks since the run's start.
    pub tick: u32,
    pub telemetry: Telemetry<N>,
    /// The true positions of the driven joints.
    pub actual: [f32; N],
    /// The plant failed in this tick: it has no forward dynamics, and no record follows.
    pub broken: bool,
}

/// The reason why a scene does not start.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StartError {
    /// The arm's limits do not allow the trajectory.
    Trajectory(TrajectoryError),
    /// The limits are impossible for the devices.
    Setup(SetupError),
}

impl fmt::Display for StartError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Trajectory(error) => error.fmt(out),
            Self::Setup(error) => error.fmt(out),
        }
    }
}

impl core::error::Error for StartError {}

/// The firmware on simulated devices.
pub type SimLoop<const N: usize, D = ()> = SceneLoop<SimEncoder, SimDrive, NoBrake, N, D>;

/// One tick of it under the law `L`, between the markers of its regions.
#[inline(never)]
pub fn marked_tick<L: Law<N, X>, T: Reference<f32, N>, X, const N: usize>(
    control: &mut SimLoop<N>,
    trajectory: &T,
    environment: &X,
) -> Telemetry<N> {
    control.tick_probed::<L, T, X>(trajectory, environment, &mut Marked(()))
}

/// The simulated devices on some wires.
pub fn devices<const N: usize>(
    wires: &'static Wires<N>,
) -> Devices<SimEncoder, SimDrive, NoBrake, N> {
    Devices {
        encoders: core::array::from_fn(|joint| wires.encoder(joint)),
        drives: core::array::from_fn(|joint| wires.drive(joint)),
        brake: NoBrake,
    }
}

/// The scene at work: what the interrupt calls.
pub struct App<S: Scene<B, Q, V, N>, const B: usize, const Q: usize, const V: usize, const N: usize>
{
    reference: S::Reference,
    wires: &'static Wires<N>,
    rig: Rig<S::Plant, N>,
    control: SimLoop<N>,
    records: Producer<'static, Record<N>>,
    run: usize,
    tick: u32,
    /// The plant has no forward dynamics in its present state.
    broken: bool,
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> App<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    /// The scene at the start of its first run.
    ///
    /// # Errors
    /// [`StartError`].
    pub fn new(
        wires: &'static Wires<N>,
        records: Producer<'static, Record<N>>,
    ) -> Result<Self, StartError> {
        let reference = S::reference().map_err(StartError::Trajectory)?;
        let (rig, control) = start::<S, _, B, Q, V, N>(&reference, wires, PlantModel::Exact, ())
            .map_err(StartError::Setup)?;
        Ok(Self { reference, wires, rig, control, records, run: 0, tick: 0, broken: false })
    }

    pub fn runs() -> impl Iterator<Item = &'static Run<S, B, Q, V, N>> {
        S::RUNS.iter().chain(S::BASELINES).chain(S::ABLATIONS)
    }

    // Inlined, the three lists would be searched by two copies of the same code.
    #[inline(never)]
    fn numbered(run: usize) -> Option<&'static Run<S, B, Q, V, N>> {
        Self::runs().nth(run)
    }

    /// One tick of the present run; nothing after the last, nor after a plant that failed.
    pub fn tick(&mut self) {
        let Some(run) = Self::numbered(self.run).filter(|_| !self.broken) else {
            return;
        };
        let environment = |ticks: f32| S::environment(&self.reference, ticks);
        let now = self.tick as f32;
        let telemetry = (run.tick)(&mut self.control, &self.reference, &environment(now));
        let actual = self.rig.plant.actual();
        let part = 1.0 / S::STEPS as f32;
        let advanced = self.rig.advance(self.wires, S::STEPS, S::TICK * part, |step| {
            environment(now + part * step as f32)
        });
        self.broken = advanced.is_err();
        let record =
            Record { run: self.run, tick: self.tick, telemetry, actual, broken: self.broken };
        // A full queue loses the record; the reader sees the gap in the ticks and says so.
        let _ = self.records.enqueue(record);
        if self.broken {
            return;
        }
        self.tick += 1;
        if self.tick == self.ticks() {
            self.run += 1;
            self.tick = 0;
            let next = Self::numbered(self.run).map_or(PlantModel::Exact, |run| run.plant);
            match start::<S, _, B, Q, V, N>(&self.reference, self.wires, next, ()) {
                Ok(started) => (self.rig, self.control) = started,
                Err(_) => self.broken = true,
            }
        }
    }
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Trial<N>
    for App<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    const NAME: &'static str = S::NAME;
    const TICK: f32 = S::TICK;
    const BOUND: f32 = S::BOUND;
    const LIMITS: [JointLimits<f32>; N] = S::LIMITS;
    const TERMS: &'static [Term] = <S::Effects as Effects<S, B, Q, V, N>>::TERMS;

    fn ticks(&self) -> u32 {
        self.reference.ticks() + SETTLE
    }
}

/// The loop of a scene on its wires, for an arm at rest where its encoders are.
///
/// # Errors
/// As [`Scene::control_loop`].
pub fn simulated_loop<S, D, const B: usize, const Q: usize, const V: usize, const N: usize>(
    reference: &S::Reference,
    wires: &'static Wires<N>,
    detectors: D,
) -> Result<SimLoop<N, D>, SetupError>
where
    S: Scene<B, Q, V, N>,
    D: Detect<f32, N>,
{
    let gains = S::gains(&S::environment(reference, 0.0));
    let (devices, start) = (devices(wires), Start::OnTrajectory);
    let new = new_simulated::<N, D>;
    control_loop::<S, _, _, _, _, B, Q, V, N>(devices, gains, detectors, start, new)
}

/// [`ControlLoop::new`] in a function of its own: inlined, it takes 200 bytes more of flash.
#[inline(never)]
fn new_simulated<const N: usize, D: Detect<f32, N>>(
    encoders: [As5047p<SimEncoder>; N],
    drives: [LockedAntiphase<SimDrive>; N],
    brake: NoBrake,
    gains: Gains<f32, N>,
    controller: MotionController<f32, N>,
    detectors: D,
) -> SimLoop<N, D> {
    ControlLoop::new(encoders, drives, brake, gains, controller, detectors)
}

/// A plant at rest at the start of the trajectory, and a loop whose observer starts there.
pub(crate) fn start<S, D, const B: usize, const Q: usize, const V: usize, const N: usize>(
    reference: &S::Reference,
    wires: &'static Wires<N>,
    truth: PlantModel,
    detectors: D,
) -> Result<(Rig<S::Plant, N>, SimLoop<N, D>), SetupError>
where
    S: Scene<B, Q, V, N>,
    D: Detect<f32, N>,
{
    let mut noise = Noise::seeded();
    let noise = (truth == PlantModel::Mismatched).then_some(&mut noise);
    let torque = S::LIMITS.map(|l| l.torque);
    let rig = Rig::new(S::plant(noise), torque, wires);
    let control = simulated_loop::<S, D, B, Q, V, N>(reference, wires, detectors)?;
    Ok((rig, control))
}
