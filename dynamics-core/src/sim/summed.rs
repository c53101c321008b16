//! Many small increments on a large number, with or without what rounding takes from each.

use super::Increments;
use crate::scalar::Real;
use crate::state::State;

/// Position and velocity of V joints that increments are added to; `COMPENSATED`, what rounding took from an increment
/// is added with the next.
///
/// Kahan, "Further remarks on reducing truncation errors" (1965). In f32 a step of 10 µs at 1 rad/s adds 10⁻⁵ rad, of
/// which rounding at 3 rad takes up to one part in a hundred: without compensation finer steps are worse. 3 flops
/// more a coordinate.
///
/// ```
/// use dynamics_core::{sim::Summed, state::State};
/// let mut plain = Summed::<f32, 1, false>::at(State::at([3.0]));
/// let mut compensated = Summed::<f32, 1, true>::at(State::at([3.0]));
/// for _ in 0..10_000 {
///     plain.add([[1e-7], [0.0]]);
///     compensated.add([[1e-7], [0.0]]);
/// }
/// assert_eq!(plain.state.q[0], 3.0); // lost, every one
/// assert!((compensated.state.q[0] - 3.001).abs() < 3e-7);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Summed<R, const V: usize, const COMPENSATED: bool> {
    /// Position and velocity; the acceleration stays as it is.
    pub state: State<R, V, V>,
    lost: Increments<R, V>,
}

impl<R: Real, const V: usize, const COMPENSATED: bool> Summed<R, V, COMPENSATED> {
    /// At a state that is exact.
    pub fn at(state: State<R, V, V>) -> Self {
        Self {
            state,
            lost: [[R::ZERO; V]; 2],
        }
    }

    /// A step on.
    pub fn add(&mut self, [q, qd]: Increments<R, V>) {
        let [lost_q, lost_qd] = &mut self.lost;
        add::<R, COMPENSATED>(&mut self.state.q, lost_q, &q);
        add::<R, COMPENSATED>(&mut self.state.qd, lost_qd, &qd);
    }
}

fn add<R: Real, const COMPENSATED: bool>(sums: &mut [R], lost: &mut [R], increments: &[R]) {
    for ((sum, lost), &increment) in sums.iter_mut().zip(lost).zip(increments) {
        if COMPENSATED {
            let wanted = increment - *lost;
            let new = *sum + wanted;
            *lost = (new - *sum) - wanted;
            *sum = new;
        } else {
            *sum += increment;
        }
    }
}
