//! What hooks see.

use crate::scalar::Real;
use crate::spatial::{Motion, Xform};

/// The state of one joint, as joint hooks see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointState<R> {
    /// Position, rad or m; zero for a velocity that no position belongs to (ω beside a quaternion).
    pub q: R,
    /// Velocity, rad/s or m/s.
    pub qd: R,
    /// Acceleration, rad/s² or m/s²; zero where forward dynamics asks.
    pub qdd: R,
}

/// The state of one body, as `wrench` sees it; what no effect asks for by its constants is at rest and
/// in place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState<R: Real> {
    /// Pose relative to the base: the coordinate transform from the base to the body's frame, its origin in base
    /// coordinates, m.
    pub pose: Xform<R>,
    /// Velocity in an inertial frame, the motion of the base included, about the origin of the body's frame and in its
    /// coordinates.
    pub velocity: Motion<R>,
    /// Velocity of the base in the same inertial frame, about the base's origin and in its coordinates; nothing where no
    /// effect of the scene moves the base.
    pub base: Option<Motion<R>>,
}

/// How a torque of the motor grows with its joint's state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TorqueDerivatives<R> {
    /// ∂τ/∂q, N·m/rad or N/m: that of a spring is its stiffness.
    pub dq: R,
    /// ∂τ/∂q̇, N·m·s/rad or N·s/m: that of a damper is its damping.
    pub dqd: R,
}
