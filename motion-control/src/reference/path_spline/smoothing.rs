//! The system of the second derivatives at the knots, factored as L D Lᵀ.

use super::PathSpline;
use crate::entry;
use dynamics_core::scalar::Real;

/// A row of T + λ Qᵀ W Q from its diagonal to the right, and of its factors: D, and two entries of
/// a column of L.
#[derive(Clone, Copy, Debug)]
pub(super) struct Smoothing<R>([R; 3]);

impl<R: Real, const V: usize, const N: usize> PathSpline<R, V, N> {
    /// The moments of the spline with this λ near the points.
    pub(super) fn solve(&mut self, points: &[[R; V]], lambda: R) {
        let last = self.count.saturating_sub(1);
        let mut factors = [Smoothing([R::ONE, R::ZERO, R::ZERO]); N];
        let (mut one, mut two) = (Smoothing::UNIT, Smoothing::UNIT);
        let (mut z_1, mut z_2) = ([R::ZERO; V], [R::ZERO; V]);
        for (k, place) in factors.iter_mut().enumerate().take(last).skip(1) {
            let Smoothing([row, right, far]) = self.row(k, lambda);
            let (Smoothing([d_1, l_1, m_1]), Smoothing([d_2, _, m_2])) = (one, two);
            let d = row - d_1 * l_1 * l_1 - d_2 * m_2 * m_2;
            let l = (right - d_1 * l_1 * m_1) / d;
            let bend = self.bend(points, k);
            let z = core::array::from_fn(|j| {
                entry(&bend, j) - l_1 * entry(&z_1, j) - m_2 * entry(&z_2, j)
            });
            if let Some(moment) = self.moments.get_mut(k) {
                *moment = z;
            }
            (two, one) = (one, Smoothing([d, l, far / d]));
            (z_2, z_1) = (z_1, z);
            *place = one;
        }
        let (mut x_1, mut x_2) = ([R::ZERO; V], [R::ZERO; V]);
        for (k, Smoothing([d, l, m])) in factors.iter().enumerate().take(last).skip(1).rev() {
            let z = self.moment(k);
            let x = core::array::from_fn(|j| {
                entry(&z, j) / *d - *l * entry(&x_1, j) - *m * entry(&x_2, j)
            });
            if let Some(moment) = self.moments.get_mut(k) {
                *moment = x;
            }
            (x_2, x_1) = (x_1, x);
        }
    }

    /// The values of the spline: the points, moved by what they are off.
    pub(super) fn shift(&mut self, points: &[[R; V]], lambda: R) {
        for (k, point) in points.iter().enumerate() {
            let off = self.off(k, lambda);
            if let Some(value) = self.values.get_mut(k) {
                *value = core::array::from_fn(|j| entry(point, j) - entry(&off, j));
            }
        }
    }

    /// λ W Q γ: the distance of the spline from a way-point.
    pub(super) fn off(&self, k: usize, lambda: R) -> [R; V] {
        let [before, here, after] = [k.wrapping_sub(1), k, k + 1].map(|k| self.moment(k));
        let scale = lambda * self.weight(k);
        let [before_inv, after_inv] = self.inverse_steps(k);
        core::array::from_fn(|j| {
            let here = entry(&here, j);
            let bend =
                (entry(&before, j) - here) * before_inv + (entry(&after, j) - here) * after_inv;
            scale * bend
        })
    }

    /// Qᵀ y: the change of slope of the polygon at a way-point.
    fn bend(&self, points: &[[R; V]], k: usize) -> [R; V] {
        let point = |k: usize| points.get(k).copied().unwrap_or([R::ZERO; V]);
        let (before, here, after) = (point(k - 1), point(k), point(k + 1));
        let [before_inv, after_inv] = self.inverse_steps(k);
        core::array::from_fn(|j| {
            let here = entry(&here, j);
            (entry(&before, j) - here) * before_inv + (entry(&after, j) - here) * after_inv
        })
    }

    /// A row of T + λ Qᵀ W Q at an inner knot.
    fn row(&self, k: usize, lambda: R) -> Smoothing<R> {
        let [p, n] = self.inverse_steps(k);
        let [p_1, n_1] = self.inverse_steps(k + 1);
        let (m, m_1) = (-(p + n), -(p_1 + n_1));
        let [w_0, w, w_1] = [k - 1, k, k + 1].map(|k| self.weight(k));
        let inner = |k: usize| if k + 1 < self.count { R::ONE } else { R::ZERO };
        let (before, after) = (self.step(k - 1), self.step(k));
        Smoothing([
            (before + after) * R::from_f64(1.0 / 3.0)
                + lambda * (w_0 * p * p + w * m * m + w_1 * n * n),
            inner(k + 1) * (after * R::from_f64(1.0 / 6.0) + lambda * (w * m * n + w_1 * n * m_1)),
            inner(k + 2) * (lambda * w_1 * n * n_1),
        ])
    }

    /// 1/h before and after a knot; zero where there is none.
    fn inverse_steps(&self, k: usize) -> [R; 2] {
        [k.wrapping_sub(1), k].map(|k| {
            let h = self.step(k);
            if h > R::ZERO { R::ONE / h } else { R::ZERO }
        })
    }

    /// 1 at inner knots.
    fn weight(&self, k: usize) -> R {
        let inner = (k > 0) & (k + 1 < self.count);
        if inner { R::ONE } else { R::ZERO }
    }

    /// h from a knot to the next one; zero if there is none.
    pub(super) fn step(&self, k: usize) -> R {
        if k < self.count.saturating_sub(1) {
            entry(&self.knots, k + 1) - entry(&self.knots, k)
        } else {
            R::ZERO
        }
    }

    pub(super) fn value(&self, k: usize) -> [R; V] {
        self.values.get(k).copied().unwrap_or([R::ZERO; V])
    }

    pub(super) fn moment(&self, k: usize) -> [R; V] {
        self.moments.get(k).copied().unwrap_or([R::ZERO; V])
    }
}

impl<R: Real> Smoothing<R> {
    /// A row without neighbours.
    const UNIT: Self = Self([R::ONE, R::ZERO, R::ZERO]);
}
