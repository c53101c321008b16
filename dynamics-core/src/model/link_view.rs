//! One link of a robot, as the algorithms visit it.

use core::ops::Deref;

use super::Link;
use super::joint_kind::{JointKind, JointKinds};
use crate::math::entry;
use crate::scalar::Real;

/// A link with the facts about its joint that are known at compile time.
#[derive(Clone, Copy, Debug)]
pub struct LinkView<'a, R: Real> {
    link: &'a Link<R>,
    pub(super) kind: JointKind,
    pub(super) idx_q: usize,
    pub(super) idx_v: usize,
}

impl<R: Real> Deref for LinkView<'_, R> {
    type Target = Link<R>;
    #[cfg_attr(optimised, inline(always))]
    fn deref(&self) -> &Link<R> {
        self.link
    }
}

impl<'a, R: Real> LinkView<'a, R> {
    /// Link `i`, its joint one of `kinds`; `single`: every body has one coordinate.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn new(i: usize, link: &'a Link<R>, kinds: JointKinds, single: bool) -> Self {
        let (idx_q, idx_v) = if single { (i, i) } else { (link.idx_q, link.idx_v) };
        Self { link, kind: kinds.of(link.joint.kind), idx_q, idx_v }
    }

    /// The kind of its joint.
    #[cfg_attr(optimised, inline(always))]
    pub fn kind(&self) -> JointKind {
        self.kind
    }

    /// Index of its first position in q.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn idx_q(&self) -> usize {
        self.idx_q
    }

    /// Index of its first velocity in q̇.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn idx_v(&self) -> usize {
        self.idx_v
    }

    /// Its velocity coordinates, as indices of q̇.
    #[cfg_attr(optimised, inline(always))]
    pub fn coordinates(&self) -> core::ops::Range<usize> {
        let (_, count) = self.kind.coordinates();
        if count == 0 {
            return 0..0;
        }
        self.idx_v..self.idx_v + count
    }

    /// The position that belongs to the velocity coordinate k; zero where none does, as with the ω
    /// of a quaternion.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn position(&self, q: &[R], k: usize) -> R {
        let (_, quaternion) = self.kind.angles();
        let place = k - self.idx_v;
        match quaternion {
            0 => entry(q, self.idx_q + place),
            _ if place < 3 => R::ZERO,
            _ => entry(q, self.idx_q + place + 1),
        }
    }
}
