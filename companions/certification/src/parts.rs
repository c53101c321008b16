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
