//! Sines and cosines updated incrementally from tick to tick.

use core::hint::select_unpredictable;

use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::state::JointTrig;

/// The sines and cosines of N joints that move by small angles in each tick.
///
/// In each tick each pair is rotated by Δ = q − q₋ with Taylor's polynomials of degree 3 and 2, and normalised by one step
/// of Newton's iteration for sin² + cos² = 1. Rounding errors of the angle are not corrected: the angle drifts as a random
/// walk, in f32 by some 10⁻⁵ rad in 10⁴ ticks. [`IncrementalTrig::at`] starts again without drift.
///
/// Angles: |Δ| < 0.02 rad, an error of 10⁻⁸ a tick. If the angle of a joint jumps by 0.5 rad or more, or is NaN, the entry
/// is not updated: its `q` remains the angle of its sine and cosine, and a single wrong reading has no effect. After a
/// real jump, call [`IncrementalTrig::at`].
///
/// # Cost
/// 21 flops per joint, with the same instructions for all data.
///
/// ```
/// use dynamics_core::state::IncrementalTrig;
/// let mut turns = IncrementalTrig::at([0.3_f32]);
/// let trig = turns.follow(&[0.301]);
/// assert!((trig.coordinates[0].sin - 0.301_f32.sin()).abs() < 2e-7);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct IncrementalTrig<R, const N: usize> {
    trig: JointTrig<R, N>,
}

impl<R: Real, const N: usize> IncrementalTrig<R, N> {
    /// The joints at q, rad.
    pub fn at(q: [R; N]) -> Self {
        Self {
            trig: JointTrig {
                coordinates: q.map(JointCoordinate::revolute),
            },
        }
    }

    /// The same joints a tick later, at q.
    #[cfg_attr(optimised, inline(always))]
    pub fn follow(&mut self, q: &[R; N]) -> &JointTrig<R, N> {
        let [quarter, half, sixth, three_halves] = [0.25, 0.5, 1.0 / 6.0, 1.5].map(R::from_f64);
        for (turn, &q) in self.trig.coordinates.iter_mut().zip(q) {
            let d = q - turn.q;
            // False of a NaN, too.
            let near = d * d < quarter;
            let (d, q) = select_unpredictable(near, (d, q), (R::ZERO, turn.q));
            let u = d * d;
            let (ds, dc) = (d - d * (u * sixth), R::ONE - u * half);
            let (s, c) = (turn.sin * dc + turn.cos * ds, turn.cos * dc - turn.sin * ds);
            let to_unit = three_halves - half * (s * s + c * c);
            *turn = JointCoordinate {
                q,
                sin: s * to_unit,
                cos: c * to_unit,
            };
        }
        &self.trig
    }
}
