//! Rotors behind gears, as inertia at the joints: τ = ρ² I_r q̈, without their gyroscopic torque.

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, JointState};
use crate::scalar::Real;

/// Rotor inertia reflected to each joint, ρ² I_r in kg·m² (ρ the gear ratio).
///
/// The diagonal approximation of Spong (1987): good at high gear ratios. Cost: a multiplication and
/// an addition a joint.
///
/// ```
/// use dynamics_core::{Core, effects::Armature, robots::Ur5e, state::State};
/// let starting = State { qdd: [4.0_f32; 6], ..State::at([0.0; 6]) };
/// assert_eq!(Core::<Ur5e>::rnea(&starting, &(Armature([0.25; 6]),)), [1.0; 6]);
/// ```
#[doc(alias = "rotor inertia")]
#[doc(alias = "reflected inertia")]
#[doc(alias = "motor inertia")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Armature<R, const V: usize>(pub [R; V]);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Armature<R, V> {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::Armature);

    // Its only hook is the next one.
    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, _: usize, _: JointState<R>, _: &mut R) {}

    #[cfg_attr(optimised, inline(always))]
    fn inertia(&self, joint: usize) -> Option<R> {
        self.0.get(joint).copied()
    }
}
