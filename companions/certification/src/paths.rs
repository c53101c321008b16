//! The proof that every state of the box takes the execution path that the walk has followed.
//!
//! A branch depends on the order of two computed numbers. Intervals of their difference, over parts
//! of the box, hold exact and computed values; where they exclude zero, the order is the same
//! everywhere. Equal are only numbers that are the same constant, such as sums of finite numbers
//! times zero.

use std::cmp::Ordering;

use crate::bound::{Bounder, SineErrors};
use crate::error::{Error, Result};
use crate::graph::Graph;
use crate::interval::Interval;
use crate::state_box::Robot;
use crate::walk::{Comparison, Walked};

/// Proves of all comparisons that their order is the same in the whole box, each by at most so many
/// parts.
///
/// # Errors
/// [`Error::Branch`] of the first comparison whose order is not proven, [`Error::Missing`] of an
/// input that the box does not bound.
pub fn prove(walked: &Walked, robot: &Robot, sines: SineErrors, parts: usize) -> Result<()> {
    for comparison in &walked.comparisons {
        let undecided = each(&walked.graph, comparison, robot, sines, parts)?;
        if let Some(states) = undecided {
            return Err(Error::Branch {
                address: comparison.address,
                ordering: comparison.ordering,
                states,
            });
        }
    }
    Ok(())
}

/// A part of the box of which the order is not proven; none if there is no such part.
fn each(
    graph: &Graph,
    comparison: &Comparison,
    robot: &Robot,
    sines: SineErrors,
    parts: usize,
) -> Result<Option<Vec<Interval>>> {
    let [a, b] = comparison.nodes;
    let graph = graph.of_difference(a, b);
    let bounder = Bounder::new(&graph, 0, robot, sines);
    let mut bounder =
        bounder.ok_or_else(|| Error::Missing("an input that the box bounds".to_owned()))?;
    let (mut open, mut left) = (vec![robot.whole()], parts);
    while let Some(part) = open.pop() {
        bounder.bound(&part);
        let range = bounder.range();
        let is_so = match comparison.ordering {
            Ordering::Less => range.high < 0.0,
            Ordering::Equal => range.is_zero(),
            Ordering::Greater => range.low > 0.0,
        };
        if is_so && bounder.is_finite() {
            continue;
        }
        let halves = decisive(&mut bounder, &part).and_then(|axis| halves(&part, axis));
        let Some(halves) = halves.filter(|_| left > 0) else {
            return Ok(Some(part));
        };
        left -= 1;
        open.extend(halves);
    }
    Ok(None)
}

/// The halves of a part along a coordinate; none if it is too narrow.
pub(crate) fn halves(part: &[Interval], axis: usize) -> Option<[Vec<Interval>; 2]> {
    let Interval { low, high } = part[axis];
    let middle = 0.5 * (low + high);
    (low < middle && middle < high).then(|| {
        [Interval::new(low, middle), Interval::new(middle, high)].map(|half| {
            let mut states = part.to_vec();
            states[axis] = half;
            states
        })
    })
}

/// The coordinate without whose width most numbers become finite, and then the result's range the
/// narrowest.
pub(crate) fn decisive(bounder: &mut Bounder, part: &[Interval]) -> Option<usize> {
    let mut best: Option<(f64, usize)> = None;
    for axis in bounder.axes() {
        let mut states = part.to_vec();
        let Interval { low, high } = part[axis];
        states[axis] = Interval::point(0.5 * (low + high));
        bounder.bound(&states);
        let Interval { low: least, high: most } = bounder.range();
        let width = if bounder.is_finite() { most - least } else { f64::INFINITY };
        // Among coordinates that leave the range infinite, the widest is taken.
        let key = if width.is_finite() { width } else { 1e300 / (1.0 + high - low) };
        if low < high && best.is_none_or(|(least, _)| key < least) {
            best = Some((key, axis));
        }
    }
    best.map(|best| best.1)
}
