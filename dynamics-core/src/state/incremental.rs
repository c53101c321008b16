//! Sines and cosines updated incrementally from tick to tick.

use core::hint::select_unpredictable;

use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::state::JointTrig;

/// The sines and cosines of N joints that move by small angles in each tick.
///
/// In each tick each pair is rotated by Δ = q − q₋ with Taylor's polynomials of degree 3 and 2, but
/// for the pair of one joint, which is computed from its angle: each joint in turn, so that an
/// error lives for N ticks at most. Without that, increments below the rounding of a sine were all
/// rounded in one direction, and the angle drifted without bound: at rest between two readings by
/// 0.19 rad in 10⁷ ticks.
///
/// Angles: |Δ| < 0.02 rad. Then sines and cosines are off by at most N · 1.5 · 10⁻⁷ in f32 and N ·
/// 7 · 10⁻⁹ in f64, after any number of ticks. If the angle of a joint jumps by 0.5 rad or more, or
/// is NaN, the entry is not updated: its `q` remains the angle of its sine and cosine, and a single
/// wrong reading has no effect. After a real jump, call [`IncrementalTrig::at`].
///
/// # Cost
/// 15 flops per joint and one sine and cosine, with the same instructions for all data.
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
    /// The joint whose sine and cosine are computed from its angle in the next tick.
    next: usize,
}

impl<R: Real, const N: usize> IncrementalTrig<R, N> {
    /// The joints at q, rad.
    pub fn at(q: [R; N]) -> Self {
        Self { trig: JointTrig { coordinates: q.map(JointCoordinate::revolute) }, next: 0 }
    }

    /// The same joints a tick later, at q.
    #[cfg_attr(optimised, inline(always))]
    pub fn follow(&mut self, q: &[R; N]) -> &JointTrig<R, N> {
        let [quarter, half, sixth] = [0.25, 0.5, 1.0 / 6.0].map(R::from_f64);
        for (turn, &q) in self.trig.coordinates.iter_mut().zip(q) {
            let d = q - turn.q;
            // False of a NaN, too.
            let near = d * d < quarter;
            let (d, q) = select_unpredictable(near, (d, q), (R::ZERO, turn.q));
            let u = d * d;
            let (ds, dc) = (d - d * (u * sixth), R::ONE - u * half);
            *turn = JointCoordinate {
                q,
                sin: turn.sin * dc + turn.cos * ds,
                cos: turn.cos * dc - turn.sin * ds,
            };
        }
        if let Some(turn) = self.trig.coordinates.get_mut(self.next) {
            *turn = JointCoordinate::revolute(turn.q);
        }
        let after = self.next + 1;
        self.next = if after < N { after } else { 0 };
        &self.trig
    }
}
