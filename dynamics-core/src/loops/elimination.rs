//! Elimination of K with complete pivoting: its rank, the rows and coordinates that depend on
//! others.
//!
//! Golub & Van Loan, *Matrix Computations*, section 3.4. Rows are compared relative to the sizes of
//! their loops, so that neither the unit of length nor rounding errors of a direction in which
//! nothing moves decide.
//!
//! If several loops share coordinates, those that move one loop only come first, while their
//! pivots are large: their columns are zero in the rows of all other loops, and so is the transform
//! of a loop's rows. Duff, Erisman & Reid, *Direct Methods for Sparse Matrices* (1986), chapter 7.

use core::ops::Range;

use heapless::Vec;

use super::Constraints;
use super::description::{Loops, NONE};
use super::thresholds::{RANK_TOLERANCE, SINGULAR};
use crate::scalar::Real;
use crate::state::entry;

/// The least pivot, relative to the size of a loop, of a coordinate that moves this loop only.
const LARGE: f64 = 0.0625;

/// The least pivot, relative to the size of a loop, with which the order of the pivots does not
/// matter: some times the threshold of the rank in f32.
const REGULAR: f64 = 3.0 * SINGULAR;

/// Rows and columns of pivots, in the order in which they were found.
pub(super) type Order<const C: usize> = Vec<(usize, usize), C>;

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
}

/// T K = K', with a unit column for each pivot, and zero but for rounding in the rows without one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Elimination<R, const V: usize, const C: usize> {
    /// K', of which nothing but the columns without a pivot is read.
    pub(super) rows: [[R; V]; C],
    /// T.
    pub(super) transform: [[R; C]; C],
    /// The column of each row's pivot.
    pub(super) column_of: [usize; C],
    /// The row of each column's pivot.
    pub(super) row_of: [usize; V],
    /// The columns without a pivot, and how many there are.
    free: [usize; V],
    freedom: usize,
}

