//! A constant torque at each joint: τ = τ₀.

use crate::effects::{Effect, JointState};
use crate::scalar::Real;
use crate::state::entry;

/// The torque that the motor of each joint supplies in any state, N·m or N.
///
/// It is the offset of a torque sensor, or the mean of a friction that differs with direction, as
/// identification finds it. Cost: one flop a joint.
///
/// ```
/// use dynamics_core::{Core, effects::ConstantTorque, robots::Ur5e, state::State};
/// let offset = ConstantTorque([0.5_f32; 6]);
/// assert_eq!(Core::<Ur5e>::rnea(&State::at([0.3; 6]), &(offset,)), [0.5; 6]);
/// ```
#[doc(alias = "torque offset")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantTorque<R, const V: usize>(
    /// Torque τ₀ of each joint, N·m or N.
    pub [R; V],
);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for ConstantTorque<R, V> {
    const DIFFERENTIABLE: bool = true;
    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, _: JointState<R>, tau: &mut R) {
        *tau += entry(&self.0, joint);
    }
}
