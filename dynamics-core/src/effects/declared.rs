//! The declarations of an effect's hooks.

use super::Effect;
use crate::scalar::Real;

/// The declarations of an effect's hooks, which every effect has: constants with names, so that the
/// compiler evaluates each once, and not in each function that asks.
#[doc(hidden)]
pub trait Declared<R: Real, const B: usize, const V: usize>: Effect<R, B, V> {
    /// A field accelerates every body.
    const FIELD: bool = Self::GRAVITY_FIELD.is_some;
    /// Which base components of the field may differ from zero.
    const FIELD_AXES: [bool; 3] = Self::GRAVITY_FIELD.axes;
    /// The number of fields of gravity.
    const GRAVITIES: usize = Self::GRAVITY_FIELD.gravities;
    /// The environment exerts a wrench on some body.
    const WRENCH: bool = Self::EXTERNAL_WRENCH.is_some;
    /// All that the effect adds has derivatives that are known.
    const HAS_DERIVATIVES: bool = Self::EXTERNAL_WRENCH.allows(Self::DIFFERENTIABLE);
    /// A wrench reads the body's velocity.
    const BODY_VELOCITY: bool = Self::EXTERNAL_WRENCH.reads_velocity;
    /// A wrench reads the body's pose.
    const BODY_POSE: bool = Self::EXTERNAL_WRENCH.reads_pose;
    /// The base moves.
    const BASE_MOTION: bool = Self::BASE.is_some;
    /// The bodies to whose inertia something is added.
    const PAYLOAD: [bool; B] = Self::ADDED_INERTIA.bodies;
    /// A number to whose body something is added, but which no body of the robot has.
    const PAYLOAD_ON_NO_BODY: Option<usize> = Self::ADDED_INERTIA.no_body;
    /// Rotors spin as bodies.
    const GYROSCOPIC_ROTORS: bool = Self::ROTOR.is_some;
    /// Friction depends on the transmitted torque.
    const LOAD_DEPENDENT: bool = Self::LOAD_FRICTION.is_some;
    /// The number of sets of base parameters that are loaded.
    const BASE_PARAMETERS: usize = Self::REGROUPED.sets;
    /// The name of the robot that they belong to; empty if there are none.
    const BASE_PARAMETERS_OF: &'static str = Self::REGROUPED.robot;
}

impl<R: Real, E, const B: usize, const V: usize> Declared<R, B, V> for E where E: Effect<R, B, V> {}
