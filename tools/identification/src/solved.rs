//! Weighted least squares: the estimate, its residuals and its covariance.

use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;
use nalgebra::{DMatrix, DVector};

use crate::{BaseModel, IdentificationError};

/// Beyond this condition number rounding decides, whatever is allowed.
const LARGEST: f64 = 1e12;
/// The share in the undetermined directions from which on a base parameter is named.
const NAMED: f64 = 0.01;

/// Least squares with given noise.
pub(crate) struct Solved {
    pub(crate) estimate: DVector<f64>,
    /// The weighted rows are Q R.
    q: DMatrix<f64>,
    factor: DMatrix<f64>,
    /// The diagonal of Q Qᵀ, for each row.
    pub(crate) leverages: DVector<f64>,
    /// The squares of the weighted residuals.
    pub(crate) squares: DVector<f64>,
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
        let residual = right - &q * &along;
        for (column, norm) in norms.iter().enumerate() {
            factor.column_mut(column).scale_mut(*norm);
        }
        let estimate = factor.solve_upper_triangular(&along);
        Self {
            estimate: estimate.unwrap_or_else(|| DVector::zeros(norms.len())),
            factor,
            leverages: DVector::from_iterator(q.nrows(), q.row_iter().map(|r| r.norm_squared())),
            q,
            squares: residual.map(|x| x * x),
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

    /// The condition number of the weighted and scaled rows.
    pub(crate) fn check<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        most: f64,
    ) -> Result<f64, IdentificationError>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let mut scaled = self.factor.clone();
        for (column, scale) in arm.scale.iter().enumerate() {
            scaled.column_mut(column).scale_mut(1.0 / scale);
        }
        let svd = scaled.svd(false, true);
        let values = &svd.singular_values;
        // At rest all are zero.
        let bound = values.max() / most.min(LARGEST);
        let directions = svd.v_t.as_ref().expect("computed");
        let lost: Vec<usize> = (0..values.len()).filter(|&k| values[k] <= bound).collect();
        if lost.is_empty() {
            return Ok(values.max() / values.min());
        }
        let part = |base: &usize| lost.iter().map(|&k| directions[(k, *base)].powi(2)).sum::<f64>();
        let undetermined: Vec<usize> = (0..arm.len()).filter(|base| part(base) > NAMED).collect();
        Err(IdentificationError::RankDeficient {
            rank: values.len() - lost.len(),
            parameters: undetermined.iter().map(|&base| arm.name(base)).collect(),
            undetermined,
        })
    }
}