impl<R: Real, const V: usize, const C: usize> Elimination<R, V, C> {
    /// Nothing, to be filled where it stands: it is large.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn blank() -> Self {
        Self {
            rows: [[R::ZERO; V]; C],
            transform: [[R::ZERO; C]; C],
            column_of: [NONE; C],
            row_of: [NONE; V],
            free: [NONE; V],
            freedom: 0,
        }
    }

    /// The elimination of K, pivots in the coordinates `first` before those in others, of rows over
    /// the sizes of their loops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn eliminate<const L: usize, const A: usize>(
        &mut self,
        closing: &Constraints<R, V, L, C>,
        loops: &Loops<L, C, A>,
        first: impl Fn(usize) -> bool + Copy,
        scale: &[R; C],
    ) {
        if L > 1 && C <= V {
            for (i, (transform, &size)) in self.transform.iter_mut().zip(&closing.size).enumerate()
            {
                // T of rows as they are times the sizes is T of rows over the sizes.
                transform[i] = size;
            }
            let (mut order, mut right) = (Vec::new(), [R::ZERO; C]);
            let more = (&mut order, &mut right);
            if self.loop_by_loop::<false, L, A>(closing, loops, first, scale, more) {
                self.substitute_back(&order);
                return;
            }
        }
        self.completely::<true, L>(closing, first, scale);
    }

    /// With complete pivoting, from the start; `SCALED`: of rows over the sizes of their loops.
    /// Those of forward dynamics are not, whose digits depend on every rounding of K.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn completely<const SCALED: bool, const L: usize>(
        &mut self,
        closing: &Constraints<R, V, L, C>,
        first: impl Fn(usize) -> bool + Copy,
        scale: &[R; C],
    ) {
        let rows = self.rows.iter_mut().zip(&mut self.transform);
        let rows = rows.zip(closing.jacobian.iter().zip(scale)).enumerate();
        for (i, ((row, transform), (of_k, &scale))) in rows {
            *transform = [R::ZERO; C];
            transform[i] = R::ONE;
            for (entry, &of_k) in row.iter_mut().zip(of_k) {
                *entry = if SCALED { of_k * scale } else { of_k };
            }
        }
        (self.column_of, self.row_of) = ([NONE; C], [NONE; V]);
        let weights = if SCALED { &[R::ONE; C] } else { scale };
        for stage in [true, false] {
            let allowed = |column: usize| first(column) == stage;
            let mut left = (0..V).filter(|&column| allowed(column)).count();
            while left > 0
                && let Some((row, column)) = self.largest(allowed, weights)
            {
                self.pivot(row, column);
                left -= 1;
            }
        }
        self.find_free();
    }

    /// The largest entry of the rows without a pivot in the columns allowed. Those with a pivot are
    /// zero there.
    #[cfg_attr(optimised, inline(always))]
    fn largest(&self, allowed: impl Fn(usize) -> bool, weights: &[R; C]) -> Option<(usize, usize)> {
        let (mut largest, mut place) = (R::select(RANK_TOLERANCE.0, RANK_TOLERANCE.1), None);
        for (i, (row, &weight)) in self.rows.iter().zip(weights).enumerate() {
            if entry(&self.column_of, i) != NONE {
                continue;
            }
            for (j, entry_ij) in row.iter().enumerate() {
                let size = entry_ij.abs() * weight;
                if size > largest && allowed(j) {
                    (largest, place) = (size, Some((i, j)));
                }
            }
        }
        place
    }

    /// Makes a column a unit column.
    #[cfg_attr(optimised, inline(always))]
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

    /// Pivots in each loop's own coordinates first, listed in their order; whether every row, or
    /// every coordinate of `first`, has a pivot that is not near to singular: there complete
    /// pivoting decides. `FACTORS`: for the factors of K, with a right-hand side, in place of T.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn loop_by_loop<const FACTORS: bool, const L: usize, const A: usize>(
        &mut self,
        closing: &Constraints<R, V, L, C>,
        loops: &Loops<L, C, A>,
        first: impl Fn(usize) -> bool + Copy,
        weights: &[R; C],
        (order, right): (&mut Order<C>, &mut [R; C]),
    ) -> bool {
        self.rows = closing.jacobian;
        for i in 0..L {
            let own = |column| closing.is_own(column, i) && first(column);
            let (rows, least) = (loops.rows(i), R::from_f64(LARGE));
            self.forward::<FACTORS>(rows, own, least, weights, (order, right));
        }
        let regular = R::from_f64(REGULAR);
        self.forward::<FACTORS>(0..C, first, regular, weights, (order, right));
        if order.len() < C && order.len() >= (0..V).filter(|&column| first(column)).count() {
            self.forward::<FACTORS>(0..C, |_| true, regular, weights, (order, right));
        }
        self.find_free();
        order.len() == C
    }

    /// Pivots of more than `least` in some rows and the columns allowed, the largest first. Makes
    /// the rest of their columns zero in the rows without a pivot.
    #[cfg_attr(optimised, inline(always))]
    fn forward<const FACTORS: bool>(
        &mut self,
        rows: Range<usize>,
        allowed: impl Fn(usize) -> bool,
        least: R,
        weights: &[R; C],
        (order, right): (&mut Order<C>, &mut [R; C]),
    ) {
        if order.len() == C {
            return;
        }
        let mut columns: Vec<usize, V> = Vec::new();
        for (column, &row) in self.row_of.iter().enumerate() {
            if row == NONE && allowed(column) {
                let _ = columns.push(column);
            }
        }
        self.forward_in::<FACTORS>(rows, &mut columns, least, weights, (order, right));
    }

    /// The same in listed columns.
    #[inline(never)]
    fn forward_in<const FACTORS: bool>(
        &mut self,
        rows: Range<usize>,
        columns: &mut Vec<usize, V>,
        least: R,
        weights: &[R; C],
        (order, right): (&mut Order<C>, &mut [R; C]),
    ) {
        let mut open: Vec<usize, C> = Vec::new();
        for i in rows.clone() {
            if entry(&self.column_of, i) == NONE {
                let _ = open.push(i);
            }
        }
        loop {
            let (mut largest, mut place) = (least, None);
            for (of_row, &i) in open.iter().enumerate() {
                let (Some(row), weight) = (self.rows.get(i), entry(weights, i)) else {
                    continue;
                };
                for (of_column, &column) in columns.iter().enumerate() {
                    let size = entry(row, column).abs() * weight;
                    if size > largest {
                        (largest, place) = (size, Some((of_row, of_column)));
                    }
                }
            }
            let Some((of_row, of_column)) = place else {
                break;
            };
            let taken = (take(&mut open, of_row), take(columns, of_column));
            let (Some(row), Some(column)) = taken else {
                break;
            };
            if let (Some(of_row), Some(of_column)) =
                (self.column_of.get_mut(row), self.row_of.get_mut(column))
            {
                (*of_row, *of_column) = (column, row);
            }
            let _ = order.push((row, column));
            if FACTORS {
                self.subtract_scaled((row, column), &open, right);
            } else {
                self.subtract_row((row, column), &open, rows.clone());
            }
        }
    }

    /// Subtracts the row of a pivot from those that are open.
    #[cfg_attr(optimised, inline(always))]
    fn subtract_row(&mut self, (row, column): (usize, usize), open: &[usize], rows: Range<usize>) {
        let pivot = self.rows.get(row).map(|row| entry(row, column));
        let reciprocal = R::ONE / pivot.unwrap_or_default();
        for &i in open {
            let Ok([pivot_row, other]) = self.rows.get_disjoint_mut([row, i]) else {
                continue;
            };
            let factor = entry(other, column) * reciprocal;
            if factor != R::ZERO {
                subtract(other, factor, pivot_row);
                if let Ok([pivot, other]) = self.transform.get_disjoint_mut([row, i]) {
                    // The transform of a loop's rows is of these alone.
                    let pivot = pivot.get(rows.clone()).unwrap_or_default();
                    let other = other.get_mut(rows.clone()).unwrap_or_default();
                    for (other, &pivot) in other.iter_mut().zip(pivot) {
                        *other -= factor * pivot;
                    }
                }
            }
        }
    }

    /// Divides the row of a pivot by it, and subtracts it from those that are open, the right-hand
    /// side likewise.
    #[cfg_attr(optimised, inline(always))]
    fn subtract_scaled(
        &mut self,
        (row, column): (usize, usize),
        open: &[usize],
        right: &mut [R; C],
    ) {
        let (Some(pivot_row), Some(own), Some(multiples)) =
            (self.rows.get_mut(row), right.get_mut(row), self.transform.get_mut(row))
        else {
            return;
        };
        let reciprocal = R::ONE / entry(pivot_row, column);
        let scaled = pivot_row.map(|x| x * reciprocal);
        *pivot_row = scaled;
        *own *= reciprocal;
        let own = *own;
        if let Some(kept) = multiples.get_mut(row) {
            *kept = reciprocal;
        }
        for &i in open {
            let (Some(other), Some(right), Some(kept)) =
                (self.rows.get_mut(i), right.get_mut(i), multiples.get_mut(i))
            else {
                continue;
            };
            let factor = entry(other, column);
            if factor != R::ZERO {
                subtract(other, factor, &scaled);
                *right -= factor * own;
                *kept = factor;
            }
        }
    }

    /// T, and unit columns for the pivots, from the last pivot to the first.
    #[cfg_attr(optimised, inline(always))]
    fn substitute_back(&mut self, order: &[(usize, usize)]) {
        let free = self.free.get(..self.freedom).unwrap_or_default();
        let mut earlier = order;
        while let Some((&(row, column), before)) = earlier.split_last() {
            let later = order.get(earlier.len()..).unwrap_or_default();
            earlier = before;
            let Some(own) = self.rows.get(row) else {
                break;
            };
            let reciprocal = R::ONE / entry(own, column);
            // Sums of their own stay in registers.
            let (mut sums, mut of_free) = ([R::ZERO; C], Vec::<R, V>::new());
            for &free in free {
                let _ = of_free.push(entry(own, free));
            }
            for &(other, column) in later {
                let factor = entry(own, column);
                if let (true, Some(of_other), Some(transform)) =
                    (factor != R::ZERO, self.rows.get(other), self.transform.get(other))
                {
                    subtract(&mut sums, factor, transform);
                    for (x, &free) in of_free.iter_mut().zip(free) {
                        *x -= factor * entry(of_other, free);
                    }
                }
            }
            if let (Some(own), Some(transform)) =
                (self.rows.get_mut(row), self.transform.get_mut(row))
            {
                for (&x, &free) in of_free.iter().zip(free) {
                    if let Some(own) = own.get_mut(free) {
                        *own = x * reciprocal;
                    }
                }
                for (own, sum) in transform.iter_mut().zip(sums) {
                    *own = (*own + sum) * reciprocal;
                }
            }
        }
    }

    /// Lists the columns without a pivot.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn find_free(&mut self) {
        self.freedom = 0;
        for (column, &row) in self.row_of.iter().enumerate() {
            if let (NONE, Some(free)) = (row, self.free.get_mut(self.freedom)) {
                *free = column;
                self.freedom += 1;
            }
        }
    }

    /// Which rows have a pivot.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn loop_rows(&self) -> LoopRows<C> {
        LoopRows { independent: self.column_of.map(|column| column != NONE) }
    }

    /// The coordinates without a pivot, which the others depend on.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn free(&self) -> impl DoubleEndedIterator<Item = usize> {
        let free = self.free.get(..self.freedom).unwrap_or_default();
        free.iter().copied()
    }

    /// The row of the pivot of a column.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn row_of(&self, column: usize) -> Option<&[R; V]> {
        self.rows.get(entry(&self.row_of, column))
    }

    /// x with K x = 0, of given free coordinates.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn complete(&self, free: &[R; V]) -> [R; V] {
        let mut x = *free;
        let mut given: Vec<(usize, R), V> = Vec::new();
        for column in self.free() {
            let _ = given.push((column, entry(free, column)));
        }
        for (row, &column) in self.rows.iter().zip(&self.column_of) {
            if let Some(x) = x.get_mut(column) {
                let products = given.iter().map(|&(free, x)| entry(row, free) * x);
                *x = products.fold(R::ZERO, |sum, product| sum - product);
            }
        }
        x
    }

    /// x with K x = `right`, of free coordinates that are zero.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn particular(&self, right: &[R; C]) -> [R; V] {
        let mut x = [R::ZERO; V];
        for (transform, &column) in self.transform.iter().zip(&self.column_of) {
            if let Some(x) = x.get_mut(column) {
                *x = dot(transform, right);
            }
        }
        x
    }

    /// Entry `free` of Gᵀ τ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn transposed(&self, free: usize, tau: &[R; V]) -> R {
        let mut sum = entry(tau, free);
        for (row, &column) in self.rows.iter().zip(&self.column_of) {
            if column != NONE {
                sum -= entry(row, free) * entry(tau, column);
            }
        }
        sum
    }

    /// λ with Kᵀ λ = `torque` in the coordinates with a pivot.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn lambda(&self, torque: &[R; V]) -> [R; C] {
        let mut lambda = [R::ZERO; C];
        for (transform, &column) in self.transform.iter().zip(&self.column_of) {
            if column != NONE {
                subtract(&mut lambda, -entry(torque, column), transform);
            }
        }
        lambda
    }
}

/// Removes a number from a list without an order.
#[cfg_attr(optimised, inline(always))]
fn take<const N: usize>(list: &mut Vec<usize, N>, at: usize) -> Option<usize> {
    let taken = list.get(at).copied();
    if let (Some(last), Some(place)) = (list.pop(), list.get_mut(at)) {
        *place = last;
    }
    taken
}

#[cfg_attr(optimised, inline(always))]
pub(super) fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let products = a.iter().zip(b).map(|(&a, &b)| a * b);
    products.fold(R::ZERO, |sum, product| sum + product)
}

/// a −= factor b.
#[cfg_attr(optimised, inline(always))]
pub(super) fn subtract<R: Real, const N: usize>(a: &mut [R; N], factor: R, b: &[R; N]) {
    for (a, &b) in a.iter_mut().zip(b) {
        *a -= factor * b;
    }
}
