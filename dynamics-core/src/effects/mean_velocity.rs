//! Effects of a step in which the bodies move at the step's mean velocity.

use super::delegate::delegate_effect;
use super::{Effect, JointState};
use crate::scalar::Real;
use crate::state::entry;

/// The effects `E` at a state of mean velocity, but for torques at joints, which are those at the
/// start's velocity: from there [`Implicit`](super::Implicit) extrapolates them to the end.
/// Load-dependent friction is left out.
pub(crate) struct AtMeanVelocity<'a, E, R, const V: usize> {
    bodies: Bodies<'a, E>,
    joints: JointsAtStart<'a, E, R, V>,
}

impl<'a, E, R, const V: usize> AtMeanVelocity<'a, E, R, V> {
    /// The effects of a step that starts at these velocities.
    pub(crate) fn new(effects: &'a E, start: [R; V]) -> Self {
        Self { bodies: Bodies(effects), joints: JointsAtStart { effects, start } }
    }
}

delegate_effect! {
    impl[R: Real, E: Effect<R, B, V>, const B: usize, const V: usize]
    Effect<R, B, V> for AtMeanVelocity<'_, E, R, V>,
    |this| { Bodies<'_, E> => this.bodies, JointsAtStart<'_, E, R, V> => this.joints }
}

/// The effects without their torques at joints.
struct Bodies<'a, E>(&'a E);

delegate_effect! {
    @if [true, true, false, true]
    impl[R: Real, E: Effect<R, B, V>, const B: usize, const V: usize]
    Effect<R, B, V> for Bodies<'_, E>,
    |this| { E => *this.0 }
}

/// The torques at joints.
struct JointsAtStart<'a, E, R, const V: usize> {
    effects: &'a E,
    start: [R; V],
}

impl<E, R, const B: usize, const V: usize> Effect<R, B, V> for JointsAtStart<'_, E, R, V>
where
    R: Real,
    E: Effect<R, B, V>,
{
    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        let at = JointState::new(at.q, entry(&self.start, joint));
        self.effects.torque(joint, at, tau);
    }

    #[cfg_attr(optimised, inline(always))]
    fn inertia(&self, joint: usize) -> Option<R> {
        self.effects.inertia(joint)
    }
}
