//! A root of M, from its factors: M = Lᵀ D L = (D^½ L)ᵀ (D^½ L).
//!
//! In coordinates z = D^½ L q̈ the kinetic energy is ½ z·z, and constraints that are orthogonal there do not react on
//! each other (Gauss's principle of least constraint). Rows of the constraints are made orthogonal there, which keeps
//! twice the digits of K M⁻¹ Kᵀ. Golub & Van Loan, *Matrix Computations*, section 5.2.

use super::elimination::{dot, subtract};
use crate::algorithms::Ltdl;
use crate::model::{BASE, RobotModel};
use crate::scalar::Real;
use crate::state::entry;

/// Roundings of a row's length: one that is no longer, once made orthogonal, depends on those before it.
const ROUNDINGS: f64 = 16.0;

/// D^½ L.
pub(super) struct MassRoot<'a, R, const V: usize> {
    factors: &'a Ltdl<R, V>,
    lambda: &'a [usize; V],
    /// D^-½.
    root_inv: [R; V],
}

impl<'a, R: Real, const V: usize> MassRoot<'a, R, V> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of<D, const B: usize, const Q: usize>(
        robot: &'a D,
        factors: &'a Ltdl<R, V>,
    ) -> Self
    where
        D: RobotModel<R, B, Q, V>,
    {
        Self {
            factors,
            lambda: &robot.model().lambda,
            root_inv: factors.d_inv().map(|d_inv| d_inv * d_inv.rsqrt()),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parent(&self, i: usize) -> usize {
        self.lambda.get(i).copied().unwrap_or(BASE)
    }

    /// D^-½ L⁻ᵀ τ. 2 V² flops on a chain, less on a tree. RBDA (2008), table 6.5.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_torque(&self, tau: &[R; V]) -> [R; V] {
        let mut x = *tau;
        for i in (0..V).rev() {
            let (ancestors, at) = x.split_at_mut(i);
            let x_i = at.first().copied().unwrap_or_default();
            let mut j = self.parent(i);
            while let Some(x_j) = ancestors.get_mut(j) {
                *x_j -= self.factors.get(i, j) * x_i;
                j = self.parent(j);
            }
        }
        for (x, &root_inv) in x.iter_mut().zip(&self.root_inv) {
            *x *= root_inv;
        }
        x
    }

    /// L⁻¹ D^-½ z: an acceleration. 2 V² flops on a chain, less on a tree.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn acceleration(&self, z: &[R; V]) -> [R; V] {
        let mut x = *z;
        for i in 0..V {
            let (ancestors, at) = x.split_at_mut(i);
            let Some(x_i) = at.first_mut() else {
                break;
            };
            *x_i *= entry(&self.root_inv, i);
            let mut j = self.parent(i);
            while let Some(&x_j) = ancestors.get(j) {
                *x_i -= self.factors.get(i, j) * x_j;
                j = self.parent(j);
            }
        }
        x
    }
}

/// W = R Q: R lower triangular, the rows of Q orthonormal, or zero where a row of W depends on those before it.
pub(super) struct Orthogonal<R, const V: usize, const C: usize> {
    q: [[R; V]; C],
    r: [[R; C]; C],
    /// The reciprocals of R's diagonal; zero for rows that depend on others.
    r_inv: [R; C],
}

impl<R: Real, const V: usize, const C: usize> Orthogonal<R, V, C> {
    /// By the modified method of Gram and Schmidt, twice for each row. A row that is zero is left out.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(rows: [[R; V]; C]) -> Self {
        let (mut q, mut r, mut r_inv) = (rows, [[R::ZERO; C]; C], [R::ZERO; C]);
        for (j, (coefficients, r_inv)) in r.iter_mut().zip(&mut r_inv).enumerate() {
            let (before, at) = q.split_at_mut(j);
            let Some(row) = at.first_mut() else {
                break;
            };
            let least = R::EPSILON * R::from_f64(ROUNDINGS);
            let least = dot(row, row) * (least * least);
            for _ in 0..2 {
                for (before, coefficient) in before.iter().zip(&mut *coefficients) {
                    let along = dot(before, row);
                    subtract(row, along, before);
                    *coefficient += along;
                }
            }
            let squared = dot(row, row);
            if squared > least && squared > R::ZERO {
                *r_inv = squared.rsqrt();
                *row = row.map(|x| x * *r_inv);
            } else {
                *row = [R::ZERO; V];
            }
        }
        Self { q, r, r_inv }
    }

    /// Whether a row is independent of those before it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn has(&self, row: usize) -> bool {
        entry(&self.r_inv, row) != R::ZERO
    }

    /// The z nearest to `free` with W z = `right`, and the λ with z = `free` + Wᵀ λ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn nearest(&self, free: &[R; V], right: &[R; C]) -> ([R; V], [R; C]) {
        let (mut along, mut z) = ([R::ZERO; C], *free);
        for (i, (row, &r_inv)) in self.r.iter().zip(&self.r_inv).enumerate() {
            let known = dot(row, &along);
            if let Some(along) = along.get_mut(i) {
                *along = (entry(right, i) - known) * r_inv;
            }
        }
        let mut lambda = [R::ZERO; C];
        for ((row, &along), change) in self.q.iter().zip(&along).zip(&mut lambda) {
            *change = along - dot(row, free);
            subtract(&mut z, -*change, row);
        }
        for (i, (row, &r_inv)) in self.r.iter().zip(&self.r_inv).enumerate().rev() {
            let (before, at) = lambda.split_at_mut(i);
            let Some(own) = at.first_mut() else {
                break;
            };
            *own *= r_inv;
            for (before, &coefficient) in before.iter_mut().zip(row) {
                *before -= coefficient * *own;
            }
        }
        (z, lambda)
    }
}
