//! A smooth path of the joints near way-points: the smoothing spline of Reinsch.
//!
//! Reinsch, "Smoothing by Spline Functions", *Numerische Mathematik* 10 (1967): of all functions,
//! the natural cubic spline with knots at t_k minimises ∫ q″² dt + Σ (q(t_k) − y_k)²/λ. With the
//! steps h_k = t_{k+1} − t_k, the second derivatives γ at the knots, which are zero at both ends,
//! and the values a,
//!
//! ```text
//! (T + λ Qᵀ W Q) γ = Qᵀ y      a = y − λ W Q γ
//! T: (h_{k−1} + h_k)/3 on and h_k/6 beside the diagonal      Q: columns 1/h_{k−1}, −1/h_{k−1} − 1/h_k, 1/h_k
//! ```
//!
//! W is the unit matrix with zeros at both ends, so that the path begins and ends at its
//! way-points. λ = 0 is the interpolating spline with its tridiagonal system. The knots are at the
//! lengths of the polygon through the way-points in spacings, so that most steps are about 1 and
//! the systems are well conditioned in f32.

use crate::entry;
use crate::real;
use crate::reference::{GeometricPath, PathPoint};
use dynamics_core::scalar::Real;
use dynamics_core::state::all_finite;

mod error;
mod smoothing;
#[cfg(test)]
mod tests;

pub use error::PathSplineError;

/// λ of the smoothest path: in a system of f32 rounding is still below 10⁻³ of the curvature. It
/// flattens waves of less than about sixty spacings.
const SMOOTHEST: f64 = 8192.0;
/// λ below which nothing is smoothed.
const LEAST: f64 = 1e-6;
/// Bisections of λ: to a factor of (8192/10⁻⁶)^(2⁻¹⁰).
const BISECTIONS: usize = 10;

/// A cubic spline of V joints with at most N knots: position, slope and curvature are continuous.
///
/// As a [`GeometricPath`], s is the share of the length of the polygon through the way-points.
///
/// ```
/// use motion_control::reference::{GeometricPath, PathSpline};
/// let points = [[0.0_f64], [1.1], [1.9], [3.1], [4.0]];
/// let mut path = PathSpline::<f64, 1, 5>::EMPTY;
/// path.fit(&points, &[1.0], &[0.0])?; // through the way-points
/// assert!((path.point(1.1 / 4.0).q[0] - 1.1).abs() < 1e-12);
/// path.fit(&points, &[1.0], &[0.2])?; // as smooth as 0.2 rad allow
/// assert!(path.deviation()[0] <= 0.2 && path.point(0.4).curvature[0].abs() < 0.1);
/// # Ok::<(), motion_control::reference::PathSplineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSpline<R, const V: usize, const N: usize> {
    /// t, and beyond the last knot its value.
    knots: [R; N],
    /// a, rad or m.
    values: [[R; V]; N],
    /// γ = d²q/dt².
    moments: [[R; V]; N],
    count: usize,
    deviation: [R; V],
}

impl<R: Real, const V: usize, const N: usize> PathSpline<R, V, N> {
    /// Rest at zero: what a `static` contains before [`Self::fit`].
    pub const EMPTY: Self = Self {
        knots: [R::ZERO; N],
        values: [[R::ZERO; V]; N],
        moments: [[R::ZERO; V]; N],
        count: 0,
        deviation: [R::ZERO; V],
    };

