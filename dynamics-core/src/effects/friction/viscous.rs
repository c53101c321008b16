//! Viscous friction: τ = b q̇.

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, JointState, TorqueDerivatives};
use crate::scalar::Real;

/// Viscous friction of each joint, N·m·s/rad or N·s/m: the motor supplies τ = b q̇.
///
/// Cost: a multiplication and an addition a joint. Source: Armstrong-Hélouvry (1991), chapter 2.
///
/// ```
/// use dynamics_core::{Core, effects::Viscous, robots::Ur5e, state::State};
/// let moving = State { qd: [2.0_f32; 6], ..State::at([0.0; 6]) };
/// assert_eq!(Core::<Ur5e>::rnea(&moving, &(Viscous([0.5; 6]),)), [1.0; 6]);
/// ```
///
/// Five values on six joints do not compile:
///
/// ```compile_fail,E0277
/// use dynamics_core::{Core, effects::Viscous, robots::Ur5e, state::State};
/// let _ = Core::<Ur5e>::rnea(&State::at([0.0_f32; 6]), &(Viscous([0.5_f32; 5]),));
/// ```
#[doc(alias = "damping")]
#[doc(alias = "damper")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscous<R, const V: usize>(pub [R; V]);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Viscous<R, V> {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::Viscous);

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        if let Some(&b) = self.0.get(joint) {
            *tau += b * at.qd;
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, _: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        if let Some(&b) = self.0.get(joint) {
            derivatives.dqd += b;
        }
    }
}
