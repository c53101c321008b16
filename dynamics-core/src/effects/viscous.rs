//! Viscous friction: τ = b q̇.

use super::{Effect, JointState};
use crate::scalar::Real;

/// Viscous friction of each joint, N·m·s/rad or N·s/m: the motor supplies τ = b q̇.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscous<R, const V: usize>(pub [R; V]);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Viscous<R, V> {
    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        if let Some(&b) = self.0.get(joint) {
            *tau += b * at.qd;
        }
    }
}
