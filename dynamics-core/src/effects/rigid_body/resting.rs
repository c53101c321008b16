//! A scene whose bodies are not accelerated, by which the rate of the momentum is computed.

use crate::effects::{Effect, JointState, Once, hook};
use crate::scalar::Real;
use crate::spatial::Motion;

/// Gravity, wrenches, payloads and the torques at joints of `E`: neither M q̈ nor the products of velocities, no
/// acceleration of the base, and no friction in proportion to the load.
pub(crate) struct Resting<'a, E>(pub(crate) &'a E);

impl<R: Real, E, const B: usize, const V: usize> Effect<R, B, V> for Resting<'_, E>
where
    E: Effect<R, B, V>,
{
    const GRAVITY_FIELD: hook::Field<Self, R> =
        hook::Field::forwarded(E::FIELD, E::FIELD_AXES, E::GRAVITIES, |scene, g| {
            scene.0.field(g)
        });
    const BASE: hook::Base<Self, R> =
        hook::Base::forwarded(E::BASE_MOTION, |scene, velocity, _| {
            let mut acceleration = Motion::ZERO;
            scene.0.base(velocity, &mut acceleration);
        });
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::forwarded(
        E::WRENCH,
        E::BODY_POSE,
        E::BODY_VELOCITY,
        |scene, body, at, fx| scene.0.wrench(body, at, fx),
    );
    const ADDED_INERTIA: hook::Inertia<Self, R, B> = hook::Inertia::forwarded(
        true,
        E::PAYLOAD,
        E::PAYLOAD_ON_NO_BODY,
        |scene, body, inertia| {
            scene.0.payload(body, inertia);
        },
    );
    const ONCE: Once = E::ONCE;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        self.0.torque(joint, at, tau);
    }
}
