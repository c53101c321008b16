//! The effects of a law as they are at the moment.

use core::marker::PhantomData;

use dynamics_core::effects::{BodyState, Effect, JointState, TorqueDerivatives};
use dynamics_core::spatial::{Force, Motion, SpatialInertia};
use glam::Vec3;

/// Effects of which `X` tells what is not constant, in a law for N driven joints.
pub trait Told<X, const B: usize, const V: usize, const N: usize> {
    /// Their type.
    type Effects: Effect<f32, B, V>;

    /// As they are when `around` goes on.
    fn told(around: &X) -> Self::Effects;
}

/// The effects of the law `L`, made anew where each is asked: a tuple in memory would hide from the compiler
/// what of it is constant, and cost its copying.
#[derive(Debug)]
pub struct Now<'a, L, X, const N: usize>(&'a X, PhantomData<L>);

impl<'a, L, X, const N: usize> Now<'a, L, X, N> {
    /// When `around` goes on.
    #[inline(always)]
    pub const fn of(around: &'a X) -> Self {
        Self(around, PhantomData)
    }
}

impl<L, X, const B: usize, const V: usize, const N: usize> Effect<f32, B, V> for Now<'_, L, X, N>
where
    L: Told<X, B, V, N>,
{
    const FIELD: bool = L::Effects::FIELD;
    const FIELD_AXES: [bool; 3] = L::Effects::FIELD_AXES;
    const ACCELERATIONS: bool = L::Effects::ACCELERATIONS;
    const VELOCITY_PRODUCTS: bool = L::Effects::VELOCITY_PRODUCTS;
    const WRENCH: bool = L::Effects::WRENCH;
    const BODY_VELOCITY: bool = L::Effects::BODY_VELOCITY;
    const BODY_POSE: bool = L::Effects::BODY_POSE;
    const BASE_MOTION: bool = L::Effects::BASE_MOTION;
    const GRAVITIES: usize = L::Effects::GRAVITIES;
    const PAYLOAD: [bool; B] = L::Effects::PAYLOAD;
    const GYROSCOPIC_ROTORS: bool = L::Effects::GYROSCOPIC_ROTORS;

    #[inline(always)]
    fn payload(&self, body: usize, inertia: &mut SpatialInertia<f32>) {
        L::told(self.0).payload(body, inertia);
    }

    #[inline(always)]
    fn field(&self, g: &mut Vec3) {
        L::told(self.0).field(g);
    }

    #[inline(always)]
    fn base(&self, velocity: &mut Motion<f32>, acceleration: &mut Motion<f32>) {
        L::told(self.0).base(velocity, acceleration);
    }

    #[inline(always)]
    fn wrench(&self, body: usize, at: &BodyState<f32>, fx: &mut Force<f32>) {
        L::told(self.0).wrench(body, at, fx);
    }

    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<f32>, tau: &mut f32) {
        L::told(self.0).torque(joint, at, tau);
    }

    #[inline(always)]
    fn derivatives(
        &self,
        joint: usize,
        at: JointState<f32>,
        derivatives: &mut TorqueDerivatives<f32>,
    ) {
        L::told(self.0).derivatives(joint, at, derivatives);
    }

    #[inline(always)]
    fn inertia(&self, joint: usize, diagonal: &mut f32) {
        L::told(self.0).inertia(joint, diagonal);
    }

    #[inline(always)]
    fn spin(&self, joint: usize, coupling: &mut f32) {
        L::told(self.0).spin(joint, coupling);
    }
}
