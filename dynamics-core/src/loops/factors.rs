//! Solutions of forward dynamics: K x = b, and Kᵀ λ = τ in the coordinates with a pivot.
//!
//! By the factors of K, which solve with a few right-hand sides in fewer products than T of
//! [`Elimination`] takes to form; by T where pivots are not found loop by loop. Golub & Van Loan,
//! *Matrix Computations*, section 3.2.

use heapless::Vec;

use super::Constraints;
use super::description::Loops;
use super::elimination::{Elimination, LoopRows, Order, dot, subtract};
use crate::scalar::Real;
use crate::state::entry;

/// The factors of K, or T. If they are the factors, `rows` has the rows of K over their pivots,
/// without the columns of earlier pivots; `transform` has in the row of a pivot its reciprocal, and
/// how many times the row was subtracted from each row after it.
pub(super) struct Factors<'a, R, const V: usize, const C: usize> {
    k: &'a mut Elimination<R, V, C>,
    /// The right-hand side b, eliminated with the rows: x at the pivots.
    right: [R; C],
    /// The pivots; none if there is T.
    order: Order<C>,
}

impl<'a, R: Real, const V: usize, const C: usize> Factors<'a, R, V, C> {
    /// No factors yet, to be filled where they stand.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn blank(k: &'a mut Elimination<R, V, C>) -> Self {
        Self { k, right: [R::ZERO; C], order: Order::new() }
    }

    /// Factors K, and eliminates b with its rows.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<const L: usize, const A: usize>(
        &mut self,
        closing: &Constraints<R, V, L, C>,
        loops: &Loops<L, C, A>,
        right: &[R; C],
    ) {
        let (scale, all) = (closing.scale(), |_| true);
        if L > 1 && C <= V {
            self.right = *right;
            let more = (&mut self.order, &mut self.right);
            if (self.k).loop_by_loop::<true, L, A>(closing, loops, all, &scale, more) {
                return self.substitute_back();
            }
            self.order.clear();
        }
        (self.k).completely::<false, L>(closing, all, &scale);
        self.right = self.k.transform.each_ref().map(|row| dot(row, right));
    }

    /// Back substitution, from the last pivot to the first, of b and of the columns without a
    /// pivot.
    #[cfg_attr(optimised, inline(always))]
    fn substitute_back(&mut self) {
        let mut order: &[(usize, usize)] = &self.order;
        while let Some((&(row, column), before)) = order.split_last() {
            order = before;
            let Some(pivot_row) = self.k.rows.get(row) else {
                break;
            };
            let mut of_free: Vec<(usize, R), V> = Vec::new();
            for free in self.k.free() {
                let _ = of_free.push((free, entry(pivot_row, free)));
            }
            let right = entry(&self.right, row);
            for &(i, _) in before {
                let (Some(other), Some(of_other)) = (self.k.rows.get_mut(i), self.right.get_mut(i))
                else {
                    continue;
                };
                let factor = entry(other, column);
                if factor != R::ZERO {
                    *of_other -= factor * right;
                    for &(free, x) in &of_free {
                        if let Some(other) = other.get_mut(free) {
                            *other -= factor * x;
                        }
                    }
                }
            }
        }
    }

    /// Which rows of K have a pivot.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn loop_rows(&self) -> LoopRows<C> {
        self.k.loop_rows()
    }

    /// The coordinates without a pivot, which the others depend on.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn free(&self) -> impl DoubleEndedIterator<Item = usize> {
        self.k.free()
    }

    /// x with K x = b, of free coordinates that are zero.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn solution(&self) -> [R; V] {
        let mut x = [R::ZERO; V];
        for (&right, &column) in self.right.iter().zip(&self.k.column_of) {
            if let Some(x) = x.get_mut(column) {
                *x = right;
            }
        }
        x
    }

    /// The column of G of a free coordinate: the motion of all at its unit rate.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn motion(&self, free: usize) -> [R; V] {
        let mut x = [R::ZERO; V];
        for (row, &column) in self.k.rows.iter().zip(&self.k.column_of) {
            if let Some(x) = x.get_mut(column) {
                *x = -entry(row, free);
            }
        }
        if let Some(x) = x.get_mut(free) {
            *x = R::ONE;
        }
        x
    }

    /// λ with Kᵀ λ = `torque` in the coordinates with a pivot.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn force(&self, mut torque: [R; V]) -> [R; C] {
        if self.order.is_empty() {
            return self.k.lambda(&torque);
        }
        let mut lambda = [R::ZERO; C];
        for &(row, column) in &self.order {
            if let (Some(of_row), Some(lambda)) = (self.k.rows.get(row), lambda.get_mut(row)) {
                *lambda = entry(&torque, column);
                subtract(&mut torque, *lambda, of_row);
            }
        }
        for &(row, _) in self.order.iter().rev() {
            if let (Some(multiples), Some(own)) = (self.k.transform.get(row), lambda.get_mut(row)) {
                let torque = core::mem::take(own);
                let own = (torque - dot(multiples, &lambda)) * entry(multiples, row);
                if let Some(lambda) = lambda.get_mut(row) {
                    *lambda = own;
                }
            }
        }
        lambda
    }
}
