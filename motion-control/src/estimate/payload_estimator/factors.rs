//! The information about a load's parameters, and how the rows of a tick are added to it.

use super::PARAMETERS;
use crate::entry;
use dynamics_core::scalar::Real;

/// The information about the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factors<R> {
    /// D.
    pub(super) information: [R; PARAMETERS],
    /// Row k: the entries of U right of its diagonal, and that of d.
    pub(super) rows: [[R; PARAMETERS + 1]; PARAMETERS],
}

impl<R: Real> Factors<R> {
    pub(super) fn of(information: [R; PARAMETERS]) -> Self {
        Self {
            information,
            rows: [[R::ZERO; PARAMETERS + 1]; PARAMETERS],
        }
    }

    /// T: these from the factors of the tick before and from its rows. Returns the mean square of e.
    #[inline(never)] // shared by the tick and that of a freeze: 3 kB
    pub(super) fn transform<const N: usize>(
        &mut self,
        now: &Self,
        forgetting: R,
        columns: &mut [[R; N]; PARAMETERS + 1],
    ) -> R {
        let mut rest = columns.as_mut_slice();
        let rows = now.rows.iter().zip(&now.information);
        let next_rows = self.rows.iter_mut().zip(&mut self.information);
        for (k, ((row, information), (next_row, next))) in rows.zip(next_rows).enumerate() {
            let (Some((y, later)), Some(row), Some(next_row)) = (
                rest.split_first_mut(),
                row.get(k + 1..),
                next_row.get_mut(k + 1..),
            ) else {
                break;
            };
            let y = *y; // a copy stays in registers
            let new = dot(&y, &y);
            let old = forgetting * *information;
            let kept = *information - if old < new { old } else { new };
            let sum = kept + new;
            let gain = R::ONE / sum;
            let ratio = kept * gain;
            let half = gain / (R::ONE + ratio * ratio.rsqrt());
            for ((u, next), x) in row.iter().zip(next_row).zip(later.iter_mut()) {
                let old = *x; // the store of `next` is not between its two uses
                let t = dot(&y, &old) - new * *u;
                let factor = *u + t * half;
                *x = core::array::from_fn(|i| entry(&old, i) - factor * entry(&y, i));
                *next = *u + t * gain;
            }
            *next = sum;
            rest = later;
        }
        let [.., e] = columns;
        dot(e, e) * R::from_f64(const { 1.0 / (if N == 0 { 1 } else { N }) as f64 })
    }

    /// x with U x = b, from the last row to the first.
    #[inline(always)]
    pub(super) fn solve(&self, mut b: [R; PARAMETERS]) -> [R; PARAMETERS] {
        for (k, row) in self.rows.iter().enumerate().rev() {
            let (Some((b, known)), Some(row)) = (
                b.get_mut(k..).and_then(<[R]>::split_first_mut),
                row.get(k + 1..PARAMETERS),
            ) else {
                break;
            };
            *b -= dot(row, known);
        }
        b
    }
}

/// The scalar product.
#[inline(always)]
pub(super) fn dot<R: Real>(a: &[R], b: &[R]) -> R {
    let mut products = a.iter().zip(b).map(|(a, b)| *a * *b);
    let first = products.next().unwrap_or(R::ZERO);
    products.fold(first, |sum, product| sum + product)
}
