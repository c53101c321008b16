//! The reference of an arm that is held after a fault.

use crate::estimate::Estimate;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// The reference of an arm in [`Mode::Hold`](crate::limits::Mode::Hold): its estimated position,
/// with a velocity that decays, q̈ = −λ q̇.
///
/// Inverse dynamics of this reference decelerates all joints together; `decay` is λ in 1/s, about
/// ω_n of the feedback.
///
/// The feedback of this reference is zero. Damping by K_d in place of this acceleration reverses
/// joints: the joint that decelerates accelerates the others. With λ = 2 ζ ω_n a fast arm needs
/// more torque than it has. A law without inertia in its feed-forward uses this reference with q̇ =
/// 0, and K_d decelerates the joints.
///
/// # Cost
/// 1 flop per joint, with the same instructions for all data.
///
/// ```
/// use motion_control::{estimate::Estimate, motion::hold};
/// let reference = hold(&Estimate { q: [0.5_f32], qd: [2.0] }, 25.0);
/// assert_eq!((reference.q, reference.qd, reference.qdd), ([0.5], [2.0], [-50.0]));
/// ```
#[inline(always)]
pub fn hold<R: Real, const V: usize>(estimate: &Estimate<R, V>, decay: R) -> State<R, V, V> {
    State { q: estimate.q, qd: estimate.qd, qdd: estimate.qd.map(|qd| -(decay * qd)) }
}
