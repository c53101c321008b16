//! Whether a pivot of articulated bodies is more than rounding left of nothing.
//!
//! D = sᵀ Iᴬ s is what the inertia along s was before joints gave way, less (s·U)²/D of each that did. Where
//! these are nearly the same, their difference is rounding: a pivot has to be more than some roundings of both
//! together, whatever the robot's size. Only the joints next to it are asked, those that hang on it and those
//! on its own body: an axis that coincides with theirs, with nothing between, is what makes M singular.

use super::NotPositiveDefinite;
use super::factor::check;
use crate::model::{Node, Turn};
use crate::scalar::Real;
use crate::spatial::{Force, Xform};
use crate::state::entry;

/// What was taken of the inertia along each coordinate.
pub(super) struct Taken<R, const V: usize>([R; V]);

impl<R: Real, const V: usize> Taken<R, V> {
    /// Nothing yet.
    pub(super) const NONE: Self = Self([R::ZERO; V]);

    /// Whether what is left of coordinate `joint`, `d`, is a number and more than rounding. 3 flops.
    #[inline(always)]
    pub(super) fn check(&self, d: R, joint: usize) -> Result<(), NotPositiveDefinite> {
        check(d, d + entry(&self.0, joint), joint)
    }

    /// Adds what coordinate `k` of a body takes by giving way, along the body's coordinates before it and those
    /// of its parent. 24 flops for a revolute joint on another.
    #[inline(always)]
    pub(super) fn by(
        &mut self,
        (node, k): (&Node<'_, R>, usize),
        parent: Option<(&Node<'_, R>, &Xform<R>)>,
        turns: &[Turn<R>],
        (u_hat, per_d): (Force<R>, R),
    ) {
        for (l, joint) in node.coordinates().enumerate().take(k) {
            self.add(joint, node.axis(turns, l).dot(u_hat), per_d);
        }
        if let Some((parent, x)) = parent {
            for (l, joint) in parent.coordinates().enumerate() {
                let s = parent.axis(turns, l).beyond(x);
                self.add(joint, s.dot(u_hat), per_d);
            }
        }
    }

    #[inline(always)]
    fn add(&mut self, joint: usize, felt: R, per_d: R) {
        if let Some(taken) = self.0.get_mut(joint) {
            *taken += felt * felt * per_d;
        }
    }
}
