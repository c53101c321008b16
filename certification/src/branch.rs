//! The bound over a whole box, as the greatest over parts of it: branch and bound, the part with the largest bound first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::bound::{Bound, Bounder};
use crate::interval::Interval;

/// A part of the box, and the bound over it.
#[derive(Clone, Debug)]
pub struct Part {
    /// The ranges of the coordinates.
    pub states: Vec<Interval>,
    /// The bound.
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

/// What was proven of an output over the whole box.
#[derive(Clone, Debug)]
pub struct Proven {
    /// The greatest bound of a part.
    pub bound: Bound,
    /// The range of the output: the hull of the parts' ranges.
    pub range: Interval,
    /// The same sum of errors at single states, of which the greatest was found: no split gets below it.
    pub reached: f64,
    /// All parts, which together are the whole box.
    pub parts: Vec<Part>,
}

/// Bounds an output over a box by that many parts.
pub fn prove(bounder: &mut Bounder, whole: &[Interval], most: usize) -> Proven {
    let axes = bounder.axes();
    let part = |bounder: &mut Bounder, states: Vec<Interval>| {
        let bound = bounder.bound(&states);
        Part { range: bounder.range(), states, bound }
    };
    let mut queue = BinaryHeap::from([part(bounder, whole.to_vec())]);
    let mut reached = 0.0_f64;
    while queue.len() < most {
        let Some(worst) = queue.pop() else { break };
        let centre: Vec<Interval> = worst.states.iter().map(|x| Interval::point(0.5 * (x.low + x.high))).collect();
        reached = reached.max(bounder.bound(&centre).total());
        let Some(halves) = split(bounder, &worst, whole, &axes, &part) else {
            queue.push(worst);
            break;
        };
        queue.extend(halves);
    }
    let parts = queue.into_vec();
    let bound = parts.iter().max().map_or_else(Bound::default, |part| part.bound);
    let hull = |a: Interval, b: &Part| Interval::new(a.low.min(b.range.low), a.high.max(b.range.high));
    let range = parts.iter().fold(Interval::new(f64::INFINITY, f64::NEG_INFINITY), hull);
    Proven { bound, range, reached, parts }
}

/// A part's halves along the coordinate that lowers their bounds most; no halves of a part too small to have any.
fn split(
    bounder: &mut Bounder,
    part: &Part,
    whole: &[Interval],
    axes: &[usize],
    bounded: &impl Fn(&mut Bounder, Vec<Interval>) -> Part,
) -> Option<[Part; 2]> {
    let mut best: Option<(f64, [Part; 2])> = None;
    for &axis in axes {
        let Interval { low, high } = part.states[axis];
        let middle = 0.5 * (low + high);
        if high - low < 1e-3 * (whole[axis].high - whole[axis].low) || !(low < middle && middle < high) {
            continue;
        }
        let halves = [Interval::new(low, middle), Interval::new(middle, high)].map(|half| {
            let mut states = part.states.clone();
            states[axis] = half;
            bounded(bounder, states)
        });
        let sum: f64 = halves.iter().map(|half| half.bound.total().powi(2)).sum();
        if best.as_ref().is_none_or(|(least, _)| sum < *least) {
            best = Some((sum, halves));
        }
    }
    best.map(|(_, halves)| halves)
}
