//! One arm under random faults.

use std::collections::BTreeSet;

use dynamics_core::control::{Mode, Trajectory, WayPoint};

use super::arm::{Arm, Episode};
use super::kinds::{Kind, Onset};
use super::plants::{Plant, TICK};

/// Ticks of a run: faults begin in the first part.
pub const TICKS: u32 = 6000;
const FAULTY: u32 = 2600;
/// Ticks without a fault before a stopped arm is started again.
const QUIET: u32 = 20;

/// Marsaglia's xorshift32 (2003).
pub struct Random(u32);

impl Random {
    pub fn new(seed: u32) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9) | 1);
        (0..8).for_each(|_| _ = random.below(2));
        random
    }

    pub fn below(&mut self, n: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        ((u64::from(self.0) * u64::from(n)) >> 32) as u32
    }
}

/// What was observed of a fault that came alone while the arm followed its motion.
#[derive(Clone, Copy, Debug)]
pub struct Observed {
    pub kind: Kind,
    /// Ticks from its begin to its report; none if it had no effect.
    pub latency: Option<u32>,
    /// The modes after it: held, stopped.
    pub held: bool,
    pub stopped: bool,
}

/// A tick of a plant that moves at this share of its rated speeds.
pub fn at_speed<P: Plant<V>, const V: usize>(share: f32) -> Result<(), String> {
    let point = WayPoint {
        q: P::HOME,
        qd: [0.0; V],
        ticks: 0,
    };
    let rest = Trajectory::new(&[point; 1], TICK, &[P::MOTION; V]).map_err(|e| e.to_string())?;
    let mut torque = P::feed_forward(&rest.at(0));
    let points = [
        point,
        WayPoint { ticks: 1, ..point },
        WayPoint { ticks: 1, ..point },
    ];
    let motion = Trajectory::new(&points, TICK, &[P::MOTION; V]).map_err(|e| e.to_string())?;
    let mut arm = Arm::<P, V>::new(&motion, 1.0);
    arm.state.qd = P::LIMITS.speed.map(|speed| share * speed);
    core::mem::swap(&mut arm.torque, &mut torque);
    arm.advance()
}

/// Runs an arm under the faults of a seed; what was observed of each, or which limit did not hold and when.
pub fn run<P: Plant<V>, const V: usize>(seed: u32, broken: f32) -> Result<Vec<Observed>, String> {
    let mut random = Random::new(seed);
    let stop = |q, ticks| WayPoint {
        q,
        qd: [0.0; V],
        ticks,
    };
    let points = [stop(P::HOME, 0), stop(P::AWAY, 1500), stop(P::HOME, 1500)];
    let motion = Trajectory::new(&points, TICK, &[P::MOTION; V]).map_err(|e| e.to_string())?;
    let mut arm = Arm::<P, V>::new(&motion, broken);
    let (mut episodes, mut observed, mut kinds) =
        (Vec::<Episode>::new(), Vec::new(), BTreeSet::new());
    let (mut next, mut watched, mut quiet) = (100 + random.below(600), None::<(usize, u32)>, 0);
    let mut last = None;
    for now in 0..TICKS {
        episodes.retain(|episode| now <= episode.ticks[1]);
        if now == next && now < FAULTY {
            let onset = Onset::random(&mut random);
            kinds.insert(onset.kind);
            let alone = episodes.is_empty() && quiet > 300 && arm.back_off.is_none();
            watched = None;
            if alone {
                observed.push(Observed {
                    kind: onset.kind,
                    latency: None,
                    held: false,
                    stopped: false,
                });
                watched = Some((observed.len() - 1, now));
            }
            let held = arm.state.q[onset.joint as usize % V];
            let end = now + 1 + random.below(180);
            episodes.push(Episode {
                onset,
                ticks: [now, end],
                held,
            });
            let soon = random.below(3) == 0;
            next = now + 1 + random.below(if soon { 60 } else { 900 });
        }
        let (mode, fault) = arm
            .tick(now, &episodes)
            .map_err(|what| format!("tick {now}: {what}"))?;
        last = Some((mode, fault, arm.back_off.is_some()));
        quiet = if fault.is_some() || !episodes.is_empty() {
            0
        } else {
            quiet + 1
        };
        if let Some((index, begin)) = watched {
            let one = &mut observed[index];
            if one.latency.is_none() && fault.is_some_and(|fault| one.kind.is(fault)) {
                one.latency = Some(now - begin);
            }
            one.held |= mode == Mode::Hold;
            one.stopped |= mode == Mode::Stopped;
        }
        let idle = mode == Mode::Stopped || mode == Mode::Hold;
        if idle && episodes.is_empty() && now % QUIET == 0 && arm.recover(&motion)? {
            watched = None;
        }
    }
    let apart = (0..V).map(|j| (arm.state.q[j] - arm.controller.reference().q[j]).abs());
    if arm.controller.mode() != Mode::Full || !apart.clone().all(|apart| apart < 0.02) {
        let apart: Vec<f32> = apart.collect();
        return Err(format!("no recovery: {last:?} {apart:?} after {kinds:?}"));
    }
    Ok(observed)
}
