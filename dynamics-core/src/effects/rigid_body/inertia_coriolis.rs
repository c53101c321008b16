//! The terms of the rigid-body equation M q̈ + C(q, q̇) q̇ + g = τ, as effects like any other.

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, Gravity};
use crate::scalar::Real;

/// M(q) q̈: the torque that accelerates the bodies. Forward dynamics does not compile without it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inertia;

/// C(q, q̇) q̇: Coriolis and centrifugal torque.
#[doc(alias = "centrifugal")]
#[doc(alias = "gyroscopic")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coriolis;

/// Rigid-body dynamics on earth: gravity, inertia and velocity products, with which most scenes
/// begin.
pub const RIGID_BODY: (Gravity, Inertia, Coriolis) = (Gravity::EARTH, Inertia, Coriolis);

/// K η + D η̇: the stiffness and damping of links that bend, which
/// [`Modes`](crate::flexible::Modes) has. Robots without modes have none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Elasticity;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Elasticity {
    const ONCE: Once = Once::of(Kind::Elasticity);
    const ELASTICITY: bool = true;
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Inertia {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::Inertia);
    const ACCELERATIONS: bool = true;
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Coriolis {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::Coriolis);
    const VELOCITY_PRODUCTS: bool = true;
}
