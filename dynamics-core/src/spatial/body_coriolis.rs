//! The Coriolis matrix of a body, by which two velocities give a force.
//!
//! Echeandia & Wensing, "Numerical methods to compute the Coriolis matrix and Christoffel symbols
//! for rigid-body systems" (2021). A particle of mass dm at r with the velocity ṙ contributes the
//! force (ω_w × ṙ) dm to B w, so that of the 6 × 6 matrix twelve numbers remain:
//!
//! ```text
//! B(I, v) = ½ [(v ×*) I + (I v) ×̄* − I (v ×)] = [D 0; −p× 0]
//! D = ∫ (r·ṙ) 1 − ṙ rᵀ dm = (h·v) 1 − v hᵀ − ω× Σ      Σ = ∫ r rᵀ dm = ½ tr(Ī) 1 − Ī
//! p = ∫ ṙ dm = m v + ω × h
//! ```

use core::ops::{AddAssign, Mul};

use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::symmetric::turned_back;
use crate::spatial::{Force, Motion, SpatialInertia, Xform};

/// B(I, v): with it, I ẇ + B w is symmetric in the velocities v and w of the body, and B v = v ×* I
/// v.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyCoriolis<R: Real> {
    /// D, the couple per angular velocity, N·m·s/rad.
    couple: R::Mat3,
    /// The linear momentum p, N·s.
    momentum: R::Vec3,
}

impl<R: Real> BodyCoriolis<R> {
    /// The matrix of a body of velocity v. 83 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn new(inertia: &SpatialInertia<R>, v: Motion<R>) -> Self {
        let (h, [hx, hy, hz]) = (inertia.first_moment, inertia.first_moment.array());
        let columns = inertia.rotational.cols();
        let [[xx, ..], [_, yy, _], [.., zz]] = columns.map(Vector::array);
        let diagonal = (xx + yy + zz) * R::from_f64(0.5);
        let unit = R::Mat3::IDENTITY.cols();
        let along = h.dot(v.lin);
        let column = |k: usize, h_k: R| {
            let sigma = unit[k] * diagonal - columns[k];
            unit[k] * along - v.lin * h_k - v.ang.cross(sigma)
        };
        Self {
            couple: R::Mat3::from_cols(column(0, hx), column(1, hy), column(2, hz)),
            momentum: v.lin * inertia.mass + v.ang.cross(h),
        }
    }

    /// Adds the part of a rotor: half of the couple ω_w × h of an angular momentum h.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn add_rotor(&mut self, h: R::Vec3) {
        let unit = R::Mat3::IDENTITY.cols();
        let [x, y, z] = unit.map(|unit| unit.cross(h) * R::from_f64(0.5));
        self.couple += R::Mat3::from_cols(x, y, z);
    }

    /// Xᵀ B X: the same of the body as a part of its parent. 119 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn at_parent(&self, x: &Xform<R>) -> Self {
        let momentum = x.rot.transpose_mul(self.momentum);
        let unit = R::Mat3::IDENTITY.cols();
        let [a, b, c] = unit.map(|unit| x.pos.cross(unit.cross(momentum)));
        let couple = turned_back::<R>(&self.couple, &x.rot) + R::Mat3::from_cols(a, b, c);
        Self { couple, momentum }
    }

    /// The couple Bᵀ m; its force is zero. 27 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn transpose_mul(&self, m: Motion<R>) -> R::Vec3 {
        self.couple.transpose_mul(m.ang) + self.momentum.cross(m.lin)
    }
}

/// B w. 24 flops.
impl<R: Real> Mul<Motion<R>> for BodyCoriolis<R> {
    type Output = Force<R>;
    #[cfg_attr(optimised, inline(always))]
    fn mul(self, w: Motion<R>) -> Force<R> {
        Force::new(self.couple * w.ang, w.ang.cross(self.momentum))
    }
}

impl<R: Real> AddAssign for BodyCoriolis<R> {
    #[cfg_attr(optimised, inline(always))]
    fn add_assign(&mut self, o: Self) {
        self.couple += o.couple;
        self.momentum += o.momentum;
    }
}
