//! A scene without its accelerations: what inverse dynamics of forward dynamics' bias computes.

use crate::effects::{BodyState, Effect, JointState};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, SpatialInertia};

/// The effects of `E` at q̈ = 0, known while compiling.
pub(crate) struct Bias<'a, E>(pub(crate) &'a E);

impl<R: Real, E, const B: usize, const V: usize> Effect<R, B, V> for Bias<'_, E>
where
    E: Effect<R, B, V>,
{
    const FIELD: bool = E::FIELD;
    const FIELD_AXES: [bool; 3] = E::FIELD_AXES;
    const ACCELERATIONS: bool = false;
    const VELOCITY_PRODUCTS: bool = E::VELOCITY_PRODUCTS;
    const WRENCH: bool = E::WRENCH;
    const BODY_VELOCITY: bool = E::BODY_VELOCITY;
    const BODY_POSE: bool = E::BODY_POSE;
    const BASE_MOTION: bool = E::BASE_MOTION;
    const PAYLOAD: bool = E::PAYLOAD;
    const SPINNING: bool = E::SPINNING;

    #[inline(always)]
    fn spin(&self, joint: usize, coupling: &mut R) {
        self.0.spin(joint, coupling);
    }

    #[inline(always)]
    fn payload(&self, inertia: &mut SpatialInertia<R>) {
        self.0.payload(inertia);
    }

    #[inline(always)]
    fn field(&self, g: &mut R::Vec3) {
        self.0.field(g);
    }

    #[inline(always)]
    fn base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
        self.0.base(velocity, acceleration);
    }

    #[inline(always)]
    fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
        self.0.wrench(body, at, fx);
    }

    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        self.0.torque(joint, JointState { qdd: R::ZERO, ..at }, tau);
    }

    #[inline(always)]
    fn inertia(&self, joint: usize, diagonal: &mut R) {
        self.0.inertia(joint, diagonal);
    }
}
