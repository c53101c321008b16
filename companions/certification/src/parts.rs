//! Parts of the positions that are split where a bound is largest.

use std::cmp::Ordering;

use crate::interval::Interval;

/// A part and the bound over it, by which it is ordered.
#[derive(Clone, Debug)]
pub struct Part {
    /// The bound over the part.
    pub bound: f64,
    /// The ranges of the joints' positions.
    pub positions: Vec<Interval>,
    /// The coordinate along which it is split next.
    pub axis: Option<usize>,
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
        self.bound.total_cmp(&other.bound)
    }
}

impl Part {
    /// The positions of both halves; none of a part that cannot be split.
    pub fn halves(&self) -> Option<[Vec<Interval>; 2]> {
        let axis = self.axis?;
        let Interval { low, high } = self.positions[axis];
        let middle = 0.5 * (low + high);
        (low < middle && middle < high).then(|| {
            [Interval::new(low, middle), Interval::new(middle, high)].map(|half| {
                let mut positions = self.positions.clone();
                positions[axis] = half;
                positions
            })
        })
    }
}

/// A small part of the box, where no slope is zero by chance.
pub(crate) fn somewhere(positions: &[Interval]) -> Vec<Interval> {
    let small = (0..).zip(positions).map(|(k, x)| {
        let share = 0.3 + 0.4 * (0.618 * f64::from(k)).fract();
        let middle = x.low + share * (x.high - x.low);
        let half = 0.01 * (x.high - x.low);
        Interval::new(middle - half, middle + half)
    });
    small.collect()
}

/// The slope along a coordinate wider than this says little about the range.
pub(crate) const WIDE: f64 = 1.6;

/// The widest of these coordinates, if it is wider than that.
pub(crate) fn wide(axes: &[usize], part: &[Interval], least: f64) -> Option<usize> {
    let width = |k: usize| part[k].high - part[k].low;
    let wide = axes.iter().copied().filter(|k| width(*k) > least);
    wide.max_by(|a, b| width(*a).total_cmp(&width(*b)))
}
