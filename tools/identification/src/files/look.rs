//! A look at the positions and torques before any fit: single bad samples, jumps by a whole turn,
//! encoders that stand still, and channels that are constant.
//!
//! A sample is bad if it is far from the median of the five around it: Hampel, "The influence curve
//! and its role in robust estimation" (1974), as the filter of Davies & Gather, "The identification
//! of multiple outliers" (1993). Far is what the description's speed does not allow.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use robot_import::description::Kind;
use robot_import::tree::Body;
use serde::Serialize;

use super::error::Problem;
use super::recorded::Recorded;
use super::resample::{Row, Sampling, Timed};
use super::robot::Robot;

/// Samples on either side of the one that is compared with their median.
const BESIDE: usize = 2;
/// A position is far from the median at more than this many times the way of an interval at the
/// greatest speed, and this more, rad or m: encoders are coarse and noisy.
const TIMES: f64 = 2.0;
const RESOLUTION: f64 = 5e-3;
/// The same of a torque, relative to what 99 of 100 samples do not exceed.
const SHARE: f64 = 0.5;
/// Both are far at more than this many standard deviations of all samples from their medians.
const DEVIATIONS: f64 = 12.0;
/// The standard deviation of noise with a median of its amounts of one.
const NORMAL: f64 = 1.4826;
/// More than this share of samples are no single ones.
const SINGLE: f64 = 0.02;
/// The most rows that are listed.
const LISTED: usize = 20;
/// An encoder that stands still this long, s and samples,
const STILL: f64 = 0.5;
const STILL_SAMPLES: usize = 15;
/// and before or after which the joint moves, within this time, s, and at least so many samples, as
/// far as none does from rest: at this acceleration, rad/s² or m/s².
const NEAR: f64 = 0.02;
const NEAR_SAMPLES: usize = 5;
const HARD: f64 = 100.0;

/// Positions beyond this number of turns are in another unit.
const MOST_TURNS: f64 = 4.0;

/// What was changed in a recording before it was fitted.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Look {
    /// Rows that were dropped, since a sample jumps and comes back; not all, if there are many.
    pub spikes: Vec<Spike>,
    /// Joints whose positions jumped by whole turns, and how often.
    pub turns: Vec<(String, usize)>,
}

/// A single bad sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spike {
    pub joint: String,
    /// The time since the first row, s.
    pub time: f64,
    pub is_torque: bool,
}

/// Positions and torques, and of which joint they are.
#[derive(Clone, Copy)]
struct Channel {
    joint: usize,
    is_torque: bool,
    /// The greatest speed, rad/s or m/s; none of a torque.
    speed: f64,
}

impl Channel {
    fn of(self, row: &(f64, Row)) -> f64 {
        if self.is_torque { row.1.1[self.joint] } else { row.1.0[self.joint] }
    }

    /// The value below whose amount this share of all lie.
    fn quantile(self, timed: &[Timed], share: f64) -> f64 {
        quantile(timed.iter().flatten().map(|row| self.of(row).abs()).collect(), share)
    }

    /// The stretch and the row of each sample that jumps and comes back.
    fn spikes(self, timed: &[Timed], tick: f64) -> Vec<[usize; 2]> {
        let off = |(at, rows): (usize, &Timed)| -> Vec<([usize; 2], f64)> {
            let off = |k: usize| {
                let beside = BESIDE.min(k).min(rows.len() - 1 - k);
                let mut near = [0.0; 2 * BESIDE + 1];
                let near = &mut near[..=2 * beside];
                near.iter_mut().zip(&rows[k - beside..]).for_each(|(x, row)| *x = self.of(row));
                near.sort_by(f64::total_cmp);
                ([at, k], (self.of(&rows[k]) - near[beside]).abs())
            };
            (0..rows.len()).map(off).collect()
        };
        let all: Vec<_> = timed.iter().enumerate().flat_map(off).collect();
        let noise = DEVIATIONS * NORMAL * quantile(all.iter().map(|(_, off)| *off).collect(), 0.5);
        let least = match self.is_torque {
            true => SHARE * self.quantile(timed, 0.99),
            false => TIMES * self.speed * tick + RESOLUTION,
        };
        all.into_iter().filter(|(_, off)| *off > least.max(noise)).map(|(at, _)| at).collect()
    }

