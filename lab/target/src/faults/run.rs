//! One arm under random faults.

use firmware_demo::digest::Digest;
use heapless::Vec;
use motion_control::{Fault, Mode, Trajectory, WayPoint};

use super::arm::{Arm, Episode, Setup, Violation};
use super::kinds::{Kind, Onset};
use super::plants::{Plant, TICK};
use super::random::Random;

/// Ticks of a run: faults begin in the first part.
pub const TICKS: u32 = 6000;
const FAULTY: u32 = 2600;
/// Ticks without a fault before a stopped arm is started again.
const QUIET: u32 = 20;

/// The observations of a single fault while the arm followed its motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Observed {
    pub kind: Kind,
    /// Its duration, ticks, if it is a lasting one.
    pub ticks: u32,
    /// Ticks from its begin to its report; none if it had no effect.
    pub latency: Option<u32>,
    /// Whether the arm was held after it.
    pub held: bool,
    /// Whether the arm was stopped after it.
    pub stopped: bool,
    /// Whether no other fault began before its end.
    pub whole: bool,
}

/// The result of a run without a violation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The digest of all torques.
    pub digest: Digest,
    /// The number of faults that began.
    pub injected: u32,
}

/// A tick of a plant that moves at this share of its rated speeds.
///
/// # Errors
/// The limit that does not hold.
pub fn at_speed<P: Plant<V>, const V: usize>(share: f32) -> Result<(), Violation> {
    let motion = motion::<P, V>()?;
    let mut arm = Arm::<P, V>::new(&motion, Setup::SOUND);
    arm.state.qd = P::LIMITS.speed.map(|speed| share * speed);
    arm.torque = P::feed_forward(&motion.at(0));
    arm.advance()
}

fn motion<P: Plant<V>, const V: usize>() -> Result<Trajectory<f32, V, 3>, Violation> {
    let stop = |q, ticks| WayPoint {
        q,
        qd: [0.0; V],
        ticks,
    };
    let points = [stop(P::HOME, 0), stop(P::AWAY, 1500), stop(P::HOME, 1500)];
    Trajectory::new(&points, TICK, &[P::MOTION; V]).map_err(|_| Violation::Motion)
}

/// The fault that is observed, with the tick of its begin.
struct Watch {
    one: Observed,
    begin: u32,
}

impl Watch {
    fn new(kind: Kind, begin: u32, ticks: u32) -> Self {
        let one = Observed {
            kind,
            ticks,
            latency: None,
            held: false,
            stopped: false,
            whole: false,
        };
        Self { one, begin }
    }

    fn see(&mut self, now: u32, mode: Mode, fault: Option<Fault>) {
        let one = &mut self.one;
        if one.latency.is_none() && fault.is_some_and(|fault| one.kind.is(fault)) {
            one.latency = Some(now - self.begin);
        }
        one.held |= mode == Mode::Hold;
        one.stopped |= mode == Mode::Stopped;
    }

    /// Ends the observation at the begin of another fault.
    fn end(mut self, now: u32) -> Observed {
        self.one.whole = now >= self.begin + self.one.ticks;
        self.one
    }
}

/// Runs an arm under the faults of a seed.
///
/// # Errors
/// The limit that did not hold.
pub fn run<P: Plant<V>, const V: usize>(
    seed: u32,
    setup: Setup,
    mut observe: impl FnMut(Observed),
) -> Result<Outcome, Violation> {
    let mut random = Random::new(seed);
    let motion = motion::<P, V>()?;
    let mut arm = Arm::<P, V>::new(&motion, setup);
    let mut episodes = Vec::<Episode, 32>::new();
    let (mut next, mut watched, mut quiet) = (100 + random.below(600), None::<Watch>, 0);
    let (mut digest, mut injected, mut last) = (Digest::EMPTY, 0, (Mode::Full, None));
    for now in 0..TICKS {
        episodes.retain(|episode| now <= episode.ticks[1]);
        if now == next && now < FAULTY {
            let onset = Onset::random(&mut random);
            let alone = episodes.is_empty() && quiet > 300 && arm.back_off.is_none();
            if let Some(watch) = watched.take() {
                observe(watch.end(now));
            }
            let held = arm.state.q[onset.joint as usize % V];
            let ticks = 1 + random.below(180);
            watched = alone.then(|| Watch::new(onset.kind, now, ticks));
            let episode = Episode {
                onset,
                ticks: [now, now + ticks],
                held,
            };
            // The list holds all that can begin within the longest one, but for a series of the
            // shortest pauses.
            injected += u32::from(episodes.push(episode).is_ok());
            let soon = random.below(3) == 0;
            next = now + 1 + random.below(if soon { 60 } else { 900 });
        }
        let (mode, fault) = arm.tick(now, &episodes)?;
        last = (mode, fault);
        digest.add(arm.torque);
        let calm = fault.is_none() && episodes.is_empty();
        quiet = if calm { quiet + 1 } else { 0 };
        if let Some(watch) = &mut watched {
            watch.see(now, mode, fault);
        }
        let idle = mode == Mode::Stopped || mode == Mode::Hold;
        if idle && episodes.is_empty() && now % QUIET == 0 && arm.recover(&motion) {
            watched
                .take()
                .into_iter()
                .for_each(|watch| observe(watch.end(now)));
        }
    }
    watched
        .into_iter()
        .for_each(|watch| observe(watch.end(TICKS)));
    let reference = arm.controller.reference().q;
    let mut pairs = arm.state.q.iter().zip(&reference);
    let near = pairs.all(|(q, reference)| (q - reference).abs() < 0.02);
    if arm.controller.mode() != Mode::Full || !near {
        let (mode, fault) = last;
        return Err(Violation::NotRecovered { mode, fault });
    }
    Ok(Outcome { digest, injected })
}
