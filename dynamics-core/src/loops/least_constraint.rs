//! The motion of least constraint, from the factors M = Lᵀ D L.
//!
//! In coordinates L q̈ the kinetic energy is ½ (L q̈)ᵀ D (L q̈), and the motion that loops allow is
//! the one nearest to that without loops (Gauss's principle of least constraint): a problem of
//! least squares in the free coordinates of K, with the weights D. Its columns are made orthogonal,
//! which keeps twice the digits of Gᵀ M G. Golub & Van Loan, *Matrix Computations*, sections 5.2
//! and 6.1.

use heapless::Vec;

use super::elimination::{dot, subtract};
use crate::model::{BASE, RobotModel};
use crate::scalar::Real;
use crate::state::entry;

/// Roundings of a column's length: one that is no longer, once made orthogonal, depends on those
/// before it.
const ROUNDINGS: f64 = 16.0;

/// L and D.
pub(super) struct Metric<'a, R, const V: usize> {
    /// L below the diagonal, D on it.
    factors: &'a [[R; V]; V],
    lambda: &'a [usize; V],
    d: [R; V],
}

impl<'a, R: Real, const V: usize> Metric<'a, R, V> {
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of<D, const B: usize, const Q: usize>(
        robot: &'a D,
        factors: &'a [[R; V]; V],
    ) -> Self
    where
        D: RobotModel<R, B, Q, V>,
    {
        Self {
            factors,
            lambda: &robot.model().lambda,
            d: core::array::from_fn(|i| factors.get(i).map_or(R::ZERO, |row| entry(row, i))),
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn parent(&self, i: usize) -> usize {
        parent_of(self.lambda, i)
    }

    /// L⁻ᵀ τ. V² flops on a chain, less on a tree. RBDA (2008), table 6.5.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of_torque(&self, tau: &[R; V]) -> [R; V] {
        let mut x = *tau;
        for (i, row) in self.factors.iter().enumerate().rev() {
            let (ancestors, at) = x.split_at_mut(i);
            let x_i = at.first().copied().unwrap_or_default();
            let mut j = self.parent(i);
            while let (Some(x_j), Some(&l)) = (ancestors.get_mut(j), row.get(j)) {
                *x_j -= l * x_i;
                j = self.parent(j);
            }
        }
        x
    }

    /// L q̈. V² flops on a chain, less on a tree.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of_acceleration(&self, qdd: &[R; V]) -> [R; V] {
        let mut x = *qdd;
        for (i, (row, x)) in self.factors.iter().zip(&mut x).enumerate() {
            let mut j = self.parent(i);
            while let (Some(&x_j), Some(&l)) = (qdd.get(j), row.get(j)) {
                *x += l * x_j;
                j = self.parent(j);
            }
        }
        x
    }

    /// Lᵀ x. V² flops on a chain, less on a tree.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn to_torque(&self, x: &[R; V]) -> [R; V] {
        let mut tau = *x;
        for (i, (row, &x_i)) in self.factors.iter().zip(x).enumerate() {
            let mut j = self.parent(i);
            while let (Some(tau_j), Some(&l)) = (tau.get_mut(j), row.get(j)) {
                *tau_j += l * x_i;
                j = self.parent(j);
            }
        }
        tau
    }

    /// D x
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn weigh(&self, mut x: [R; V]) -> [R; V] {
        for (x, &d) in x.iter_mut().zip(&self.d) {
            *x *= d;
        }
        x
    }
}

/// The motions that loops allow, made orthogonal by the weights D in coordinates L q̈.
pub(super) struct Orthogonal<R, const V: usize> {
    motions: Vec<Motion<R, V>, V>,
}

struct Motion<R, const V: usize> {
    qdd: [R; V],
    /// q = L q̈, and D q.
    q: [R; V],
    weighed: [R; V],
    /// 1 / qᵀ D q; zero for a motion that depends on those before it.
    inverse: R,
}

impl<R: Real, const V: usize> Orthogonal<R, V> {
    /// No motions, to be filled where it stands: it is large.
    #[cfg_attr(optimised, inline(always))]
    pub(super) const fn blank() -> Self {
        Self { motions: Vec::new() }
    }

    /// By the modified method of Gram and Schmidt, twice for each motion.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set(&mut self, metric: &Metric<'_, R, V>, motions: impl Iterator<Item = [R; V]>) {
        let least = R::EPSILON * R::from_f64(ROUNDINGS);
        for mut qdd in motions {
            let mut q = metric.of_acceleration(&qdd);
            let size = dot(&q, &metric.weigh(q)) * (least * least);
            let mut along = [R::ZERO; V];
            for _ in 0..2 {
                for (before, along) in self.motions.iter().zip(&mut along) {
                    let rest = dot(&before.weighed, &q) * before.inverse;
                    subtract(&mut q, rest, &before.q);
                    *along += rest;
                }
            }
            for (before, along) in self.motions.iter().zip(along) {
                subtract(&mut qdd, along, &before.qdd);
            }
            let weighed = metric.weigh(q);
            let squared = dot(&q, &weighed);
            let inverse =
                if squared > size && squared > R::ZERO { R::ONE / squared } else { R::ZERO };
            let motion = Motion { qdd, q, weighed, inverse };
            let _ = self.motions.push(motion);
        }
    }

    /// Adds to q̈ the motion that takes L q̈ nearest to a goal at the distance z, given as D z.
    /// Leaves of it what no motion reaches.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn approach(&self, weighed: &mut [R; V], qdd: &mut [R; V]) {
        for motion in &self.motions {
            let along = dot(&motion.q, weighed) * motion.inverse;
            subtract(weighed, along, &motion.weighed);
            subtract(qdd, -along, &motion.qdd);
        }
    }
}

#[cfg_attr(optimised, inline(always))]
fn parent_of<const V: usize>(lambda: &[usize; V], i: usize) -> usize {
    lambda.get(i).copied().unwrap_or(BASE)
}
