//! A base with a given motion: a ship, a vehicle, a lift.
//!
//! v₀ and a₀ of RBDA (2008), section 5.3, are then not zero.

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, hook};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Motion;

/// The given motion of the base, about its origin and in its coordinates.
///
/// The acceleration is the spatial one: its linear part is that of the origin less ω × v
/// ([`MovingBase::of_point`] takes what an accelerometer's frame gives). Gravity is not part of it,
/// and its direction in a base that tilts is the scene's: [`GravityVector`]. Cost: a forward pass
/// that no zero of a resting base shortens.
///
/// ```
/// use dynamics_core::effects::{Coriolis, Inertia, MovingBase};
/// use dynamics_core::{Core, robots::Ur5e, spatial::Motion, state::State};
/// use glam::DVec3;
/// // A lift that starts upwards at 9.81 m/s² weighs like gravity.
/// let lift = MovingBase { velocity: Motion::ZERO, acceleration: Motion::new(DVec3::ZERO, DVec3::Z * 9.81) };
/// let at = State::at([0.3; 6]);
/// let weight = Core::<Ur5e>::rnea(&at, &dynamics_core::effects::Gravity::EARTH);
/// assert_eq!(Core::<Ur5e>::rnea(&at, &(Inertia, Coriolis, lift)), weight);
/// ```
#[doc(alias = "base acceleration")]
#[doc(alias = "prescribed base motion")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MovingBase<R: Real> {
    /// Spatial velocity v₀, rad/s and m/s.
    pub velocity: Motion<R>,
    /// Spatial acceleration a₀, rad/s² and m/s².
    pub acceleration: Motion<R>,
}

impl<R: Real> MovingBase<R> {
    /// From ω, ω̇ and velocity and acceleration of the base's origin, all in the base's
    /// coordinates.
    pub fn of_point(omega: R::Vec3, alpha: R::Vec3, velocity: R::Vec3, a: R::Vec3) -> Self {
        Self {
            velocity: Motion::new(omega, velocity),
            acceleration: Motion::new(alpha, a - omega.cross(velocity)),
        }
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for MovingBase<R> {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::MovingBase);
    const BASE: hook::Base<Self, R> = hook::Base::moving(Self::add_to);
}

impl<R: Real> MovingBase<R> {
    /// Adds the motion.
    #[cfg_attr(optimised, inline(always))]
    fn add_to(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
        *velocity += self.velocity;
        *acceleration += self.acceleration;
    }
}

/// Uniform gravity whose direction is known at run time only, in base coordinates, m/s².
///
/// Cost: as [`Gravity`](crate::effects::Gravity), without what the engine saves by knowing the
/// direction.
///
/// ```
/// use dynamics_core::effects::{Gravity, GravityVector};
/// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
/// use glam::{DMat3, DVec3};
/// let at = State::at([0.3; 6]);
/// let level = GravityVector::<f64>::tilted(DMat3::IDENTITY, DVec3::NEG_Z * 9.81);
/// assert_eq!(Core::<Ur5e>::rnea(&at, &level), Core::<Ur5e>::rnea(&at, &Gravity::EARTH));
/// // On a ship that rolls the first motor has to hold, too.
/// let rolled = GravityVector::<f64>::tilted(DMat3::from_rotation_x(0.2), DVec3::NEG_Z * 9.81);
/// assert!(Engine::<Ur5e>::rnea(&at, &rolled)[0].abs() > 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GravityVector<R: Real>(pub R::Vec3);

impl<R: Real> GravityVector<R> {
    /// The field `g` of the world in a base of the attitude `attitude`, the rotation of coordinates
    /// from the base to the world.
    pub fn tilted(attitude: R::Mat3, g: R::Vec3) -> Self {
        Self(attitude.transpose_mul(g))
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for GravityVector<R> {
    const DIFFERENTIABLE: bool = true;
    const GRAVITY_FIELD: hook::Field<Self, R> = hook::Field::gravity(Self::add_to);
}

impl<R: Real> GravityVector<R> {
    /// Adds the field.
    #[cfg_attr(optimised, inline(always))]
    fn add_to(&self, g: &mut R::Vec3) {
        *g += self.0;
    }
}
