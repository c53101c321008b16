//! Effects of a step in which the bodies move at the step's mean velocity.

use super::delegate::delegate_effect;
use super::{Effect, JointState};
use crate::scalar::Real;
use crate::state::entry;

/// The effects `E` at a state of mean velocity, but for torques at joints, which are those at the start's velocity: from there
/// [`Implicit`](super::Implicit) extrapolates them to the end.
pub(crate) struct AtMeanVelocity<'a, E, R, const V: usize>(JointsAtStart<'a, E, R, V>);

impl<'a, E, R, const V: usize> AtMeanVelocity<'a, E, R, V> {
    /// Of a step that starts at these velocities.
    pub(crate) fn new(effects: &'a E, start: [R; V]) -> Self {
        Self(JointsAtStart { effects, start })
    }
}

delegate_effect! {
    impl[R: Real, E: Effect<R, B, V>, const B: usize, const V: usize]
    Effect<R, B, V> for AtMeanVelocity<'_, E, R, V>,
    |this| { E => *this.0.effects, JointsAtStart<'_, E, R, V> => this.0 }
}

/// What the torques at joints are more at the start's velocity.
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
        let (mut now, mut start) = (R::ZERO, R::ZERO);
        let before = JointState::new(at.q, entry(&self.start, joint));
        self.effects.torque(joint, at, &mut now);
        self.effects.torque(joint, before, &mut start);
        *tau += start - now;
    }
}
