//! The reference of an arm that is held after a fault.

use super::Estimate;
use crate::scalar::Real;
use crate::state::State;

/// The reference of an arm in [`Mode::Hold`](super::Mode::Hold): it is where the observer has it, and its speed
/// decays, q̈ = −λ q̇.
///
/// Inverse dynamics of it slows the joints down together; `decay` is λ in 1/s, about ω_n of the feedback.
///
/// The feedback of this reference is zero. With damping by K_d in place of this acceleration, the joint that slows down
/// swings the others back; with λ = 2 ζ ω_n a fast arm needs more torque than it has. A law whose feed-forward has no
/// inertia in it takes this reference with q̇ = 0, and K_d slows the joints down.
///
/// # Cost
/// 1 flop a joint, the same instructions whatever the data.
///
/// ```
/// use dynamics_core::control::{Estimate, hold};
/// let reference = hold(&Estimate { q: [0.5_f32], qd: [2.0] }, 25.0);
/// assert_eq!((reference.q, reference.qd, reference.qdd), ([0.5], [2.0], [-50.0]));
/// ```
#[inline(always)]
pub fn hold<R: Real, const V: usize>(estimate: &Estimate<R, V>, decay: R) -> State<R, V, V> {
    State {
        q: estimate.q,
        qd: estimate.qd,
        qdd: estimate.qd.map(|qd| -(decay * qd)),
    }
}