    /// The first and the last row of a time in which an encoder stands still while the joint moves.
    fn still(self, rows: &Timed, tick: f64) -> Option<[usize; 2]> {
        let beside = NEAR_SAMPLES.max((NEAR / tick).ceil() as usize);
        let mut end = 0;
        for run in rows.chunk_by(|a, b| self.of(a) == self.of(b)) {
            let start = end;
            end += run.len();
            let [first, last] = [start, end - 1];
            if run.len() < STILL_SAMPLES || rows[last].0 - rows[first].0 < STILL {
                continue;
            }
            let leaves = |from: usize, to: usize| {
                let way = (self.of(&rows[from]) - self.of(&rows[to])).abs();
                let time = (rows[from].0 - rows[to].0).abs();
                let hard = 0.5 * HARD * time * time;
                let steps = from.abs_diff(to);
                let allowed = if steps == 1 { TIMES * self.speed * time } else { hard };
                // A gap shows nothing of how the joint came there.
                time < 2.0 * tick * beside as f64 && steps > 0 && way > allowed + RESOLUTION
            };
            let moves = [1, beside].into_iter().any(|by| {
                leaves(last, (last + by).min(rows.len() - 1))
                    || leaves(first, first.saturating_sub(by))
            });
            if moves {
                return Some([first, last]);
            }
        }
        None
    }
}

/// The value below which this share of all lie.
fn quantile(mut all: Vec<f64>, share: f64) -> f64 {
    let at = (share * all.len().saturating_sub(1) as f64).round() as usize;
    match all.is_empty() {
        true => 0.0,
        false => *all.select_nth_unstable_by(at, f64::total_cmp).1,
    }
}

/// The recording without the samples that are bad, and what was changed.
///
/// # Errors
/// [`Problem`] names the joint of a channel that says nothing, and the time.
pub(crate) fn at(robot: &Robot, recorded: &Recorded) -> Result<(Recorded, Look), Problem> {
    let (mut timed, mut look) = (recorded.timed.clone(), Look::default());
    let start = timed.first().and_then(|rows| rows.first()).map_or(0.0, |row| row.0);
    let mut bad = BTreeMap::new();
    for (joint, body) in robot.imported.tree.bodies.iter().enumerate() {
        let q = Channel { joint, is_torque: false, speed: 0.0 };
        let speed = body.limits.velocity.unwrap_or_else(|| fastest(q, &timed));
        let q = Channel { speed, ..q };
        if body.kind != Kind::Prismatic {
            let turns = unwrap(q, &mut timed, body.limits.position);
            look.turns.extend((turns > 0).then(|| (body.joint.clone(), turns)));
        }
        let found = single(q, body, &timed, [recorded.tick, start])?;
        bad.extend(found.into_iter().map(|(at, is_torque)| (at, (body.joint.clone(), is_torque))));
    }
    if bad.is_empty() && look.turns.is_empty() {
        return Ok((recorded.clone(), look));
    }
    let time = |at: &[usize; 2]| timed[at[0]][at[1]].0 - start;
    let spike = |(at, (joint, is_torque)): (_, &(String, bool))| Spike {
        joint: joint.clone(),
        time: time(at),
        is_torque: *is_torque,
    };
    look.spikes = bad.iter().take(LISTED).map(spike).collect();
    for (at, rows) in timed.iter_mut().enumerate() {
        let mut places = 0..;
        rows.retain(|_| places.next().is_none_or(|k| !bad.contains_key(&[at, k])));
    }
    timed.retain(|rows| !rows.is_empty());
    let Sampling { left_out, duplicates, backward, .. } = recorded.sampling;
    let spikes = bad.len();
    let sampling = Sampling { left_out, duplicates, backward, spikes, ..Sampling::default() };
    Ok((Recorded::even(recorded.joints, timed, sampling, recorded.held)?, look))
}

