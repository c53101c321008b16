//! A spring at each joint: τ = k (q − q₀).

use crate::effects::{Effect, JointState, TorqueDerivatives};
use crate::scalar::Real;
use crate::state::entry;

/// A linear spring at each joint with its rest position: the motor supplies τ = k (q − q₀).
///
/// Cost: three flops a joint. Source: Hooke (1678). The plant may treat it implicitly: see
/// [`Implicit`](crate::effects::Implicit).
///
/// ```
/// use dynamics_core::{Core, effects::Spring, robots::Ur5e, state::State};
/// let springs = Spring { stiffness: [10.0_f32; 6], rest: [0.5; 6] };
/// assert_eq!(Core::<Ur5e>::rnea(&State::at([1.5; 6]), &(springs,)), [10.0; 6]);
/// ```
#[doc(alias = "joint stiffness")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring<R, const V: usize> {
    /// Stiffness k, N·m/rad or N/m.
    pub stiffness: [R; V],
    /// Rest position q₀, rad or m.
    pub rest: [R; V],
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Spring<R, V> {
    const DIFFERENTIABLE: bool = true;
    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        *tau += entry(&self.stiffness, joint) * (at.q - entry(&self.rest, joint));
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, _: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        derivatives.dq += entry(&self.stiffness, joint);
    }
}
