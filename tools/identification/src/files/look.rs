//! A look at the positions and torques before any fit: single bad samples, jumps by a whole turn,
//! channels that stand still.
//!
//! A sample is bad if it is far from the median of the five around it: Hampel, "The influence curve
//! and its role in robust estimation" (1974), as the filter of Davies & Gather, "The identification
//! of multiple outliers" (1993). Far is what the description's speed does not allow.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;

use robot_import::description::Kind;

use super::error::{Error, Problem};
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
/// More than this share of samples are no single ones, and stay.
const SINGLE: f64 = 0.02;
/// The most rows that are listed.
const LISTED: usize = 20;
/// A channel that stands still this long, s and samples, while the joint moves.
const STILL: f64 = 0.5;
const STILL_SAMPLES: usize = 15;
/// No joint comes to rest or leaves it faster, rad/s² or m/s², over this time, s, and so many
/// samples.
const HARD: f64 = 100.0;
const NEAR: f64 = 0.02;
const NEAR_SAMPLES: usize = 5;
/// The motion during which a torque changes, rad or m, if no more than this share of its samples
/// are the one before: others are coarse.
const MOVES: f64 = 0.1;
const SAME: f64 = 0.1;
/// Positions beyond this number of turns are in another unit.
const MOST_TURNS: f64 = 4.0;

/// Positions or torques of a joint.
#[derive(Clone, Copy)]
struct Channel {
    joint: usize,
    is_torque: bool,
    /// The greatest speed of the joint, rad/s or m/s.
    speed: f64,
}

impl Channel {
    fn of(self, row: &(f64, Row)) -> f64 {
        if self.is_torque { row.1.1[self.joint] } else { row.1.0[self.joint] }
    }

    fn all(self, timed: &[Timed]) -> impl Iterator<Item = f64> {
        timed.iter().flatten().map(move |row| self.of(row))
    }

    fn is_constant(self, timed: &[Timed]) -> bool {
        let first = self.all(timed).next();
        self.all(timed).all(|value| Some(value) == first)
    }

    /// The stretch and the row of each sample that jumps and comes back, or how the channel says
    /// nothing.
    fn spikes(self, timed: &[Timed], tick: f64) -> Result<Vec<[usize; 2]>, String> {
        if self.is_torque && self.is_constant(timed) {
            let value = self.all(timed).next().unwrap_or_default();
            return Err(format!("is {value} in every row: it was not recorded (--lock, --joints)"));
        }
        let mut all = Vec::new();
        for (at, rows) in timed.iter().enumerate() {
            for k in 0..rows.len() {
                let beside = BESIDE.min(k).min(rows.len() - 1 - k);
                let near = rows[k - beside..=k + beside].iter().map(|row| self.of(row));
                all.push(([at, k], (self.of(&rows[k]) - quantile(near, 0.5)).abs()));
            }
        }
        let noise = DEVIATIONS * NORMAL * quantile(all.iter().map(|(_, off)| *off), 0.5);
        let least = match self.is_torque {
            true => SHARE * quantile(self.all(timed).map(f64::abs), 0.99),
            false => TIMES * self.speed * tick + RESOLUTION,
        };
        let rows = all.len();
        all.retain(|(_, off)| *off > least.max(noise));
        match all.len() as f64 <= SINGLE * rows as f64 {
            true => Ok(all.into_iter().map(|(at, _)| at).collect()),
            // Torques may have any noise.
            false if self.is_torque => Ok(Vec::new()),
            false => {
                let count = all.len();
                Err(format!("jumps faster than the joint, and back, {count} times in {rows} rows"))
            }
        }
    }

    /// The first and the last row of a time in which the channel stands still while the joint
    /// moves.
    fn still(self, rows: &Timed, tick: f64) -> Option<[usize; 2]> {
        let near = NEAR_SAMPLES.max((NEAR / tick).ceil() as usize);
        // Whether a row near the end of a run is farther away than is possible.
        let leaves = |from: usize, to: usize| {
            let time = (rows[from].0 - rows[to].0).abs();
            let way = (self.of(&rows[from]) - self.of(&rows[to])).abs() - RESOLUTION;
            let most = match from.abs_diff(to) {
                1 => TIMES * self.speed * time,
                _ => 0.5 * HARD * time * time,
            };
            // A gap shows nothing of how the joint came there.
            way > most && time < 2.0 * tick * near as f64
        };
        let same = rows.windows(2).filter(|pair| self.of(&pair[0]) == self.of(&pair[1])).count();
        let mut next = 0;
        rows.chunk_by(|a, b| self.of(a) == self.of(b)).find_map(|run| {
            let [first, last] = [next, next + run.len() - 1];
            next += run.len();
            let is_long = run.len() > STILL_SAMPLES && rows[last].0 - rows[first].0 > STILL;
            let moves = || match self.is_torque {
                true => {
                    let q = run.iter().map(|row| row.1.0[self.joint]);
                    let way = q.clone().fold(f64::MIN, f64::max) - q.fold(f64::MAX, f64::min);
                    let others = same + 1 - run.len();
                    way > MOVES && (others as f64) < SAME * rows.len() as f64
                }
                false => [1, near].into_iter().any(|by| {
                    leaves(last, (last + by).min(rows.len() - 1))
                        || leaves(first, first.saturating_sub(by))
                }),
            };
            (is_long && moves()).then_some([first, last])
        })
    }

