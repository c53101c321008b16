//! The motion of least constraint, from the factors M = Lᵀ D L.
//!
//! In coordinates L q̈ the kinetic energy is ½ (L q̈)ᵀ D (L q̈), and the motion that loops allow is the one nearest to that
//! without loops (Gauss's principle of least constraint): a problem of least squares in the free coordinates of K, with
//! the weights D. Its columns are made orthogonal, which keeps twice the digits of Gᵀ M G. Golub & Van Loan, *Matrix
//! Computations*, sections 5.2 and 6.1.

use heapless::Vec;

use super::elimination::{dot, subtract};
use crate::algorithms::{Ltdl, MassMatrix};
use crate::model::{BASE, RobotModel};
use crate::scalar::Real;
use crate::state::entry;

/// Roundings of a column's length: one that is no longer, once made orthogonal, depends on those before it.
const ROUNDINGS: f64 = 16.0;

/// L and D.
pub(super) struct Metric<'a, R, const V: usize> {
    factors: &'a Ltdl<R, V>,
    lambda: &'a [usize; V],
    d: [R; V],
}

impl<'a, R: Real, const V: usize> Metric<'a, R, V> {
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
            d: factors.d_inv().map(|d_inv| R::ONE / d_inv),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parent(&self, i: usize) -> usize {
        parent_of(self.lambda, i)
    }

    /// L⁻ᵀ τ. V² flops on a chain, less on a tree. RBDA (2008), table 6.5.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_torque(&self, tau: &[R; V]) -> [R; V] {
        let mut x = *tau;
        for (i, row) in self.factors.rows.iter().enumerate().rev() {
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
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_acceleration(&self, qdd: &[R; V]) -> [R; V] {
        let mut x = *qdd;
        for (i, (row, x)) in self.factors.rows.iter().zip(&mut x).enumerate() {
            let mut j = self.parent(i);
            while let (Some(&x_j), Some(&l)) = (qdd.get(j), row.get(j)) {
                *x += l * x_j;
                j = self.parent(j);
            }
        }
        x
    }

    /// D x
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn weigh(&self, mut x: [R; V]) -> [R; V] {
        for (x, &d) in x.iter_mut().zip(&self.d) {
            *x *= d;
        }
        x
    }
}

/// W = Q R by columns: those of Q orthogonal by the weights D, or zero where one of W depends on those before it; R
/// upper triangular, with ones on its diagonal.
pub(super) struct Orthogonal<R, const V: usize> {
    columns: Vec<Column<R, V>, V>,
}

struct Column<R, const V: usize> {
    q: [R; V],
    /// D q.
    weighed: [R; V],
    /// R above its diagonal.
    r: [R; V],
    /// 1 / qᵀ D q; zero for a column that depends on others.
    inverse: R,
}

impl<R: Real, const V: usize> Orthogonal<R, V> {
    /// No columns, to be filled where it stands: it is large.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) const fn blank() -> Self {
        Self {
            columns: Vec::new(),
        }
    }

    /// The columns of W, by the modified method of Gram and Schmidt, twice for each column.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn set(&mut self, metric: &Metric<'_, R, V>, columns: impl Iterator<Item = [R; V]>) {
        let least = R::EPSILON * R::from_f64(ROUNDINGS);
        for mut q in columns {
            let mut r = [R::ZERO; V];
            let size = dot(&q, &metric.weigh(q)) * (least * least);
            for _ in 0..2 {
                for (before, r) in self.columns.iter().zip(&mut r) {
                    let along = dot(&before.weighed, &q) * before.inverse;
                    subtract(&mut q, along, &before.q);
                    *r += along;
                }
            }
            let weighed = metric.weigh(q);
            let squared = dot(&q, &weighed);
            let inverse = if squared > size && squared > R::ZERO {
                R::ONE / squared
            } else {
                R::ZERO
            };
            let column = Column {
                q,
                weighed,
                r,
                inverse,
            };
            let _ = self.columns.push(column);
        }
    }

    /// The x with the least distance of W x from z, given as D z: an entry for each column.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn nearest(&self, mut weighed: [R; V]) -> [R; V] {
        let mut x = [R::ZERO; V];
        for (column, x) in self.columns.iter().zip(&mut x) {
            *x = dot(&column.q, &weighed) * column.inverse;
            subtract(&mut weighed, *x, &column.weighed);
        }
        for (i, column) in self.columns.iter().enumerate().rev() {
            let Some((before, [own, ..])) = x.split_at_mut_checked(i) else {
                break;
            };
            let own = *own;
            for (before, &r) in before.iter_mut().zip(&column.r) {
                *before -= r * own;
            }
        }
        x
    }
}

/// M x − τ, of the entries of M between joints of one branch.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn reaction<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    m: &MassMatrix<R, V>,
    x: &[R; V],
    tau: &[R; V],
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
{
    let lambda = &robot.model().lambda;
    let mut reaction = [R::ZERO; V];
    for (i, (row, &x_i)) in m.rows.iter().zip(x).enumerate() {
        let mut sum = entry(row, i) * x_i;
        let mut j = parent_of(lambda, i);
        while let (Some(sum_j), Some(&x_j), Some(&m_ij)) =
            (reaction.get_mut(j), x.get(j), row.get(j))
        {
            *sum_j += m_ij * x_i;
            sum += m_ij * x_j;
            j = parent_of(lambda, j);
        }
        if let Some(sum_i) = reaction.get_mut(i) {
            *sum_i = sum;
        }
    }
    subtract(&mut reaction, R::ONE, tau);
    reaction
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn parent_of<const V: usize>(lambda: &[usize; V], i: usize) -> usize {
    lambda.get(i).copied().unwrap_or(BASE)
}
