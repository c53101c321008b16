//! A link that is bent: its inertia, the forces of its modes, and the motion of its end.
//!
//! With r = r₀ + Σ φₖ ηₖ in the link's frame, every integral over the mass follows from ∫ φₖ dm, ∫
//! φₖ r₀ᵀ dm and ∫ φₖ φₗᵀ dm. Shabana, *Dynamics of Multibody Systems* (2005), section 5.4, has
//! them as invariants.

use core::ops::Range;

use super::Modes;
use super::modes::Integrals;
use crate::effects::{Declared, Effect};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::entry;

/// Adds the change of a link's inertia by the deformation η of one mode, about the joint. With Φ =
/// ∫ φ rᵀ dm, which is `moments`, ∫ r rᵀ dm changes by Σ ηₖ (Φₖ + ∫ r₀ φₖᵀ dm).
#[cfg_attr(optimised, inline(always))]
pub(super) fn deform<R: Real>(
    inertia: &mut SpatialInertia<R>,
    mode: &Integrals<R>,
    moments: R::Mat3,
    eta: R,
) {
    let second = (moments + mode.moments.transpose()) * eta;
    let [x, y, z] = second.cols().map(R::Vec3::array);
    inertia.first_moment += mode.momentum * eta;
    inertia.rotational -= R::Mat3::from_cols(
        R::Vec3::new(-(y[1] + z[2]), x[1], x[2]),
        R::Vec3::new(y[0], -(z[2] + x[0]), y[2]),
        R::Vec3::new(z[0], z[1], -(x[0] + y[1])),
    );
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// ∫ φₖ·φₗ dm: the inertia between two modes of a link.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn inertia(&self, k: usize, l: usize) -> R {
        let product = self.products.get(k).and_then(|row| row.get(l));
        product.map_or(R::ZERO, trace::<R>)
    }

    /// Φₖ = ∫ φₖ rᵀ dm of the deformed link.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn moments(&self, k: usize, range: &Range<usize>, eta: &[R; M]) -> R::Mat3 {
        let (Some(mode), Some(products)) = (self.each.get(k), self.products.get(k)) else {
            return R::Mat3::ZERO;
        };
        let mut moments = mode.moments;
        for l in range.clone() {
            if let Some(&product) = products.get(l) {
                moments += product * entry(eta, l);
            }
        }
        moments
    }
}

/// ∫ r × φ dm of ∫ φ rᵀ dm.
#[cfg_attr(optimised, inline(always))]
pub(super) fn axial<R: Real>(moments: &R::Mat3) -> R::Vec3 {
    let [x, y, z] = moments.cols().map(R::Vec3::array);
    R::Vec3::new(y[2] - z[1], z[0] - x[2], x[1] - y[0])
}

#[cfg_attr(optimised, inline(always))]
pub(super) fn trace<R: Real>(m: &R::Mat3) -> R {
    let [x, y, z] = m.cols().map(R::Vec3::array);
    x[0] + y[1] + z[2]
}

/// The end of a link, which is displaced by Σ φₖ ηₖ and rotated by Σ ψₖ ηₖ, twice its Rodrigues
/// parameters g.
///
/// These give a rotation without a sine, equal to the linear theory's to the second order of the
/// angle. Its velocity is 2 / (1 + g²) (ġ + g × ġ) in the link's axes: Shuster, "A survey of
/// attitude representations" (1993). Motions and forces of the end are those about the link's
/// joint, in the link's axes.
#[derive(Clone, Copy)]
pub(super) struct End<R: Real> {
    g: R::Vec3,
    /// 2 / (1 + g²)
    scale: R,
    /// The end.
    point: R::Vec3,
}