    /// Replaces the path by one near `points` (rad, m), off them by at most `tolerance` of each
    /// joint; at the first and the last point it is not off.
    ///
    /// The smoothing λ is the greatest that the tolerance allows, the same for all joints and
    /// points, so that the sharpest corner decides: a tolerance of zero is a path through all
    /// points, with the noise of the encoders in its curvature. `spacing` (rad, m) is the usual
    /// distance of points of each joint alone, as of [`TaughtPath`](crate::reference::TaughtPath);
    /// lengths along the path are counted in it. Between its points the path is off the polygon by
    /// the sagitta of its arc.
    ///
    /// # Cost
    /// At most twelve factorisations of a system of N rows with five diagonals, with solutions for
    /// V joints; not for a tick. 3 N numbers on the stack.
    ///
    /// # Errors
    /// [`PathSplineError`]; the path is then empty, at rest at zero.
    pub fn fit(
        &mut self,
        points: &[[R; V]],
        spacing: &[R; V],
        tolerance: &[R; V],
    ) -> Result<(), PathSplineError> {
        *self = Self::EMPTY;
        let fitted = self.smooth(points, spacing, tolerance);
        if fitted.is_err() {
            *self = Self::EMPTY;
        }
        fitted
    }

    /// The greatest distance of each joint from a way-point, rad or m.
    pub fn deviation(&self) -> [R; V] {
        self.deviation
    }

    /// The length of the path in spacings.
    pub fn length(&self) -> R {
        entry(&self.knots, self.count.saturating_sub(1))
    }

    fn smooth(
        &mut self,
        points: &[[R; V]],
        spacing: &[R; V],
        tolerance: &[R; V],
    ) -> Result<(), PathSplineError> {
        self.place_knots(points, spacing)?;
        for (joint, &tolerance) in tolerance.iter().enumerate() {
            let is_number = tolerance >= R::ZERO; // a NaN is not
            if !is_number {
                return Err(PathSplineError::Tolerance { joint });
            }
        }
        self.count = points.len();
        let lambda = self.smoothest(points, tolerance);
        self.shift(points, lambda);
        let mut numbers = self.moments.iter().chain(&self.values);
        if numbers.all(|numbers| all_finite(numbers)) {
            return Ok(());
        }
        Err(PathSplineError::TooLong)
    }

    fn place_knots(&mut self, points: &[[R; V]], spacing: &[R; V]) -> Result<(), PathSplineError> {
        if points.len() < 2 {
            return Err(PathSplineError::TooFew);
        }
        if points.len() > N {
            return Err(PathSplineError::TooMany);
        }
        let (mut t, mut last) = (R::ZERO, None);
        for (point, (q, knot)) in points.iter().zip(&mut self.knots).enumerate() {
            if let Some(joint) = q.iter().position(|q| !q.is_finite()) {
                return Err(PathSplineError::NotFinite { point, joint });
            }
            if let Some(last) = last {
                let square = square_distance(last, q, spacing);
                let next = t + if square > R::ZERO { square.sqrt() } else { R::ZERO };
                if !next.is_finite() {
                    return Err(PathSplineError::TooLong);
                }
                // Neighbours that are much nearer than others have a step that rounding would
                // change.
                let apart = next - t > R::from_f64(64.0) * R::EPSILON * next;
                if !apart {
                    return Err(PathSplineError::Coincident { point });
                }
                t = next;
            }
            (*knot, last) = (t, Some(q));
        }
        Ok(())
    }

    /// The greatest λ within the tolerance, with its moments.
    fn smoothest(&mut self, points: &[[R; V]], tolerance: &[R; V]) -> R {
        let (mut least, mut most) = (R::from_f64(LEAST), R::from_f64(SMOOTHEST));
        if self.within(points, tolerance, most) {
            return most;
        }
        let mut found = R::ZERO;
        if tolerance.iter().any(|&tolerance| tolerance > R::ZERO) {
            for _ in 0..BISECTIONS {
                let lambda = (least * most).sqrt();
                if self.within(points, tolerance, lambda) {
                    (least, found) = (lambda, lambda);
                } else {
                    most = lambda;
                }
            }
        }
        // The last one may have been beyond.
        self.within(points, tolerance, found);
        found
    }

