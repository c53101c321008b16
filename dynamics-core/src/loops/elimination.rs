//! Elimination of K with complete pivoting: its rank, the rows and coordinates that depend on others.
//!
//! Golub & Van Loan, *Matrix Computations*, section 3.4. Rows are compared relative to the sizes of their loops, so
//! that neither the unit of length nor rounding errors of a direction in which nothing moves decide.

use crate::math::const_eval as m;
use crate::scalar::Real;
use crate::state::entry;

/// The pivot, relative to the size of a loop, below which a row of K depends on those before it, in f64 and in f32.
///
/// Of the order of the root of the rounding error: a pivot p multiplies rounding errors by 1/p, and where the product
/// exceeds p itself, the rank is that of the rounding errors. Closer than this to a singular configuration, in rad, a
/// machine is treated as singular.
pub const RANK_TOLERANCE: (f64, f32) = (1e-7, 2e-3);

/// The distance ς from a singular configuration of the motors below which the passive coordinates are damped, by
/// default; see [`Loops::damped_below`](super::Loops::damped_below).
pub const SINGULAR: f64 = 5e-3;

/// ε in f64 and f32: a given threshold, and at least that below which elimination may leave a passive coordinate
/// without a pivot. With complete pivoting C rows of p columns have no pivot that is less than their least singular
/// value over √(C − p + 1).
pub(super) const fn thresholds(given: f64, rows: usize, passive: usize) -> (f64, f32) {
    let root = m::sqrt((rows.saturating_sub(passive) + 1) as f64);
    let (double, single) = (root * RANK_TOLERANCE.0, root as f32 * RANK_TOLERANCE.1);
    (given.max(double), (given as f32).max(single))
}

/// No row, or no column.
pub(super) const NONE: usize = usize::MAX;

/// Which of C rows are independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopRows<const C: usize> {
    independent: [bool; C],
}

impl<const C: usize> LoopRows<C> {
    /// The rank of K.
    pub fn rank(&self) -> usize {
        self.independent.iter().filter(|row| **row).count()
    }

    /// The rows that depend on others, as indices of K's.
    pub fn redundant(&self) -> impl Iterator<Item = usize> {
        let rows = self.independent.iter().enumerate();
        rows.filter_map(|(row, independent)| (!independent).then_some(row))
    }

    /// Also leaves out independent rows that differ from a combination of others by no more than rounding errors.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn keep(&mut self, keeps: impl Fn(usize) -> bool) {
        for (row, independent) in self.independent.iter_mut().enumerate() {
            *independent &= keeps(row);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn has(&self, row: usize) -> bool {
        entry(&self.independent, row)
    }
}

/// T K = K', with a unit column for each pivot, and zero but for rounding in the rows without one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Elimination<R, const V: usize, const C: usize> {
    /// K'.
    pub(super) rows: [[R; V]; C],
    /// T.
    pub(super) transform: [[R; C]; C],
    /// The column of each row's pivot.
    pub(super) column_of: [usize; C],
    /// The row of each column's pivot.
    pub(super) row_of: [usize; V],
}

/// The elimination of `rows`, pivots in the coordinates `first` before those in others.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn eliminate<R: Real, const V: usize, const C: usize>(
    rows: [[R; V]; C],
    first: &[bool; V],
) -> Elimination<R, V, C> {
    let mut done = Elimination {
        rows,
        transform: [[R::ZERO; C]; C],
        column_of: [NONE; C],
        row_of: [NONE; V],
    };
    for (i, row) in done.transform.iter_mut().enumerate() {
        row[i] = R::ONE;
    }
    for stage in [true, false] {
        for _ in 0..C {
            let Some((row, column)) = done.largest(|column| entry(first, column) == stage) else {
                break;
            };
            done.pivot(row, column);
        }
    }
    done
}

