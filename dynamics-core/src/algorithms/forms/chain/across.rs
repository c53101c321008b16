//! ⁱX_λ(i) across a link of a chain, in the form that its robot has, and motions across its joint's
//! axis.

use core::ops::Mul;

use crate::algorithms::pivot_check::length;
use crate::model::{JointCoordinate, LinkView};
use crate::scalar::{Real, Vector};
use crate::spatial::inertia::{ArticulatedInertia, CompositeInertia, FreeAboutZ};
use crate::spatial::{AxialScrews, Force, Motion, Xform};

/// A transform across a link. Only the part of it is kept that the robot and the sines and cosines
/// do not hold.
pub(super) trait Across<R: Real>: Copy + Mul<Motion<R>, Output = Motion<R>> {
    type Memo: Copy;
    fn of(link: &LinkView<'_, R>, turns: &[JointCoordinate<R>]) -> Self;
    fn memo(&self) -> Self::Memo;
    fn again(memo: Self::Memo, link: &LinkView<'_, R>, turns: &[JointCoordinate<R>]) -> Self;
    /// A bound of the distance between the origins.
    fn distance(&self) -> R;
    /// Xᵀ f.
    fn force_back(&self, f: Force<R>) -> Force<R>;
    /// Xᵀ Iᶜ X.
    fn composite_back(&self, ic: &CompositeInertia<R>) -> CompositeInertia<R>;
    /// Xᵀ Iᵃ X.
    fn inertia_back(&self, ia: &ArticulatedInertia<R>) -> ArticulatedInertia<R>;
    /// The same where the joint turns freely about z.
    fn free_back(&self, ia: &FreeAboutZ<R>) -> ArticulatedInertia<R>;
}

impl<R: Real> Across<R> for Xform<R> {
    type Memo = R::Mat3;
    #[cfg_attr(optimised, inline(always))]
    fn of(link: &LinkView<'_, R>, turns: &[JointCoordinate<R>]) -> Self {
        link.xform(turns)
    }
    #[cfg_attr(optimised, inline(always))]
    fn memo(&self) -> R::Mat3 {
        self.rot
    }
    #[cfg_attr(optimised, inline(always))]
    fn again(rot: R::Mat3, link: &LinkView<'_, R>, turns: &[JointCoordinate<R>]) -> Self {
        link.xform_of(rot, turns)
    }
    #[cfg_attr(optimised, inline(always))]
    fn distance(&self) -> R {
        length::<R>(self.pos)
    }
    #[cfg_attr(optimised, inline(always))]
    fn force_back(&self, f: Force<R>) -> Force<R> {
        self.transpose_mul(f)
    }
    #[cfg_attr(optimised, inline(always))]
    fn composite_back(&self, ic: &CompositeInertia<R>) -> CompositeInertia<R> {
        ic.at_parent(self)
    }
    #[cfg_attr(optimised, inline(always))]
    fn inertia_back(&self, ia: &ArticulatedInertia<R>) -> ArticulatedInertia<R> {
        ia.at_parent(self)
    }
    #[cfg_attr(optimised, inline(always))]
    fn free_back(&self, ia: &FreeAboutZ<R>) -> ArticulatedInertia<R> {
        ia.at_parent(self)
    }
}

impl<R: Real> Across<R> for AxialScrews<R> {
    /// The shift along z.
    type Memo = R;
    #[cfg_attr(optimised, inline(always))]
    fn of(link: &LinkView<'_, R>, turns: &[JointCoordinate<R>]) -> Self {
        link.screws(turns)
    }
    #[cfg_attr(optimised, inline(always))]
    fn memo(&self) -> R {
        self.about_z.shift
    }
    #[cfg_attr(optimised, inline(always))]
    fn again(shift: R, link: &LinkView<'_, R>, turns: &[JointCoordinate<R>]) -> Self {
        link.screws_of(shift, turns)
    }
    #[cfg_attr(optimised, inline(always))]
    fn distance(&self) -> R {
        self.distance()
    }
    #[cfg_attr(optimised, inline(always))]
    fn force_back(&self, f: Force<R>) -> Force<R> {
        self.transpose_mul(f)
    }
    #[cfg_attr(optimised, inline(always))]
    fn composite_back(&self, ic: &CompositeInertia<R>) -> CompositeInertia<R> {
        self.composite_at_parent(ic)
    }
    #[cfg_attr(optimised, inline(always))]
    fn inertia_back(&self, ia: &ArticulatedInertia<R>) -> ArticulatedInertia<R> {
        self.articulated_at_parent(ia)
    }
    #[cfg_attr(optimised, inline(always))]
    fn free_back(&self, ia: &FreeAboutZ<R>) -> ArticulatedInertia<R> {
        self.free_at_parent(ia)
    }
}

/// A motion without components along z, as v × S q̇ is where S lies along z.
#[derive(Clone, Copy)]
pub(super) struct AcrossZ<R>([[R; 2]; 2]);

impl<R: Real> AcrossZ<R> {
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of(m: Motion<R>) -> Self {
        Self([m.ang, m.lin].map(|m| [m.array()[0], m.array()[1]]))
    }

    /// With −0 along z, which the compiler does not add.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn motion(self) -> Motion<R> {
        let [ang, lin] = self.0.map(|[x, y]| R::Vec3::new(x, y, -R::ZERO));
        Motion::new(ang, lin)
    }
}
