//! A scene whose bodies are not accelerated, by which the rate of the momentum is computed.

use crate::effects::{Effect, JointState, Once, call_hook, hook};
use crate::scalar::Real;
use crate::spatial::Motion;

/// Gravity, wrenches, payloads and the torques at joints of `E`: neither M q̈ nor the products of
/// velocities, no acceleration of the base, and no friction in proportion to the load.
pub(crate) struct Resting<'a, E>(pub(crate) &'a E);

impl<R: Real, E, const B: usize, const V: usize> Effect<R, B, V> for Resting<'_, E>
where
    E: Effect<R, B, V>,
{
    const GRAVITY_FIELD: hook::Field<Self, R> =
        hook::Field::NONE.with(&E::GRAVITY_FIELD).through(true, |scene, g| {
            call_hook!(E::GRAVITY_FIELD.add, scene.0, g);
        });
    const BASE: hook::Base<Self, R> =
        hook::Base::NONE.with(&E::BASE).through(true, |scene, velocity, _| {
            let mut acceleration = Motion::ZERO;
            call_hook!(E::BASE.add, scene.0, velocity, &mut acceleration);
        });
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> =
        hook::Wrench::NONE.with(&E::EXTERNAL_WRENCH).through(true, |scene, body, at, fx| {
            hook::add_wrench(scene.0, body, at, fx);
        });
    const ADDED_INERTIA: hook::Inertia<Self, R, B> =
        hook::Inertia::NONE.with(&E::ADDED_INERTIA).through(true, |scene, body, inertia| {
            call_hook!(E::ADDED_INERTIA.add, scene.0, body, inertia);
        });
    const ONCE: Once = E::ONCE;

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        self.0.torque(joint, at, tau);
    }
}
