//! The data of forward dynamics by clusters: bodies, groups of bodies, and the factors of D.

use super::layout::INDEPENDENT;
use crate::algorithms::Magnitude;
use crate::model::LinkView;
use crate::scalar::Real;
use crate::spatial::inertia::ArticulatedInertia;
use crate::spatial::{Force, Motion, Xform};
use crate::state::entry;

/// The data of a body in the three passes.
pub(super) struct Body<'a, R: Real> {
    pub(super) link: LinkView<'a, R>,
    pub(super) x: Xform<R>,
    /// S̊ q̇ + v × S q̇ + S Ġ ẏ.
    pub(super) c: Motion<R>,
    /// Iᴬ and pᴬ of the body with the clusters that it carries, and the largest that the inertia
    /// could be.
    pub(super) ia: ArticulatedInertia<R>,
    pub(super) pa: Force<R>,
    pub(super) magnitude: Magnitude<R>,
    /// The body's acceleration within its cluster, and the force on it.
    pub(super) accel: Motion<R>,
    pub(super) force: Force<R>,
}

/// The results of eliminating an independent coordinate, from D = L Δ Lᵀ: L⁻¹ Uᵀ, 1/Δ, L⁻¹ u, and
/// the row of L.
#[derive(Clone, Copy, Default)]
pub(super) struct Factor<R: Real> {
    pub(super) z: Force<R>,
    pub(super) d_inv: R,
    pub(super) u: R,
    pub(super) l: [R; INDEPENDENT],
}

/// A column of D during its factorisation.
#[derive(Clone, Copy, Default)]
pub(super) struct Column<R: Real> {
    pub(super) d: [R; INDEPENDENT],
    /// The scale of the pivot's rounding errors.
    pub(super) noise: R,
    pub(super) factor: Factor<R>,
}

impl<R: Real> Column<R> {
    /// Subtracts the multiples of the columns before it; returns the pivot.
    pub(super) fn eliminate(&mut self, before: &[Self]) -> R {
        let k = before.len();
        for (earlier, l) in before.iter().zip(&mut self.factor.l) {
            *l = entry(&earlier.d, k) * earlier.factor.d_inv;
            for (d, &above) in self.d.iter_mut().zip(&earlier.d).skip(k) {
                *d -= *l * above;
            }
            self.factor.z -= earlier.factor.z * *l;
            self.factor.u -= *l * earlier.factor.u;
            self.noise += *l * *l * earlier.noise;
        }
        let pivot = entry(&self.d, k);
        self.factor.d_inv = R::ONE / pivot;
        pivot
    }
}

/// A group of bodies that is eliminated at once: those of a cluster, or a body in none.
pub(super) struct Group {
    /// Its first body.
    pub(super) root: usize,
    /// One past its last body.
    pub(super) end: usize,
    /// The cluster, or `NONE`.
    pub(super) cluster: usize,
    /// The place of its first coordinate in ẏ, and their number.
    pub(super) first: usize,
    pub(super) count: usize,
}

impl Group {
    /// The parent of a body, if it is of the group too: the body that carries the group is listed
    /// before all of it.
    pub(super) fn parent_in<'b, 'a, R: Real>(
        &self,
        inner: &'b mut [Body<'a, R>],
        link: &LinkView<'_, R>,
    ) -> Option<&'b mut Body<'a, R>> {
        (link.parent >= self.root).then(|| inner.get_mut(link.parent)).flatten()
    }
}