/// The samples of a joint that are bad, and whether they are torques.
fn single(
    q: Channel,
    body: &Body,
    timed: &[Timed],
    [tick, start]: [f64; 2],
) -> Result<Vec<([usize; 2], bool)>, Problem> {
    let (tau, joint) = (Channel { is_torque: true, ..q }, || body.joint.clone());
    let mut all = timed.iter().flatten().map(|row| tau.of(row));
    let value = all.next().unwrap_or_default();
    if all.all(|tau| tau == value) {
        return Err(Problem::Constant { joint: joint(), value });
    }
    let rows = timed.iter().map(Vec::len).sum::<usize>();
    let [positions, torques] = [q, tau].map(|channel| channel.spikes(timed, tick));
    let is_few = |found: &Vec<_>| found.len() as f64 <= SINGLE * rows as f64;
    // The fit names positions beyond limits.
    let most = body.limits.position.map_or(f64::MAX, |[a, b]| a.abs().max(b.abs()));
    if !is_few(&positions) && q.quantile(timed, 0.95) <= most {
        return Err(Problem::Jumps { joint: joint(), count: positions.len(), rows });
    }
    for rows in timed {
        if let Some([from, to]) = q.still(rows, tick) {
            let value = q.of(&rows[from]);
            let [from, to] = [from, to].map(|k| rows[k].0 - start);
            return Err(Problem::Still { joint: joint(), value, from, to });
        }
    }
    // Torques may have any noise.
    let few = [(positions, false), (torques, true)].into_iter().filter(|(found, _)| is_few(found));
    Ok(few.flat_map(|(found, kind)| found.into_iter().map(move |at| (at, kind))).collect())
}

/// The speed of a joint whose description has none: what 99 of 100 intervals do not exceed, twice.
fn fastest(q: Channel, timed: &[Timed]) -> f64 {
    let pairs = timed.iter().flat_map(|rows| rows.windows(2));
    let speeds =
        pairs.map(|pair| (q.of(&pair[1]) - q.of(&pair[0])).abs() / (pair[1].0 - pair[0].0));
    2.0 * quantile(speeds.collect(), 0.99)
}

/// Undoes jumps by whole turns, and brings each stretch within the limits; returns the jumps.
fn unwrap(q: Channel, timed: &mut [Timed], limits: Option<[f64; 2]>) -> usize {
    // These are no radians.
    if q.quantile(timed, 0.95) > MOST_TURNS * TAU {
        return 0;
    }
    let mut jumps = 0;
    for rows in timed {
        let (mut turns, mut last) = (0.0, None);
        for (time, (all, _)) in rows.iter_mut() {
            let (own, [before, at]) = (all[q.joint], last.unwrap_or([all[q.joint], *time]));
            let (step, whole) = (own - before, ((own - before) / TAU).round());
            let way = TIMES * q.speed * (*time - at) + RESOLUTION;
            if whole != 0.0 && (step - TAU * whole).abs() < way && step.abs() > 2.0 * way {
                jumps += 1;
                turns += whole;
            }
            last = Some([own, *time]);
            all[q.joint] = own - TAU * turns;
        }
        let middle = quantile(rows.iter().map(|row| q.of(row)).collect(), 0.5);
        let beyond = limits.filter(|[lower, upper]| !(*lower..=*upper).contains(&middle));
        let whole = beyond.map_or(0.0, |[a, b]| ((middle - 0.5 * (a + b)) / TAU).round());
        jumps += usize::from(whole != 0.0);
        rows.iter_mut().for_each(|(_, (all, _))| all[q.joint] -= TAU * whole);
    }
    jumps
}
