//! Way-points of an arm that is guided by hand.
//!
//! The distance of two way-points counts the joints by their spacings d: |Δ|² = Σ (Δq_j / d_j)². A
//! way-point is stored where the arm is at least at the distance 1 from the last one.

use crate::entry;
use crate::limits::{Circles, ConfigError, ConfigParameter};
use crate::reference::{PathSpline, PathSplineError};
use dynamics_core::scalar::Real;
use dynamics_core::state::all_finite;

#[cfg(test)]
mod tests;

/// The way-points of an arm that is guided by hand: at most N of them, at distances that are
/// stated.
///
/// [`Self::record`] is called in each tick while a hand moves the arm
/// ([`HandGuiding`](crate::law::HandGuiding)), [`Self::end`] once after it; [`Self::spline`] then
/// makes the path that [`TimedPath`](crate::reference::TimedPath) gives a time. The speed and the
/// evenness of the hand's motion leave no trace.
///
/// ```
/// use motion_control::reference::{Recorded, TaughtPath};
/// let mut taught = TaughtPath::<f32, 2, 8>::try_new([0.1, 0.1])?;
/// assert_eq!(taught.record(&[0.0, 0.0]), Recorded::Stored);
/// assert_eq!(taught.record(&[0.05, 0.0]), Recorded::Near);
/// assert_eq!(taught.record(&[0.12, f32::NAN]), Recorded::NotFinite { joint: 1 });
/// assert_eq!(taught.record(&[0.08, 0.08]), Recorded::Stored);
/// assert_eq!(taught.record(&[0.2, 0.1]), Recorded::Stored);
/// assert_eq!(taught.end(&[0.3, 0.1]), Recorded::Stored);
/// let path = taught.spline(&[0.0; 2])?;
/// # use motion_control::reference::GeometricPath;
/// assert_eq!(path.point(1.0).q, [0.3, 0.1]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "lead-through teaching")]
#[doc(alias = "teach-in")]
#[doc(alias = "record and playback")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaughtPath<R, const V: usize, const N: usize, const CIRCLES: u128 = 0> {
    points: [[R; V]; N],
    count: usize,
    spacing: [R; V],
    /// 1/d.
    spacing_inv: [R; V],
}

/// The fate of the positions of a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Recorded {
    /// They are a way-point.
    Stored,
    /// They are nearer to the last way-point than the spacing, and are not stored.
    Near,
    /// They would be a way-point, but there are N already. All of these are kept; the path ends at
    /// the last one.
    Full,
    /// A position is not finite; nothing is stored.
    NotFinite {
        /// The first joint with such a position.
        joint: usize,
    },
}

impl<R: Real, const V: usize, const N: usize> TaughtPath<R, V, N> {
    /// No way-points, with these spacings d of the joints, rad or m; N ≥ 2, which the compiler
    /// checks.
    ///
    /// A spacing of fifty times the noise of the encoders leaves little of the noise in the
    /// curvature of the path.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] if a spacing is not a positive number.
    pub fn try_new(spacing: [R; V]) -> Result<Self, ConfigError> {
        const { assert!(N >= 2, "a path has at least two way-points") };
        for distance in spacing {
            ConfigParameter::PathSpacing.positive(distance)?;
            ConfigParameter::PathSpacing.positive(R::ONE / distance)?;
        }
        Ok(Self {
            points: [[R::ZERO; V]; N],
            count: 0,
            spacing,
            spacing_inv: spacing.map(|d| R::ONE / d),
        })
    }

    /// The same for joints of which those of [`Circles::bits`] are circles: the way-points of these
    /// are on the turn of the one before, so that the path is the way that the hand went, through a
    /// seam of the measurement, too.
    #[must_use]
    pub fn on_circles<const CIRCLES: u128>(self) -> TaughtPath<R, V, N, CIRCLES> {
        let Self { points, count, spacing, spacing_inv } = self;
        TaughtPath { points, count, spacing, spacing_inv }
    }
}

impl<R: Real, const V: usize, const N: usize, const CIRCLES: u128> TaughtPath<R, V, N, CIRCLES> {
    const CIRCLES: Circles = Circles::from_bits(CIRCLES);

    /// Records the positions q (rad, m) of a tick.
    ///
    /// # Cost
    /// By count: 3 flops a joint; no root, no division. Only [`Recorded::Stored`] writes.
    #[inline]
    pub fn record(&mut self, q: &[R; V]) -> Recorded {
        if let Some(joint) = not_finite(q) {
            return Recorded::NotFinite { joint };
        }
        match self.points().last() {
            Some(last) if self.square_distance(last, q) < R::ONE => Recorded::Near,
            // A seam lies between the two, or the arm is further away.
            Some(last) if Self::CIRCLES.any() => {
                let q = Self::CIRCLES.near(q, last);
                if self.square_distance(last, &q) < R::ONE {
                    return Recorded::Near;
                }
                self.store(&q)
            }
            _ => self.store(q),
        }
    }

    /// Ends the path at q (rad, m), wherever that is: the last way-point moves there if it is
    /// nearer than half the spacing, else q is a further one.
    ///
    /// [`Recorded::Near`] says that the arm has not moved since the first way-point, which remains
    /// the only one.
    pub fn end(&mut self, q: &[R; V]) -> Recorded {
        if let Some(joint) = not_finite(q) {
            return Recorded::NotFinite { joint };
        }
        let q = match self.points().last() {
            Some(last) if Self::CIRCLES.any() => &Self::CIRCLES.near(q, last),
            _ => q,
        };
        let half = R::from_f64(0.5);
        let near = |last: &[R; V], square| -> bool { self.square_distance(last, q) < square };
        match self.points().last() {
            Some(last) if near(last, half * half) => {
                let last = self.count - 1;
                match self.points.get_mut(last).filter(|_| last > 0) {
                    Some(point) => *point = *q,
                    None => return Recorded::Near,
                }
                Recorded::Stored
            }
            _ => self.store(q),
        }
    }

    /// The way-points, in the order of their recording.
    pub fn points(&self) -> &[[R; V]] {
        self.points.get(..self.count).unwrap_or_default()
    }

    /// Removes all way-points.
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// The smooth path near the way-points: off them by at most `tolerance` (rad, m) of each joint,
    /// as smooth as that allows; through them where it is zero. See [`PathSpline::fit`], which
    /// needs less of the stack.
    ///
    /// # Errors
    /// As [`PathSpline::fit`].
    pub fn spline(&self, tolerance: &[R; V]) -> Result<PathSpline<R, V, N>, PathSplineError> {
        let mut spline = PathSpline::EMPTY;
        spline.fit(self.points(), &self.spacing, tolerance)?;
        Ok(spline)
    }

    fn store(&mut self, q: &[R; V]) -> Recorded {
        match self.points.get_mut(self.count) {
            Some(point) => {
                *point = *q;
                self.count += 1;
                Recorded::Stored
            }
            None => Recorded::Full,
        }
    }

    #[inline(always)]
    fn square_distance(&self, from: &[R; V], to: &[R; V]) -> R {
        let joints = from.iter().zip(to).zip(&self.spacing_inv);
        joints.fold(R::ZERO, |sum, ((&from, &to), &inv)| {
            let steps = (to - from) * inv;
            sum + steps * steps
        })
    }
}

#[inline(always)]
fn not_finite<R: Real, const V: usize>(q: &[R; V]) -> Option<usize> {
    if all_finite(q) {
        return None;
    }
    (0..V).find(|&joint| !entry(q, joint).is_finite())
}
