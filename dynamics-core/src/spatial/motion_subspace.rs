//! A column of S, the motion subspace of a joint, in an aligned frame.

use super::{Force, Motion};
use crate::scalar::{Real, Vector};

/// The velocity of a joint at unit rate of one of its coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum MotionSubspace<R: Real> {
    /// A rotation about z.
    RevoluteZ,
    /// A translation along z.
    PrismaticZ,
    /// Any other.
    General(Motion<R>),
}

impl<R: Real> MotionSubspace<R> {
    /// sᵀ f.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn dot(&self, f: Force<R>) -> R {
        match self {
            Self::RevoluteZ => f.ang.array()[2],
            Self::PrismaticZ => f.lin.array()[2],
            Self::General(s) => s.dot(f),
        }
    }

    /// m + s rate.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn add_scaled_to(&self, m: Motion<R>, rate: R) -> Motion<R> {
        match self {
            Self::RevoluteZ => Motion::new(raised(m.ang, rate), m.lin),
            Self::PrismaticZ => Motion::new(m.ang, raised(m.lin, rate)),
            Self::General(s) => m + *s * rate,
        }
    }
}

/// v + z r.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn raised<R: Real>(v: R::Vec3, r: R) -> R::Vec3 {
    let [x, y, z] = v.array();
    R::Vec3::new(x, y, z + r)
}
