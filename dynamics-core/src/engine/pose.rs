//! The pose of a body in the base, for effects that read it.

use super::compile::{BodyPlacement, Compiled, CompiledJoint};
use super::displacement::Displacement;
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use crate::scalar::{Matrix, Real};
use crate::spatial::Xform;

/// A body's axes and origin in base coordinates, the origin in units of length.
#[derive(Clone, Copy)]
pub(crate) struct Pose<R> {
    pub(crate) axes: Mat3<R>,
    pub(crate) origin: Vec3<R>,
}

impl<R: Real> Pose<R> {
    /// The pose that no effect reads.
    pub(crate) const UNKNOWN: Self = Self { axes: Mat3::ZERO, origin: Vec3::ZERO };

    /// The base itself.
    pub(crate) const BASE: Self = {
        let (one, zero) = (Folded::ONE, Folded::ZERO);
        Self {
            axes: Mat3([Vec3([one, zero, zero]), Vec3([zero, one, zero]), Vec3([zero, zero, one])]),
            origin: Vec3::ZERO,
        }
    };

    /// The pose of a child behind joint I.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn transformed_by<T: Compiled, const I: usize>(
        &self,
        at: &Displacement<R, T, I>,
    ) -> Self {
        let joint = CompiledJoint::<T, I>::JOINT;
        let [x, y, z] = Mat3::constant(&joint.rot).0;
        let axes = Mat3([self.axes.mul(x), self.axes.mul(y), self.axes.mul(z)]);
        let origin = self.origin + self.axes.mul(Vec3::constant(joint.pos));
        Self { axes: at.axes(&axes), origin: origin + at.along(&axes) }
    }

    /// The pose of the same body's point at `p`, in its axes.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn moved(&self, p: Vec3<R>) -> Self {
        Self { origin: self.origin + self.axes.mul(p), ..*self }
    }

    /// The same with axes that `to_axes` turns to from these.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turned(&self, to_axes: &Mat3<R>) -> Self {
        let [x, y, z] = to_axes.rows();
        Self { axes: Mat3([self.axes.mul(x), self.axes.mul(y), self.axes.mul(z)]), ..*self }
    }

    /// ᵘX₀ of a body of the description: from the base to its own frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of(&self, place: &BodyPlacement, length: Folded<R>) -> Xform<R> {
        let [x, y, z] = Mat3::constant(&place.rot).0;
        let axes = [self.axes.mul(x), self.axes.mul(y), self.axes.mul(z)];
        let [x, y, z] = axes.map(Vec3::get);
        let pos = self.origin + self.axes.mul(Vec3::constant(place.pos));
        Xform { rot: R::Mat3::from_cols(x, y, z).transpose(), pos: pos.scale(length).get() }
    }
}