impl<R: Real, const V: usize, const C: usize> Elimination<R, V, C> {
    /// The largest entry of the rows and columns without a pivot.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn largest(&self, allowed: impl Fn(usize) -> bool) -> Option<(usize, usize)> {
        let (mut largest, mut place) = (R::select(RANK_TOLERANCE.0, RANK_TOLERANCE.1), None);
        for (i, row) in self.rows.iter().enumerate() {
            if entry(&self.column_of, i) != NONE {
                continue;
            }
            for (j, entry_ij) in row.iter().enumerate() {
                let free = entry(&self.row_of, j) == NONE && allowed(j);
                if free && entry_ij.abs() > largest {
                    (largest, place) = (entry_ij.abs(), Some((i, j)));
                }
            }
        }
        place
    }

    /// Makes a column a unit column.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pivot(&mut self, row: usize, column: usize) {
        let (Some(&pivot_row), Some(&pivot_transform)) =
            (self.rows.get(row), self.transform.get(row))
        else {
            return;
        };
        let reciprocal = R::ONE / entry(&pivot_row, column);
        let pivot_row = pivot_row.map(|x| x * reciprocal);
        let pivot_transform = pivot_transform.map(|x| x * reciprocal);
        let both = self.rows.iter_mut().zip(&mut self.transform);
        for (i, (other, transform)) in both.enumerate() {
            let factor = entry(other, column);
            if i == row {
                (*other, *transform) = (pivot_row, pivot_transform);
            } else {
                subtract(other, factor, &pivot_row);
                subtract(transform, factor, &pivot_transform);
            }
            if let Some(unit) = other.get_mut(column) {
                *unit = if i == row { R::ONE } else { R::ZERO };
            }
        }
        if let (Some(of_row), Some(of_column)) =
            (self.column_of.get_mut(row), self.row_of.get_mut(column))
        {
            (*of_row, *of_column) = (column, row);
        }
    }

    /// Which rows have a pivot.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn loop_rows(&self) -> LoopRows<C> {
        LoopRows {
            independent: self.column_of.map(|column| column != NONE),
        }
    }

    /// The coordinates without a pivot, which the others depend on.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn free(&self) -> impl Iterator<Item = usize> {
        let columns = self.row_of.iter().enumerate();
        columns.filter_map(|(column, &row)| (row == NONE).then_some(column))
    }

    /// The row of the pivot of a column.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn row_of(&self, column: usize) -> Option<&[R; V]> {
        self.rows.get(entry(&self.row_of, column))
    }

    /// x with K x = `right`, of given free coordinates; `right` over the sizes of the loops, as the rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn complete(&self, free: [R; V], right: &[R; C]) -> [R; V] {
        let mut x = free;
        for ((row, transform), &column) in
            self.rows.iter().zip(&self.transform).zip(&self.column_of)
        {
            if let Some(x) = x.get_mut(column) {
                *x = dot(transform, right) - self.of_free(row, &free);
            }
        }
        x
    }

    /// Entry `free` of Gᵀ τ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn transposed(&self, free: usize, tau: &[R; V]) -> R {
        let mut sum = entry(tau, free);
        for (row, &column) in self.rows.iter().zip(&self.column_of) {
            if column != NONE {
                sum -= entry(row, free) * entry(tau, column);
            }
        }
        sum
    }

    /// λ of rows over the sizes of the loops, with Kᵀ λ = `torque` in the coordinates with a pivot.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn lambda(&self, torque: &[R; V]) -> [R; C] {
        let mut lambda = [R::ZERO; C];
        for (transform, &column) in self.transform.iter().zip(&self.column_of) {
            if column != NONE {
                subtract(&mut lambda, -entry(torque, column), transform);
            }
        }
        lambda
    }

    /// The sum of a row's entries in free columns, times x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_free(&self, row: &[R; V], x: &[R; V]) -> R {
        let mut sum = R::ZERO;
        for ((&entry, &x), &pivot) in row.iter().zip(x).zip(&self.row_of) {
            if pivot == NONE {
                sum += entry * x;
            }
        }
        sum
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let products = a.iter().zip(b).map(|(&a, &b)| a * b);
    products.fold(R::ZERO, |sum, product| sum + product)
}

/// a −= factor b.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn subtract<R: Real, const N: usize>(a: &mut [R; N], factor: R, b: &[R; N]) {
    for (a, &b) in a.iter_mut().zip(b) {
        *a -= factor * b;
    }
}
