//! The arguments of hooks.

use crate::scalar::Real;
use crate::spatial::{Motion, Xform};

/// The state of one joint, which joint hooks read.
///
/// The library fills it in, and a field may be added: build it by [`JointState::new`], as in a test
/// of an effect of one's own. It has no q̈: inertia belongs in
/// [`Effect::inertia`](super::Effect::inertia), from which the library makes the torque and M's
/// diagonal alike. Nor has it the transmitted torque: see
/// [`hook::LoadFriction`](super::hook::LoadFriction).
///
/// ```compile_fail,E0609
/// # use dynamics_core::{effects::{Effect, JointState}, scalar::Real};
/// struct Flywheel;
/// impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Flywheel {
///     fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
///         *tau += at.qdd; // error: no field `qdd` on type `JointState<R>`
///     }
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointState<R> {
    /// Position, rad or m; zero for a velocity that no position belongs to (ω beside a quaternion).
    pub q: R,
    /// Velocity, rad/s or m/s.
    pub qd: R,
}

impl<R> JointState<R> {
    /// At the position q, rad or m, and the velocity q̇, rad/s or m/s.
    #[cfg_attr(optimised, inline(always))]
    pub const fn new(q: R, qd: R) -> Self {
        Self { q, qd }
    }
}

/// The velocity of one body, which a wrench of
/// [`hook::Wrench::of_velocity`](super::hook::Wrench::of_velocity) reads.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BodyVelocity<R: Real> {
    /// Velocity in an inertial frame, the motion of the base included, about the origin of the
    /// body's frame and in its coordinates.
    pub velocity: Motion<R>,
    /// Velocity of the base in the same inertial frame, about the base's origin and in its
    /// coordinates; nothing where no effect of the scene moves the base.
    pub base: Option<Motion<R>>,
}

/// The state of one body, which a wrench of
/// [`hook::Wrench::of_state`](super::hook::Wrench::of_state) reads.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BodyState<R: Real> {
    /// Pose relative to the base: the coordinate transform from the base to the body's frame, its
    /// origin in base coordinates, m.
    pub pose: Xform<R>,
    /// Velocity in an inertial frame, the motion of the base included, about the origin of the
    /// body's frame and in its coordinates.
    pub velocity: Motion<R>,
    /// Velocity of the base in the same inertial frame, about the base's origin and in its
    /// coordinates; nothing where no effect of the scene moves the base.
    pub base: Option<Motion<R>>,
}

impl<R: Real> BodyState<R> {
    /// In place and at rest, on a base that no effect moves.
    pub const REST: Self = Self { pose: Xform::IDENTITY, velocity: Motion::ZERO, base: None };
}

/// Derivatives of a motor's torque with respect to its joint's state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TorqueDerivatives<R> {
    /// ∂τ/∂q, N·m/rad or N/m: that of a spring is its stiffness.
    pub dq: R,
    /// ∂τ/∂q̇, N·m·s/rad or N·s/m: that of a damper is its damping.
    pub dqd: R,
}

/// The factors a and b of friction a |τ| + b τ, where τ is the torque that a gear transmits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoadFactors<R> {
    /// a, the factor of |τ|: odd in the velocity where friction opposes motion.
    pub magnitude: R,
    /// b, the factor of τ: even in the velocity.
    pub torque: R,
}