    /// Whether the spline of this λ is within the tolerance.
    fn within(&mut self, points: &[[R; V]], tolerance: &[R; V], lambda: R) -> bool {
        self.solve(points, lambda);
        self.deviation = [R::ZERO; V];
        for k in 1..self.count.saturating_sub(1) {
            let off = self.off(k, lambda);
            for (most, off) in self.deviation.iter_mut().zip(off) {
                *most = if off.abs() > *most { off.abs() } else { *most };
            }
        }
        let mut joints = self.deviation.iter().zip(tolerance);
        joints.all(|(most, tolerance)| most <= tolerance)
    }
}

impl<R: Real, const V: usize, const N: usize> GeometricPath<R, V> for PathSpline<R, V, N> {
    /// The point at s; before 0 and after 1 that at the end. Cost: a binary search, a division, and
    /// 20 flops a joint.
    #[inline]
    fn point(&self, s: R) -> PathPoint<R, V> {
        let length = self.length();
        let t = (s * length).clamped(R::ZERO, length);
        let inner = self.knots.get(1..self.count.saturating_sub(1));
        let k = inner.unwrap_or_default().partition_point(|&knot| knot <= t);
        let h = self.step(k);
        let share = (t - entry(&self.knots, k)) / (h + R::MIN_POSITIVE);
        let (b, a) = (share, R::ONE - share);
        let (sixth, three) = (R::from_f64(1.0 / 6.0) * h, R::from_f64(3.0));
        let [q_0, q_1] = [k, k + 1].map(|k| self.value(k));
        let [m_0, m_1] = [k, k + 1].map(|k| self.moment(k));
        let value = |j: usize| [entry(&q_0, j), entry(&q_1, j), entry(&m_0, j), entry(&m_1, j)];
        PathPoint {
            q: core::array::from_fn(|j| {
                let [q_0, q_1, m_0, m_1] = value(j);
                let cubic = (a * a * a - a) * m_0 + (b * b * b - b) * m_1;
                a * q_0 + b * q_1 + sixth * h * cubic
            }),
            slope: core::array::from_fn(|j| {
                let [q_0, q_1, m_0, m_1] = value(j);
                let square = (three * b * b - R::ONE) * m_1 - (three * a * a - R::ONE) * m_0;
                length * ((q_1 - q_0) / (h + R::MIN_POSITIVE) + sixth * square)
            }),
            curvature: core::array::from_fn(|j| {
                let [_, _, m_0, m_1] = value(j);
                length * length * (a * m_0 + b * m_1)
            }),
        }
    }

    /// Points at all knots, with the same number of segments between them or one more, if there are
    /// as many segments as spans.
    fn grid_point(&self, point: usize, segments: usize) -> R {
        let spans = self.count.saturating_sub(1);
        let uniform = || real::<R>(point as u32) / real(segments as u32);
        if point >= segments {
            return R::ONE;
        }
        // None only with fewer segments than spans.
        place(point, segments, spans).map_or_else(uniform, |(k, index, parts)| {
            let part = real::<R>(index) / real(parts);
            (entry(&self.knots, k) + part * self.step(k)) / self.length()
        })
    }
}

/// The span of a grid's point, its index within the span, and the segments there.
fn place(point: usize, segments: usize, spans: usize) -> Option<(usize, u32, u32)> {
    let (each, more) = (segments.checked_div(spans)?, segments.checked_rem(spans)?);
    let long = more * (each + 1);
    let (first, index, parts) = match point.checked_sub(long) {
        Some(index) => (more, index, each),
        None => (0, point, each + 1),
    };
    let (span, index) =
        (index.checked_div(each)?.min(index.checked_div(parts)?), index.checked_rem(parts)?);
    Some((first + span, index as u32, parts as u32))
}

fn square_distance<R: Real, const V: usize>(from: &[R; V], to: &[R; V], spacing: &[R; V]) -> R {
    let joints = from.iter().zip(to).zip(spacing);
    joints.fold(R::ZERO, |sum, ((&from, &to), &spacing)| {
        let steps = (to - from) / spacing;
        sum + steps * steps
    })
}
