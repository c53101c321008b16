//! Detects pivots of articulated bodies that are only rounding errors, that is, a singular mass
//! matrix.
//!
//! D = sᵀ Iᴬ s is the inertia along s with all descendants fixed, minus a term for each descendant
//! that is free. If the exact difference is zero, D is the rounding error of its terms, of either
//! sign. The terms are bounded by their values for a straight chain of the descendants: m, |h| and
//! ∫ r² dm add up along the bodies' offsets, independently of their directions, across fixed bodies
//! and bodies without inertia. A pivot must exceed some roundings of this bound.
//!
//! The coordinates of one joint are one block, which is eliminated a coordinate at a time. A small
//! pivot amplifies the rounding errors: the following coordinates of the joint inherit its error,
//! times the square of the multiplier.

use core::ops::AddAssign;

use super::NotPositiveDefinite;
use crate::model::{JointCoordinate, LinkView};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::MotionSubspace;
use crate::spatial::{Force, SpatialInertia};

/// The number of roundings that a pivot must exceed: up to 3.1 were measured for singular M, and no
/// fewer than 51 for regular ones (a rope of ten light rods with a weight at its end, in f32).
const ROUNDINGS: f64 = 8.0;

/// The coordinates of a free joint.
const MOST: usize = 6;

/// Mass, largest first moment and largest ∫ r² dm of the bodies that a joint moves, about its
/// frame's origin.
#[derive(Clone, Copy)]
pub(crate) struct Magnitude<R> {
    mass: R,
    first_moment: R,
    second: R,
}

impl<R: Real> From<&SpatialInertia<R>> for Magnitude<R> {
    #[cfg_attr(optimised, inline(always))]
    fn from(body: &SpatialInertia<R>) -> Self {
        let [x, y, z] = body.rotational.cols().map(Vector::array);
        Self {
            mass: body.mass,
            first_moment: length::<R>(body.first_moment),
            second: (x[0] + y[1] + z[2]) * R::from_f64(0.5),
        }
    }
}

impl<R: Real> AddAssign for Magnitude<R> {
    #[cfg_attr(optimised, inline(always))]
    fn add_assign(&mut self, o: Self) {
        self.mass += o.mass;
        self.first_moment += o.first_moment;
        self.second += o.second;
    }
}

impl<R: Real> Magnitude<R> {
    /// The same about the origin of the parent's frame, from which the body's is at `pos`. 10
    /// flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn at_parent(&self, pos: R::Vec3) -> Self {
        self.at_distance(length::<R>(pos))
    }

    /// The same about a point at most `r` away. 7 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn at_distance(&self, r: R) -> Self {
        let moment = self.first_moment + r * self.mass;
        Self {
            mass: self.mass,
            first_moment: moment,
            second: self.second + r * (self.first_moment + moment),
        }
    }

    /// The largest sᵀ Iᶜ s.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along(&self, s: &MotionSubspace<R>) -> R {
        match s {
            MotionSubspace::RevoluteZ => self.second,
            MotionSubspace::PrismaticZ => self.mass,
            MotionSubspace::Unit(0..3) => self.second,
            MotionSubspace::Unit(_) => self.mass,
            MotionSubspace::General(s) => {
                s.ang.dot(s.ang) * self.second + s.lin.dot(s.lin) * self.mass
            }
        }
    }
}

/// |x| + |y| + |z|, a bound of the length without a root.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn length<R: Real>(v: R::Vec3) -> R {
    let [x, y, z] = v.array();
    x.abs() + y.abs() + z.abs()
}

/// The bounds of the pivots of one joint, from its last coordinate to its first.
pub(crate) struct PivotCheck<R> {
    magnitude: Magnitude<R>,
    /// The errors that coordinates inherit from those eliminated before them.
    inherited: [R; MOST],
}

impl<R: Real> PivotCheck<R> {
    /// The noise for a joint that moves bodies of `magnitude`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of(magnitude: Magnitude<R>) -> Self {
        let inherited = [R::ZERO; MOST];
        Self { magnitude, inherited }
    }

    /// Whether `d`, the pivot of coordinate `k` of the link's joint, is not NaN and exceeds rounding
    /// errors.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn check(
        &mut self,
        link: &LinkView<'_, R>,
        k: usize,
        turns: &[JointCoordinate<R>],
        u_a: Force<R>,
        d: R,
    ) -> Result<(), NotPositiveDefinite> {
        let inherited = self.inherited.get(k).copied().unwrap_or_default();
        let size = self.magnitude.along(&link.subspace(turns, k)) + inherited;
        exceeds(d, size * (R::EPSILON * R::from_f64(ROUNDINGS)), link.idx_v() + k)?;
        let d_inv = R::ONE / d;
        for (l, inherited) in self.inherited.iter_mut().enumerate().take(k) {
            let multiplier = link.subspace(turns, l).dot(u_a) * d_inv;
            *inherited += multiplier * multiplier * size;
        }
        Ok(())
    }
}

/// Fails unless a pivot is finite and exceeds the rounding error `noise`. The pivots of M have the
/// same check with `is_finite`, which compiles to thirty integer instructions: here zero times the
/// pivot is compared with zero.
#[cfg_attr(optimised, inline(always))]
fn exceeds<R: Real>(pivot: R, noise: R, joint: usize) -> Result<(), NotPositiveDefinite> {
    if pivot > noise && pivot > R::ZERO && pivot * R::ZERO == R::ZERO {
        return Ok(());
    }
    Err(NotPositiveDefinite { joint })
}
