//! The inertia of an articulated body: symmetric, but no longer that of a rigid one.

use core::ops::{AddAssign, Mul};

use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};

/// The blocks of [Ī H; Hᵀ M], RBDA (2.72): what force gives what acceleration at a handle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ArticulatedInertia<R: Real> {
    inertia: R::Mat3,
    coupling: R::Mat3,
    mass: R::Mat3,
}

impl<R: Real> From<SpatialInertia<R>> for ArticulatedInertia<R> {
    #[inline(always)]
    fn from(i: SpatialInertia<R>) -> Self {
        Self {
            inertia: i.inertia,
            coupling: cross_matrix::<R>(i.moment),
            mass: R::Mat3::IDENTITY * i.mass,
        }
    }
}

impl<R: Real> Mul<Motion<R>> for ArticulatedInertia<R> {
    type Output = Force<R>;
    #[inline(always)]
    fn mul(self, m: Motion<R>) -> Force<R> {
        Force::new(
            self.inertia * m.ang + self.coupling * m.lin,
            self.coupling.transpose_mul(m.ang) + self.mass * m.lin,
        )
    }
}

impl<R: Real> AddAssign for ArticulatedInertia<R> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        self.inertia += o.inertia;
        self.coupling += o.coupling;
        self.mass += o.mass;
    }
}

impl<R: Real> ArticulatedInertia<R> {
    /// Iᴬ − U Uᵀ / D: what remains when the joint is free. RBDA (7.43).
    #[inline(always)]
    pub(crate) fn minus_outer(&self, u: Force<R>, per_d: R) -> Self {
        let (n, f) = (u.ang * per_d, u.lin * per_d);
        Self {
            inertia: self.inertia - outer::<R>(u.ang, n),
            coupling: self.coupling - outer::<R>(u.ang, f),
            mass: self.mass - outer::<R>(u.lin, f),
        }
    }

    /// Xᵀ Iᴬ X: the same inertia at the parent's frame. RBDA (2.66).
    #[inline(always)]
    pub(crate) fn at_parent(&self, x: &Xform<R>) -> Self {
        let (e, et, r) = (x.rot, x.rot.transpose(), cross_matrix::<R>(x.pos));
        let mass = et * self.mass * e;
        let coupling = et * self.coupling * e;
        let moved = coupling + r * mass;
        Self {
            inertia: et * self.inertia * e + r * coupling.transpose() - moved * r,
            coupling: moved,
            mass,
        }
    }
}

/// [r]×
#[inline(always)]
fn cross_matrix<R: Real>(r: R::Vec3) -> R::Mat3 {
    let [x, y, z] = r.array();
    let zero = R::ZERO;
    R::Mat3::from_cols(
        R::Vec3::new(zero, z, -y),
        R::Vec3::new(-z, zero, x),
        R::Vec3::new(y, -x, zero),
    )
}

/// a bᵀ
#[inline(always)]
fn outer<R: Real>(a: R::Vec3, b: R::Vec3) -> R::Mat3 {
    let [x, y, z] = b.array();
    R::Mat3::from_cols(a * x, a * y, a * z)
}
