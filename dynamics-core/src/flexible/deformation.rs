//! A link that is bent: its inertia, the forces of its modes, and the motion of its end.
//!
//! With r = r₀ + Σ φₖ ηₖ in the link's frame, every integral over the mass follows from ∫ φₖ dm, ∫ φₖ r₀ᵀ dm and
//! ∫ φₖ φₗᵀ dm. Shabana, *Dynamics of Multibody Systems* (2005), section 5.4, has them as invariants.

use core::ops::Range;

use super::Modes;
use super::modes::Integrals;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::entry;

/// The inertia of a link about its joint, to which that of its deformation is added mode by mode.
pub(super) struct Deformed<R: Real> {
    inertia: SpatialInertia<R>,
    /// What ∫ r rᵀ dm is greater by, Σ ηₖ (Φₖ + ∫ r₀ φₖᵀ dm).
    second: R::Mat3,
}

impl<R: Real> Deformed<R> {
    #[inline(always)]
    pub(super) fn of(rigid: SpatialInertia<R>) -> Self {
        Self {
            inertia: rigid,
            second: R::Mat3::ZERO,
        }
    }

    /// Adds a mode with Φ = ∫ φ rᵀ dm.
    #[inline(always)]
    pub(super) fn add(&mut self, mode: &Integrals<R>, moments: R::Mat3, eta: R) {
        self.inertia.first_moment += mode.momentum * eta;
        self.second += (moments + mode.moments.transpose()) * eta;
    }

    #[inline(always)]
    pub(super) fn inertia(self) -> SpatialInertia<R> {
        let ([x, y, z], mut inertia) = (self.second.cols().map(R::Vec3::array), self.inertia);
        inertia.rotational -= R::Mat3::from_cols(
            R::Vec3::new(-(y[1] + z[2]), x[1], x[2]),
            R::Vec3::new(y[0], -(z[2] + x[0]), y[2]),
            R::Vec3::new(z[0], z[1], -(x[0] + y[1])),
        );
        inertia
    }
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// ∫ φₖ·φₗ dm: the inertia between two modes of a link.
    #[inline(always)]
    pub(super) fn inertia(&self, k: usize, l: usize) -> R {
        let product = self.products.get(k).and_then(|row| row.get(l));
        product.map_or(R::ZERO, trace::<R>)
    }

    /// Φₖ = ∫ φₖ rᵀ dm of the deformed link.
    #[inline(always)]
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
#[inline(always)]
pub(super) fn axial<R: Real>(moments: &R::Mat3) -> R::Vec3 {
    let [x, y, z] = moments.cols().map(R::Vec3::array);
    R::Vec3::new(y[2] - z[1], z[0] - x[2], x[1] - y[0])
}

#[inline(always)]
pub(super) fn trace<R: Real>(m: &R::Mat3) -> R {
    let [x, y, z] = m.cols().map(R::Vec3::array);
    x[0] + y[1] + z[2]
}

/// The end of a link, which is displaced by Σ φₖ ηₖ and rotated by Σ ψₖ ηₖ, twice its Rodrigues parameters g.
///
/// These give a rotation without a sine, equal to the linear theory's to the second order of the angle. Its velocity is
/// 2 / (1 + g²) (ġ + g × ġ) in the link's axes: Shuster, "A survey of attitude representations" (1993). Motions and forces
/// of the end are those about the link's joint, in the link's axes.
#[derive(Clone, Copy)]
pub(super) struct End<R: Real> {
    g: R::Vec3,
    /// 1 / (1 + g²)
    scale: R,
    /// The end undeformed.
    rest: R::Vec3,
    /// The end.
    point: R::Vec3,
}

impl<R: Real> End<R> {
    #[inline(always)]
    pub(super) fn of<const M: usize>(
        modes: &Modes<R, M>,
        range: &Range<usize>,
        eta: &[R; M],
    ) -> Self {
        let (shift, g) = displacement(modes, range, eta);
        let rest = modes
            .each
            .get(range.start)
            .map_or(R::Vec3::ZERO, |mode| mode.end);
        Self {
            g,
            scale: R::ONE / (R::ONE + g.dot(g)),
            rest,
            point: rest + shift,
        }
    }

