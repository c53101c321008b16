//! A column of S, the motion subspace of a joint, in an aligned frame.

use super::node::raised;
use super::{JointKind, Node, Turn};
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion};

/// The velocity across a joint at unit rate of one of its coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Axis<R: Real> {
    /// A turn about z.
    Turn,
    /// A slide along z.
    Slide,
    /// Any other.
    Any(Motion<R>),
}

impl<R: Real> Axis<R> {
    /// sᵀ f.
    #[inline(always)]
    pub(crate) fn dot(&self, f: Force<R>) -> R {
        match self {
            Self::Turn => f.ang.array()[2],
            Self::Slide => f.lin.array()[2],
            Self::Any(s) => s.dot(f),
        }
    }

    /// m + s rate.
    #[inline(always)]
    pub(crate) fn raise(&self, m: Motion<R>, rate: R) -> Motion<R> {
        match self {
            Self::Turn => Motion::new(raised(m.ang, rate), m.lin),
            Self::Slide => Motion::new(m.ang, raised(m.lin, rate)),
            Self::Any(s) => m + *s * rate,
        }
    }
}

impl<R: Real> Node<'_, R> {
    /// Column k of S.
    #[inline(always)]
    pub(crate) fn axis(&self, turns: &[Turn<R>], k: usize) -> Axis<R> {
        match self.kind {
            JointKind::Revolute | JointKind::Continuous => Axis::Turn,
            JointKind::Prismatic => Axis::Slide,
            _ => Axis::Any(self.column(turns, k)),
        }
    }
}
