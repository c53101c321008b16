//! Weighted least squares: the estimate and its covariance.

use nalgebra::{DMatrix, DVector};

/// Least squares with given noise.
pub(crate) struct Solved {
    pub(crate) estimate: DVector<f64>,
    /// The weighted rows are Q R.
    q: DMatrix<f64>,
    factor: DMatrix<f64>,
    /// The diagonal of Q Qᵀ, for each row.
    pub(crate) leverages: DVector<f64>,
}

impl Solved {
    /// Solves rows with these variances.
    pub(crate) fn of(
        rows: &DMatrix<f64>,
        torques: &DMatrix<f64>,
        square: impl Fn(usize) -> f64,
    ) -> Self {
        let (mut rows, mut right) = (rows.clone(), torques.column(0).into_owned());
        for (at, right) in right.iter_mut().enumerate() {
            let weight = 1.0 / square(at).sqrt();
            rows.row_mut(at).scale_mut(weight);
            *right *= weight;
        }
        // Rounding does not depend on the columns' units.
        let norms: Vec<f64> = rows.column_iter().map(|c| c.norm().max(1e-300)).collect();
        for (column, norm) in norms.iter().enumerate() {
            rows.column_mut(column).scale_mut(1.0 / norm);
        }
        let (q, mut factor) = rows.qr().unpack();
        let along = q.tr_mul(&right);
        for (column, norm) in norms.iter().enumerate() {
            factor.column_mut(column).scale_mut(*norm);
        }
        let estimate = factor.solve_upper_triangular(&along);
        Self {
            estimate: estimate.unwrap_or_else(|| DVector::zeros(norms.len())),
            factor,
            leverages: DVector::from_iterator(q.nrows(), q.row_iter().map(|r| r.norm_squared())),
            q,
        }
    }

    /// S with the covariance SᵀS of the estimate R⁻¹ Qᵀ z, if z has these variances.
    pub(crate) fn deviations(&self, squares: &[f64]) -> DMatrix<f64> {
        let inverse = self.factor.clone().try_inverse();
        let mut rows = self.q.clone() * inverse.expect("no singular value is zero").transpose();
        for (mut row, square) in rows.row_iter_mut().zip(squares) {
            row.scale_mut(square.sqrt());
        }
        rows.qr().r()
    }
}