    /// Undoes jumps by whole turns, and brings each stretch within the limits; returns the jumps.
    fn unwrap(self, timed: &mut [Timed], limits: Option<[f64; 2]>) -> usize {
        if quantile(self.all(timed).map(f64::abs), 0.95) > MOST_TURNS * TAU {
            return 0;
        }
        let mut jumps = 0;
        for rows in timed {
            let (mut turns, mut last) = (0.0, None);
            for (time, (all, _)) in rows.iter_mut() {
                let own = all[self.joint];
                let [before, at] = last.replace([own, *time]).unwrap_or([own, *time]);
                let (step, whole) = (own - before, ((own - before) / TAU).round());
                let way = TIMES * self.speed * (*time - at) + RESOLUTION;
                if whole != 0.0 && (step - TAU * whole).abs() < way && step.abs() > 2.0 * way {
                    jumps += 1;
                    turns += whole;
                }
                all[self.joint] = own - TAU * turns;
            }
            let middle = quantile(rows.iter().map(|row| self.of(row)), 0.5);
            let beyond = limits.filter(|[lower, upper]| !(*lower..=*upper).contains(&middle));
            let whole = beyond.map_or(0.0, |[a, b]| ((middle - 0.5 * (a + b)) / TAU).round());
            jumps += usize::from(whole != 0.0);
            rows.iter_mut().for_each(|(_, (all, _))| all[self.joint] -= TAU * whole);
        }
        jumps
    }

    /// The speed of a joint whose description has none: what 99 of 100 intervals do not exceed,
    /// twice.
    fn fastest(self, timed: &[Timed]) -> f64 {
        let pairs = timed.iter().flat_map(|rows| rows.windows(2));
        let speed = |[a, b]: [&(f64, Row); 2]| (self.of(b) - self.of(a)).abs() / (b.0 - a.0);
        2.0 * quantile(pairs.map(|pair| speed([&pair[0], &pair[1]])), 0.99)
    }
}

/// The value below which this share of all lie.
fn quantile(all: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut all: Vec<f64> = all.collect();
    let at = (share * all.len().saturating_sub(1) as f64).round() as usize;
    match all.is_empty() {
        true => 0.0,
        false => *all.select_nth_unstable_by(at, f64::total_cmp).1,
    }
}

/// The recording without the samples that are bad, and what was found, in sentences.
///
/// # Errors
/// [`Error`] names the joint of a channel that says nothing, and the time.
pub(crate) fn at<'a>(
    robot: &Robot,
    path: &Path,
    recorded: &'a Recorded,
) -> Result<(Cow<'a, Recorded>, Vec<String>), Error> {
    let failed = |problem| Error::Recording { path: path.to_owned(), problem };
    let (mut all, mut look) = (recorded.timed.clone(), Vec::new());
    let start = all.first().and_then(|rows| rows.first()).map_or(0.0, |row| row.0);
    let (mut bad, mut is_changed, tick) = (BTreeMap::new(), false, recorded.tick);
    for (joint, body) in robot.imported.tree.bodies.iter().enumerate() {
        let (timed, name) = (&mut all, &body.joint);
        let q = Channel { joint, is_torque: false, speed: 0.0 };
        let q = Channel { speed: body.limits.velocity.unwrap_or_else(|| q.fastest(timed)), ..q };
        if q.is_constant(timed) {
            look.push(format!("the position of `{name}` is the same in every row"));
        }
        let limits = body.limits.position;
        let turns = if body.kind == Kind::Prismatic { 0 } else { q.unwrap(timed, limits) };
        if turns > 0 {
            is_changed = true;
            let what = format!("jumps of the position of `{name}` by whole turns were undone");
            look.push(format!("{turns} {what}"));
        }
        for (one, what) in [(q, "position"), (Channel { is_torque: true, ..q }, "torque")] {
            let channel = format!("{what} of `{name}`");
            let failed = |how| failed(Problem::Channel { channel: channel.clone(), how });
            let spikes = one.spikes(timed, tick).map_err(failed)?;
            let still = |rows| one.still(rows, tick).map(|[a, b]| [&rows[a], &rows[b]]);
            if let Some(rows) = timed.iter().find_map(still) {
                let ([from, to], value) = (rows.map(|row| row.0 - start), one.of(rows[0]));
                return Err(failed(format!(
                    "is exactly {value:.4} from {from:.3} s to {to:.3} s after the start while the \
                     joint moves: it stood still"
                )));
            }
            bad.extend(spikes.into_iter().map(|at| (at, channel.clone())));
        }
    }
    if bad.is_empty() && !is_changed {
        return Ok((Cow::Borrowed(recorded), look));
    }
    if !bad.is_empty() {
        let row = |(at, what): (&[usize; 2], &String)| {
            format!("{:.3} s ({what})", all[at[0]][at[1]].0 - start)
        };
        let rows: Vec<String> = bad.iter().take(LISTED).map(row).collect();
        let more = if bad.len() > LISTED { ", …" } else { "" };
        look.push(format!(
            "{} rows were dropped in which a single sample jumps and comes back: {}{more}",
            bad.len(),
            rows.join(", ")
        ));
    }
    for (at, rows) in all.iter_mut().enumerate() {
        let mut places = 0..;
        rows.retain(|_| places.next().is_none_or(|k| !bad.contains_key(&[at, k])));
    }
    all.retain(|rows| !rows.is_empty());
    let Sampling { left_out, duplicates, backward, .. } = recorded.sampling;
    let sampling = Sampling { left_out, duplicates, backward, ..Sampling::default() };
    let even = Recorded::even(recorded.joints, all, sampling, recorded.held).map_err(failed)?;
    Ok((Cow::Owned(even), look))
}
