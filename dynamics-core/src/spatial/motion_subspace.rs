//! A column of S, the motion subspace of a joint, in an aligned frame.

use super::{Force, Motion};
use crate::math::entry;
use crate::scalar::{Real, Vector};

/// The velocity of a joint at unit rate of one of its coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum MotionSubspace<R: Real> {
    /// A rotation about z.
    RevoluteZ,
    /// A translation along z.
    PrismaticZ,
    /// The unit vector of this number, of a joint that has several.
    Unit(usize),
    /// Any other.
    General(Motion<R>),
}

impl<R: Real> MotionSubspace<R> {
    /// sᵀ f.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn dot(&self, f: Force<R>) -> R {
        match self {
            Self::RevoluteZ => f.ang.array()[2],
            Self::PrismaticZ => f.lin.array()[2],
            Self::Unit(k) => entry(&f.components(), *k),
            Self::General(s) => s.dot(f),
        }
    }

    /// m + s rate.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn add_scaled_to(&self, m: Motion<R>, rate: R) -> Motion<R> {
        match self {
            Self::RevoluteZ => Motion::new(raised(m.ang, rate), m.lin),
            Self::PrismaticZ => Motion::new(m.ang, raised(m.lin, rate)),
            Self::Unit(k) => m + Motion::unit(*k) * rate,
            Self::General(s) => m + *s * rate,
        }
    }
}

/// v + z r.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn raised<R: Real>(v: R::Vec3, r: R) -> R::Vec3 {
    let [x, y, z] = v.array();
    R::Vec3::new(x, y, z + r)
}

#[cfg(test)]
mod tests {
    use super::MotionSubspace::{General, Unit};
    use crate::spatial::inertia::{ArticulatedInertia, CompositeInertia};
    use crate::spatial::{Force, Motion, SpatialInertia};
    use glam::DVec3;

    #[test]
    fn a_unit_vector_selects_what_the_general_form_multiplies() {
        let body = SpatialInertia::<f64>::from_parameters([
            2.0, 0.3, -0.4, 0.5, 0.31, 0.02, 0.29, -0.03, 0.04, 0.27,
        ]);
        let f = Force::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.3, 0.7, -1.1));
        let m = Motion::new(f.lin, f.ang);
        let composite = CompositeInertia::from(body);
        // Neither a rigid body's nor symmetric in its coupling.
        let articulated = ArticulatedInertia::from(body).minus_outer(f, 0.1);
        for k in 0..6 {
            let (unit, general) = (Unit(k), General(Motion::unit(k)));
            assert_eq!(unit.dot(f), general.dot(f));
            assert_eq!(unit.add_scaled_to(m, 1.7), general.add_scaled_to(m, 1.7));
            assert_eq!(composite.along(&unit), composite.along(&general));
            assert_eq!(articulated.along(&unit), articulated.along(&general));
        }
    }
}
