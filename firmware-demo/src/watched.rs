//! A scene that runs without end, each of its ticks with a record for the telemetry.

use core::marker::PhantomData;
use core::sync::atomic::{AtomicU32, Ordering::Relaxed};

use dynamics_core::model::{JointKind, model};
use heapless::String;
use joint_drivers::{Phase, Probe, Telemetry};
use machine_link::{Axis, Machine, Producer, Sample};
use motion_control::{limits::Mode, reference::Reference, safety::Detectors};

use crate::marker::measured;
use crate::plant::Rig;
use crate::region::{self, Marked};
use crate::scene::{Full, PlantModel, SETTLE, Scene, SetupError, SimLoop, StartError, start};
use crate::sim_io::Wires;

/// Ticks that an injected fault lasts: longer than it is ridden through.
const FAULTY: u32 = 20;
/// Ticks after which a stopped arm is restarted.
const STOPPED: u32 = 1000;
/// The joint whose encoder reports the injected fault.
const JOINT: usize = 2;

/// The length of a scene's run, and the events in it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Ticks that it runs; 0 for no end.
    pub ticks: u32,
    /// Every this many ticks an encoder reports errors, until the arm is stopped; 0 for never.
    pub faults: u32,
}

/// The timer of the ticks, known to the compiler so that reading it is a load.
pub trait Timer {
    /// Counts down, and begins again in each tick.
    fn count() -> u32;
}

/// A scene at work under the feed-forward of all its effects, on the plant that its controller
/// knows exactly.
pub struct Watched<
    S: Scene<B, Q, V, N>,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const N: usize,
> {
    reference: S::Reference,
    wires: &'static Wires<N>,
    rig: Rig<S::Plant, N>,
    control: SimLoop<N, Detectors<f32, N>>,
    records: Producer<'static, 'static, N>,
    elapsed: &'static AtomicU32,
    options: Options,
    stopped: u32,
    timer: PhantomData<fn() -> T>,
}

impl<S, T, const B: usize, const Q: usize, const V: usize, const N: usize> Watched<S, T, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
    T: Timer,
{
    /// The scene at the start of its trajectory; `elapsed` counts the ticks.
    ///
    /// # Errors
    /// [`StartError`].
    pub fn new(
        wires: &'static Wires<N>,
        records: Producer<'static, 'static, N>,
        elapsed: &'static AtomicU32,
        options: Options,
    ) -> Result<Self, StartError> {
        let reference = S::reference().map_err(StartError::Trajectory)?;
        let (rig, control) =
            at_start::<S, B, Q, V, N>(&reference, wires).map_err(StartError::Setup)?;
        Ok(Self {
            reference,
            wires,
            rig,
            control,
            records,
            elapsed,
            options,
            stopped: 0,
            timer: PhantomData,
        })
    }

    /// One tick; nothing after the last.
    pub fn tick(&mut self) {
        let count = self.elapsed.load(Relaxed);
        let Options { ticks, faults } = self.options;
        if ticks > 0 && count == ticks {
            return;
        }
        let since = count.checked_rem(faults);
        if since.is_some_and(|since| since < FAULTY && count >= faults) {
            self.wires.flag(JOINT.min(N - 1));
        }
        let environment = |ticks: f32| S::environment(&self.reference, ticks);
        let sample = self.records.sample();
        timed_tick::<S, T, B, Q, V, N>(
            &mut self.control,
            &self.reference,
            &environment(count as f32),
            sample,
        );
        let (tick, mode) = (sample.tick, sample.status.mode);
        measured::<{ region::RECORD }, _>(|| self.records.push());
        if mode == Mode::Stopped {
            self.wait();
        } else if self.advance(count) || tick >= self.reference.ticks() + SETTLE {
            self.restart();
        }
        self.elapsed.store(count.wrapping_add(1), Relaxed);
    }

    /// Puts robot and loop back to the start of the trajectory. They started before: the limits are
    /// the same.
    fn restart(&mut self) {
        if let Ok(started) = at_start::<S, B, Q, V, N>(&self.reference, self.wires) {
            (self.rig, self.control) = started;
        }
    }

    /// Moves the robot on by a tick; returns whether it has no forward dynamics any more.
    // Inlined into the tick it would take the registers with which the record is put into the queue.
    #[inline(never)]
    fn advance(&mut self, count: u32) -> bool {
        let environment = |ticks: f32| S::environment(&self.reference, ticks);
        let part = 1.0 / S::STEPS as f32;
        let advanced = self.rig.advance(self.wires, S::STEPS, S::TICK * part, |step| {
            environment(count as f32 + part * step as f32)
        });
        advanced.is_err()
    }

    /// The brake holds the arm; it is restarted after a while.
    fn wait(&mut self) {
        self.stopped += 1;
        if self.stopped == STOPPED {
            // An arm too far from its trajectory stays stopped, which its next records say.
            let _ = self.control.reset(&self.reference);
            self.stopped = 0;
        }
    }
}

