//! The bound over a whole box, as the greatest over parts of it: branch and bound, the part with
//! the largest bound first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::bound::{Bound, Bounder};
use crate::interval::Interval;
use crate::paths;

/// A part of the box, and the bound over it.
#[derive(Clone, Debug)]
pub struct Part {
    /// The ranges of the coordinates.
    pub states: Vec<Interval>,
    /// The bound of the error over this part.
    pub bound: Bound,
    /// The range of the output.
    pub range: Interval,
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Part {}
impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Part {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total().total_cmp(&other.bound.total())
    }
}

/// The result of the proof of one output over the whole box.
#[derive(Clone, Debug)]
pub struct Proven {
    /// The greatest bound of a part.
    pub bound: Bound,
    /// The range of the output: the hull of the parts' ranges.
    pub range: Interval,
    /// The same sum of errors at single states, of which the greatest was found: no split gets
    /// below it.
    pub reached: f64,
    /// All parts, which together are the whole box.
    pub parts: Vec<Part>,
    /// The greatest absolute value of each node over the box.
    pub magnitudes: Vec<f64>,
}

/// Bounds an output over a box by that many parts.
pub fn prove(bounder: &mut Bounder, whole: &[Interval], most: usize) -> Proven {
    let mut queue = BinaryHeap::from([bounded(bounder, whole.to_vec())]);
    let (mut reached, mut gains) = (0.0_f64, Gains::new(bounder.axes()));
    while queue.len() < most {
        let Some(worst) = queue.pop() else { break };
        let state: Vec<Interval> =
            worst.states.iter().map(|x| Interval::point(outermost(*x))).collect();
        reached = reached.max(bounder.bound(&state).total());
        let Some(halves) = split(bounder, &worst, whole, &mut gains) else {
            queue.push(worst);
            break;
        };
        queue.extend(halves);
    }
    let parts = queue.into_vec();
    let bound = parts.iter().max().map_or_else(Bound::default, |part| part.bound);
    let hull =
        |a: Interval, b: &Part| Interval::new(a.low.min(b.range.low), a.high.max(b.range.high));
    let range = parts.iter().fold(Interval::new(f64::INFINITY, f64::NEG_INFINITY), hull);
    let mut magnitudes = vec![0.0_f64; bounder.values.len()];
    for part in &parts {
        bounder.bound(&part.states);
        for (most, value) in magnitudes.iter_mut().zip(&bounder.values) {
            *most = most.max(value.magnitude());
        }
    }
    Proven { magnitudes, bound, range, reached, parts }
}

fn bounded(bounder: &mut Bounder, states: Vec<Interval>) -> Part {
    let bound = bounder.bound(&states);
    Part { range: bounder.range(), states, bound }
}

/// The end of a range that is further from zero: speeds and accelerations at their limits have the
/// largest errors.
fn outermost(x: Interval) -> f64 {
    if x.high.abs() >= x.low.abs() { x.high } else { x.low }
}

/// The gain of the splits along each coordinate so far.
struct Gains {
    axes: Vec<usize>,
    /// The mean share of the bound that was left, by place in `axes` and number of splits of it
    /// before.
    left: Vec<[Option<f64>; DEEPEST]>,
}

/// Splits of one coordinate within each other.
const DEEPEST: usize = 14;
/// Coordinates tried at each split: those that gained most before.
const TRIED: usize = 3;

impl Gains {
    fn new(axes: Vec<usize>) -> Self {
        Self { left: vec![[None; DEEPEST]; axes.len()], axes }
    }

    /// The coordinates to try, as places in `axes` with their depths; those never tried at their
    /// depth come first.
    fn candidates(&self, part: &Part, whole: &[Interval]) -> Vec<(usize, usize)> {
        let width = |x: Interval| x.high - x.low;
        let depth = |axis: usize| (width(whole[axis]) / width(part.states[axis])).log2().round();
        let places = self.axes.iter().enumerate().map(|(place, axis)| (place, depth(*axis)));
        let mut open: Vec<(usize, usize)> = places
            .filter(|(_, depth)| *depth < DEEPEST as f64)
            .map(|(place, depth)| (place, depth as usize))
            .collect();
        open.sort_by(|a, b| {
            let left = |(place, depth): &(usize, usize)| self.left[*place][*depth].unwrap_or(0.0);
            left(a).total_cmp(&left(b))
        });
        open.truncate(TRIED);
        open
    }

    fn note(&mut self, (place, depth): (usize, usize), left: f64) {
        let mean = &mut self.left[place][depth];
        *mean = Some(mean.map_or(left, |mean| mean + 0.1 * (left - mean)));
    }
}

/// A part's halves along the coordinate that lowers their bounds most; no halves of a part too
/// small to have any.
fn split(
    bounder: &mut Bounder,
    part: &Part,
    whole: &[Interval],
    gains: &mut Gains,
) -> Option<[Part; 2]> {
    if part.bound.total().is_infinite() {
        // If there is no bound yet, no gain can be measured either.
        let halves = paths::halves(&part.states, paths::decisive(bounder, &part.states)?)?;
        return Some(halves.map(|states| bounded(bounder, states)));
    }
    let mut best: Option<(f64, [Part; 2])> = None;
    for candidate in gains.candidates(part, whole) {
        let axis = gains.axes[candidate.0];
        let Interval { low, high } = part.states[axis];
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            continue;
        }
        let halves = [Interval::new(low, middle), Interval::new(middle, high)].map(|half| {
            let mut states = part.states.clone();
            states[axis] = half;
            bounded(bounder, states)
        });
        // The share of the bound that both halves leave.
        let left =
            halves.iter().map(|half| half.bound.total() / part.bound.total()).sum::<f64>() / 2.0;
        gains.note(candidate, left);
        if best.as_ref().is_none_or(|(least, _)| left < *least) {
            best = Some((left, halves));
        }
    }
    best.map(|(_, halves)| halves)
}