    /// To a body on the end from the link's frame, of what it is undeformed.
    #[inline(always)]
    pub(super) fn xform(&self, x: &Xform<R>) -> Xform<R> {
        let Self { g, scale, .. } = *self;
        let double = g * (scale + scale);
        let ([x_0, y_0, z_0], [dx, dy, dz]) = (g.array(), double.array());
        let diagonal = scale + scale - R::ONE;
        // Rᵀ = (1 − g²)/(1 + g²) 1 + 2/(1 + g²) (g gᵀ − g×)
        let rot = R::Mat3::from_cols(
            R::Vec3::new(diagonal + x_0 * dx, x_0 * dy - dz, x_0 * dz + dy),
            R::Vec3::new(y_0 * dx + dz, diagonal + y_0 * dy, y_0 * dz - dx),
            R::Vec3::new(z_0 * dx - dy, z_0 * dy + dx, diagonal + z_0 * dz),
        );
        Xform {
            rot: x.rot * rot,
            pos: self.point + rot.transpose_mul(x.pos - self.rest),
        }
    }

    /// The velocity against the link of the rates of its modes, and what the acceleration at η̈ = 0 is.
    #[inline(always)]
    pub(super) fn velocity<const M: usize>(
        &self,
        modes: &Modes<R, M>,
        range: &Range<usize>,
        rates: &[R; M],
    ) -> [Motion<R>; 2] {
        let (shift, g_dot) = displacement(modes, range, rates);
        let velocity = self.motion(shift, g_dot);
        let twice = self.scale * self.g.dot(g_dot);
        let ang = -(velocity.ang * (twice + twice));
        let lin = shift.cross(velocity.ang) + self.point.cross(ang);
        [velocity, Motion::new(ang, lin)]
    }

    /// The acceleration against the link at η̇ = 0.
    #[inline(always)]
    pub(super) fn acceleration<const M: usize>(
        &self,
        modes: &Modes<R, M>,
        range: &Range<usize>,
        accelerations: &[R; M],
    ) -> Motion<R> {
        let (shift, g_dot) = displacement(modes, range, accelerations);
        self.motion(shift, g_dot)
    }

    /// The motion per rate of mode k.
    #[inline(always)]
    pub(super) fn column<const M: usize>(&self, modes: &Modes<R, M>, k: usize) -> Motion<R> {
        modes.each.get(k).map_or(Motion::ZERO, |mode| {
            self.motion(mode.shift, mode.turn * R::from_f64(0.5))
        })
    }

    #[inline(always)]
    fn motion(&self, shift: R::Vec3, g_dot: R::Vec3) -> Motion<R> {
        let ang = (g_dot + self.g.cross(g_dot)) * (self.scale + self.scale);
        Motion::new(ang, shift + self.point.cross(ang))
    }

    /// What a force on the end is to mode k: a moment for ψₖ and a force for φₖ.
    #[inline(always)]
    pub(super) fn load(&self, f: Force<R>) -> Force<R> {
        let moment = f.ang - self.point.cross(f.lin);
        Force::new((moment - self.g.cross(moment)) * self.scale, f.lin)
    }
}

/// Displacement and Rodrigues parameters of the end, or their rates.
#[inline(always)]
fn displacement<R: Real, const M: usize>(
    modes: &Modes<R, M>,
    range: &Range<usize>,
    x: &[R; M],
) -> (R::Vec3, R::Vec3) {
    let (mut shift, mut turn) = (R::Vec3::ZERO, R::Vec3::ZERO);
    for k in range.clone() {
        if let Some(mode) = modes.each.get(k) {
            shift += mode.shift * entry(x, k);
            turn += mode.turn * entry(x, k);
        }
    }
    (shift, turn * R::from_f64(0.5))
}
