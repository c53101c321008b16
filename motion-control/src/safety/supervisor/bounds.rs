//! The range of accepted positions, which a [`crate::BackOff`] replaces within its ticks.

use super::Supervisor;
use dynamics_core::scalar::Real;

/// The middles and half widths of the ranges of positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ranges<R, const V: usize> {
    middle: [R; V],
    half: [R; V],
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// The least and the greatest position of each joint.
    pub(crate) fn bounds(&self) -> [[R; 2]; V] {
        let mut bounds = [[R::ZERO; 2]; V];
        let ranges = self.middle.iter().zip(&self.half);
        for (bounds, (&middle, &half)) in bounds.iter_mut().zip(ranges) {
            *bounds = [middle - half, middle + half];
        }
        bounds
    }

    /// Replaces the ranges by those between these bounds, and returns what they were.
    pub(crate) fn replace_bounds(&mut self, bounds: &[[R; 2]; V]) -> Ranges<R, V> {
        let before = Ranges {
            middle: self.middle,
            half: self.half,
        };
        let ranges = self.middle.iter_mut().zip(&mut self.half);
        for ((middle, half), &[lower, upper]) in ranges.zip(bounds) {
            let [a, b] = [lower, upper].map(|x| R::from_f64(0.5) * x);
            (*middle, *half) = (a + b, b - a);
        }
        before
    }

    /// Restores what [`Self::replace_bounds`] returned, to the bit.
    pub(crate) fn restore_bounds(&mut self, before: Ranges<R, V>) {
        (self.middle, self.half) = (before.middle, before.half);
    }

    /// The greatest torque of each joint.
    pub(crate) fn torque_limit(&self) -> &[R; V] {
        &self.torque_limit
    }

    /// The greatest plausible change of position in one tick.
    pub(crate) fn plausible_step(&self) -> &[R; V] {
        &self.plausible_step
    }
}