impl<R: Real> End<R> {
    /// From the displacement and the parameters.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of([shift, g]: [R::Vec3; 2], rest: R::Vec3) -> Self {
        let two = R::from_f64(2.0);
        Self { g, scale: two / (R::ONE + g.dot(g)), point: rest + shift }
    }

    /// The transform from the link's frame to a body on its end, from the same transform of the
    /// undeformed link, whose end is at `rest`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn xform(&self, x: &Xform<R>, rest: R::Vec3) -> Xform<R> {
        let ([x_0, y_0, z_0], [dx, dy, dz]) = (self.g.array(), (self.g * self.scale).array());
        let diagonal = self.scale - R::ONE;
        // Rᵀ = (1 − g²)/(1 + g²) 1 + 2/(1 + g²) (g gᵀ − g×)
        let rot = R::Mat3::from_cols(
            R::Vec3::new(diagonal + x_0 * dx, x_0 * dy - dz, x_0 * dz + dy),
            R::Vec3::new(y_0 * dx + dz, diagonal + y_0 * dy, y_0 * dz - dx),
            R::Vec3::new(z_0 * dx - dy, z_0 * dy + dx, diagonal + z_0 * dz),
        );
        Xform { rot: x.rot * rot, pos: self.point + rot.transpose_mul(x.pos - rest) }
    }

    /// The angular velocity of ġ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn omega(&self, g_dot: R::Vec3) -> R::Vec3 {
        (g_dot + self.g.cross(g_dot)) * self.scale
    }

    /// The velocity relative to the link.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn velocity(&self, [shift, g_dot]: [R::Vec3; 2]) -> Motion<R> {
        let ang = self.omega(g_dot);
        Motion::new(ang, shift + self.point.cross(ang))
    }

    /// Adds the velocity and the acceleration of the end relative to the link to those of the link,
    /// with the terms that the effects have.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn add<E, const B: usize, const V: usize>(
        &self,
        _: &E,
        v: &mut Motion<R>,
        a: &mut Motion<R>,
        [rates, accelerations]: [[R::Vec3; 2]; 2],
    ) where
        E: Effect<R, B, V>,
    {
        let [shift, g_dot] = rates;
        let (velocity, mut ang) = (self.velocity(rates), R::Vec3::ZERO);
        if E::ACCELERATIONS {
            ang = self.omega(accelerations[1]);
            a.lin += accelerations[0];
        }
        if E::VELOCITY_PRODUCTS {
            ang -= velocity.ang * (self.scale * self.g.dot(g_dot));
            a.ang += v.ang.cross(velocity.ang);
            a.lin += v.ang.cross(velocity.lin) + (v.lin + shift).cross(velocity.ang);
        }
        if const { E::ACCELERATIONS | E::VELOCITY_PRODUCTS } {
            *a += Motion::new(ang, self.point.cross(ang));
        }
        if const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY } {
            *v += velocity;
        }
    }

    /// A force on the end, as the moment by which ½ ψ of a mode is multiplied and the force by
    /// which φ is.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn load(&self, f: Force<R>) -> Force<R> {
        let moment = f.ang - self.point.cross(f.lin);
        Force::new((moment - self.g.cross(moment)) * self.scale, f.lin)
    }
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// Displacement and Rodrigues parameters of the end of a link at each of these coordinates, or
    /// their rates.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn at_end<const N: usize>(
        &self,
        range: &Range<usize>,
        x: [&[R; M]; N],
    ) -> [[R::Vec3; 2]; N] {
        let mut sums = [[R::Vec3::ZERO; 2]; N];
        for k in range.clone() {
            let Some(mode) = self.each.get(k) else {
                break;
            };
            for ([shift, g], x) in sums.iter_mut().zip(x) {
                *shift += mode.shift * entry(x, k);
                *g += mode.half_turn * entry(x, k);
            }
        }
        sums
    }

    /// The end of a link undeformed.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn rest(&self, range: &Range<usize>) -> R::Vec3 {
        let mode = self.each.get(range.start);
        mode.map_or(R::Vec3::ZERO, |mode| mode.end)
    }
}
