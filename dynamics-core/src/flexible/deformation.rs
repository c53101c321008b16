//! A link that is bent: its inertia, the forces of its modes, and the motion of its end.
//!
//! With r = r₀ + Σ φₖ ηₖ in the link's frame, every integral over the mass follows from ∫ φₖ dm, ∫ φₖ r₀ᵀ dm and
//! ∫ φₖ φₗᵀ dm. Shabana, *Dynamics of Multibody Systems* (2005), section 5.4, has them as invariants.

use core::ops::Range;

use super::Modes;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::entry;

/// Φₖ = ∫ φₖ rᵀ dm of the deformed link, of the modes that are its own.
#[derive(Clone, Copy)]
pub(super) struct Moments<R: Real, const M: usize> {
    pub(super) each: [R::Mat3; M],
}

impl<R: Real, const M: usize> Moments<R, M> {
    #[inline(always)]
    pub(super) fn of(modes: &Modes<R, M>, range: &Range<usize>, eta: &[R; M]) -> Self {
        let mut each = [R::Mat3::ZERO; M];
        for k in range.clone() {
            let (Some(moments), Some(mode), Some(products)) =
                (each.get_mut(k), modes.each.get(k), modes.products.get(k))
            else {
                break;
            };
            *moments = mode.moments;
            for l in range.clone() {
                if let Some(&product) = products.get(l) {
                    *moments += product * entry(eta, l);
                }
            }
        }
        Self { each }
    }

    /// The inertia of the deformed link about its joint: with ∫ r rᵀ dm greater by Σ ηₖ (Φₖ + ∫ r₀ φₖᵀ dm).
    #[inline(always)]
    pub(super) fn inertia(
        &self,
        modes: &Modes<R, M>,
        range: &Range<usize>,
        rigid: SpatialInertia<R>,
        eta: &[R; M],
    ) -> SpatialInertia<R> {
        let (mut first, mut second) = (rigid.first_moment, R::Mat3::ZERO);
        for k in range.clone() {
            let (Some(mode), Some(&moments)) = (modes.each.get(k), self.each.get(k)) else {
                break;
            };
            first += mode.momentum * entry(eta, k);
            second += (moments + mode.moments.transpose()) * entry(eta, k);
        }
        SpatialInertia {
            mass: rigid.mass,
            first_moment: first,
            rotational: rigid.rotational + R::Mat3::IDENTITY * trace::<R>(&second) - second,
        }
    }

    /// The momentum of mode k at unit rate, about the joint: ∫ r × φₖ dm and ∫ φₖ dm.
    #[inline(always)]
    pub(super) fn momentum(&self, modes: &Modes<R, M>, k: usize) -> Force<R> {
        match (modes.each.get(k), self.each.get(k)) {
            (Some(mode), Some(moments)) => Force::new(axial::<R>(moments), mode.momentum),
            _ => Force::ZERO,
        }
    }

    /// Σ xₖ Φₖ, and Σ xₖ ∫ φₖ dm.
    #[inline(always)]
    pub(super) fn sum(
        &self,
        modes: &Modes<R, M>,
        range: &Range<usize>,
        x: &[R; M],
    ) -> (R::Mat3, R::Vec3) {
        let mut sum = (R::Mat3::ZERO, R::Vec3::ZERO);
        for k in range.clone() {
            if let (Some(mode), Some(&moments)) = (modes.each.get(k), self.each.get(k)) {
                sum.0 += moments * entry(x, k);
                sum.1 += mode.momentum * entry(x, k);
            }
        }
        sum
    }
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// ∫ φₖ·φₗ dm: the inertia between two modes of a link.
    #[inline(always)]
    pub(super) fn inertia(&self, k: usize, l: usize) -> R {
        let product = self.products.get(k).and_then(|row| row.get(l));
        product.map_or(R::ZERO, trace::<R>)
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
/// 2 / (1 + g²) (ġ − g × ġ) in the end's axes: Shuster, "A survey of attitude representations" (1993).
#[derive(Clone, Copy)]
pub(super) struct End<R: Real> {
    /// From the link's frame to that which stands on the end, both where they coincide undeformed.
    pub(super) x: Xform<R>,
    g: R::Vec3,
    /// 1 / (1 + g²)
    scale: R,
    /// The end undeformed.
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
        let point = modes
            .each
            .get(range.start)
            .map_or(R::Vec3::ZERO, |mode| mode.end);
        let (squared, one) = (g.dot(g), R::ONE);
        let scale = one / (one + squared);
        let double = g * (scale + scale);
        let ([x, y, z], [dx, dy, dz]) = (g.array(), double.array());
        let diagonal = (one - squared) * scale;
        // Rᵀ = (1 − g²)/(1 + g²) 1 + 2/(1 + g²) (g gᵀ − g×)
        let rot = R::Mat3::from_cols(
            R::Vec3::new(diagonal + x * dx, x * dy - dz, x * dz + dy),
            R::Vec3::new(y * dx + dz, diagonal + y * dy, y * dz - dx),
            R::Vec3::new(z * dx - dy, z * dy + dx, diagonal + z * dz),
        );
        let pos = point + shift - rot.transpose_mul(point);
        Self {
            x: Xform { rot, pos },
            g,
            scale,
            point,
        }
    }

    /// ω of ġ.
    #[inline(always)]
    fn omega(&self, g_dot: R::Vec3) -> R::Vec3 {
        (g_dot - self.g.cross(g_dot)) * (self.scale + self.scale)
    }

    /// The velocity of the end against the link of the rates of its modes, and Rᵀ ḋ.
    #[inline(always)]
    pub(super) fn velocity<const M: usize>(
        &self,
        modes: &Modes<R, M>,
        range: &Range<usize>,
        rates: &[R; M],
    ) -> EndVelocity<R> {
        let (shift, g_dot) = displacement(modes, range, rates);
        let (ang, slide) = (self.omega(g_dot), self.x.rot * shift);
        EndVelocity {
            motion: Motion::new(ang, slide - ang.cross(self.point)),
            slide,
            g_dot,
        }
    }

    /// The acceleration against the link at η̈ = 0, as the end's axes have it.
    #[inline(always)]
    pub(super) fn velocity_product(&self, velocity: &EndVelocity<R>) -> Motion<R> {
        let (g_dot, omega) = (velocity.g_dot, velocity.motion.ang);
        let twice = self.scale * self.g.dot(g_dot);
        let ang = -(omega * (twice + twice));
        Motion::new(ang, -omega.cross(velocity.slide) - ang.cross(self.point))
    }

    /// The motion of the end per rate of mode k.
    #[inline(always)]
    pub(super) fn column<const M: usize>(&self, modes: &Modes<R, M>, k: usize) -> Motion<R> {
        let rates = core::array::from_fn(|l| if l == k { R::ONE } else { R::ZERO });
        self.velocity(modes, &(k..k + 1), &rates).motion
    }

    /// What a force on the end is to mode k: a moment and a force in the link's axes, for ψₖ and φₖ.
    #[inline(always)]
    pub(super) fn load(&self, f: Force<R>) -> Force<R> {
        let moment = f.ang - self.point.cross(f.lin);
        Force::new(
            (moment + self.g.cross(moment)) * self.scale,
            self.x.rot.transpose_mul(f.lin),
        )
    }
}

/// The velocity of an end against its link.
#[derive(Clone, Copy)]
pub(super) struct EndVelocity<R: Real> {
    pub(super) motion: Motion<R>,
    slide: R::Vec3,
    g_dot: R::Vec3,
}

/// Σ φₖ xₖ and ½ Σ ψₖ xₖ at the end.
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
