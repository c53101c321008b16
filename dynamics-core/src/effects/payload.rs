//! A payload held by the last body, known at run time only.

use super::Effect;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::SpatialInertia;

/// A rigid payload fixed to the last body of the description.
///
/// Frame: that body's, about its origin. It acts through whatever else the scene names: its weight
/// with `Gravity`, its M q̈ with `Inertia`.
///
/// ```
/// use dynamics_core::effects::{Gravity, Payload};
/// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
/// let arm = State::at([0.0_f32, -0.8, 0.9, 0.1, 0.2, 0.3]);
/// let scene = (Gravity::EARTH, Payload::new(2.0, [0.0, 0.0, 0.1], [0.0; 6]));
/// let empty = Core::<Ur5e>::rnea(&arm, &(Gravity::EARTH,));
/// let loaded = Engine::<Ur5e>::rnea(&arm, &scene);
/// assert!((loaded[1] - empty[1]).abs() > 5.0);
/// assert!((loaded[1] - Core::<Ur5e>::rnea(&arm, &scene)[1]).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload<R: Real>(pub SpatialInertia<R>);

impl<R: Real> Payload<R> {
    /// From mass (kg), centre of mass (m) and rotational inertia about it (xx, xy, xz, yy, yz, zz,
    /// kg·m²), in the last body's frame. RBDA (2.63).
    pub fn new(mass: R, com: [R; 3], inertia: [R; 6]) -> Self {
        let [xx, xy, xz, yy, yz, zz] = inertia;
        let [x, y, z] = com;
        let column = |a, b, c| R::Vec3::new(a, b, c);
        Self(SpatialInertia {
            mass,
            moment: column(x, y, z) * mass,
            inertia: R::Mat3::from_cols(
                column(
                    xx + mass * (y * y + z * z),
                    xy - mass * x * y,
                    xz - mass * x * z,
                ),
                column(
                    xy - mass * x * y,
                    yy + mass * (x * x + z * z),
                    yz - mass * y * z,
                ),
                column(
                    xz - mass * x * z,
                    yz - mass * y * z,
                    zz + mass * (x * x + y * y),
                ),
            ),
        })
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Payload<R> {
    const PAYLOAD: bool = true;

    #[inline(always)]
    fn payload(&self, inertia: &mut SpatialInertia<R>) {
        *inertia = *inertia + self.0;
    }
}
