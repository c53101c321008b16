//! A scene without its accelerations: what inverse dynamics of forward dynamics' bias computes.

use crate::effects::delegate::passed_on;
use crate::effects::{BodyState, Effect, JointState};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, SpatialInertia};

/// The effects of `E` at q̈ = 0, known while compiling.
pub(crate) struct Bias<'a, E>(pub(crate) &'a E);

impl<R: Real, E, const B: usize, const V: usize> Effect<R, B, V> for Bias<'_, E>
where
    E: Effect<R, B, V>,
{
    passed_on!(0);
    const ACCELERATIONS: bool = false;

    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        self.0.torque(joint, JointState { qdd: R::ZERO, ..at }, tau);
    }

    #[inline(always)]
    fn inertia(&self, joint: usize, diagonal: &mut R) {
        self.0.inertia(joint, diagonal);
    }
}