/// The robot and the loop with its detectors at the start of the trajectory.
#[expect(clippy::type_complexity, reason = "a pair that is taken apart at once")]
fn at_start<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    reference: &S::Reference,
    wires: &'static Wires<N>,
) -> Result<(Rig<S::Plant, N>, SimLoop<N, Detectors<f32, N>>), SetupError>
where
    S: Scene<B, Q, V, N>,
{
    start::<S, _, B, Q, V, N>(reference, wires, PlantModel::Exact, S::detectors())
}

/// One tick, recorded with the counts of the timer. Reading the timer adds to the tick what six
/// loads from a device take.
#[inline(never)]
fn timed_tick<S, T, const B: usize, const Q: usize, const V: usize, const N: usize>(
    control: &mut SimLoop<N, Detectors<f32, N>>,
    reference: &S::Reference,
    environment: &S::Environment,
    sample: &mut Sample<N>,
) where
    S: Scene<B, Q, V, N>,
    T: Timer,
{
    let timed = Timed::<T, N> { sample, timer: PhantomData };
    control.tick_probed::<Full<S, B, Q, V>, _, _>(reference, environment, &mut Marked(timed));
}

/// Counts a timer at the start of a tick and after each phase, and keeps the record.
struct Timed<'a, T, const N: usize> {
    sample: &'a mut Sample<N>,
    timer: PhantomData<fn() -> T>,
}

impl<T: Timer, const N: usize> Timed<'_, T, N> {
    #[inline(always)]
    fn count(&mut self, at: usize) {
        if let Some(count) = self.sample.counts.get_mut(at) {
            *count = T::count();
        }
    }
}

impl<T: Timer, const N: usize> Probe<N> for Timed<'_, T, N> {
    #[inline(always)]
    fn begin(&mut self, phase: Phase) {
        if phase == Phase::Tick {
            self.count(0);
        }
    }

    #[inline(always)]
    fn end(&mut self, phase: Phase) {
        match phase {
            Phase::Tick => {}
            Phase::Read => self.count(1),
            Phase::Reference => self.count(2),
            Phase::Dynamics => self.count(3),
            Phase::Safety => self.count(4),
            Phase::Write => self.count(5),
        }
    }

    #[inline(always)]
    fn record(&mut self, telemetry: &Telemetry<N>) {
        fill(self.sample, telemetry);
    }
}

/// The controller's data of a tick.
#[inline(always)]
pub(crate) fn fill<const N: usize>(sample: &mut Sample<N>, telemetry: &Telemetry<N>) {
    sample.tick = telemetry.tick;
    sample.status = telemetry.status;
    sample.reference = telemetry.reference;
    sample.estimate = telemetry.estimate;
    sample.torque = telemetry.torque;
}

/// The constants of a scene's machine, with the frequency of the timer, Hz.
pub fn machine<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    timer_hz: u32,
) -> Machine<N>
where
    S: Scene<B, Q, V, N>,
{
    let model = model::<f32, S::Robot, B, Q, V>();
    // The driven joints are the last ones.
    let slides = |joint: usize| {
        let mut links = model.links.iter();
        let link = links.find(|link| link.idx_v == V - N + joint);
        link.is_some_and(|link| link.joint.kind == JointKind::Prismatic)
    };
    let limits = S::LIMITS.into_iter().enumerate();
    let joints = limits.map(|(joint, limits)| Axis { limits, prismatic: slides(joint) });
    machine_of(S::NAME, S::TICK, timer_hz, joints)
}

/// The constants of a machine with ticks of so many seconds.
pub fn machine_of<const N: usize>(
    name: &str,
    tick: f32,
    timer_hz: u32,
    joints: impl Iterator<Item = Axis>,
) -> Machine<N> {
    let mut short = String::new();
    // Longer names are cut short.
    let _ = name.chars().try_for_each(|letter| short.push(letter));
    Machine { name: short, tick_us: (tick * 1e6 + 0.5) as u32, timer_hz, joints: joints.collect() }
}
