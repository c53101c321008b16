//! The result of an identification.

use nalgebra::DMatrix;

use crate::FourierMotion;

/// Base parameters of an arm with their standard deviations.
///
/// ```
/// use identification::Identified;
/// /// Whether a value is within what the estimate states.
/// fn agrees<const V: usize>(found: &Identified<V>, parameter: usize, value: f64) -> bool {
///     (found.base[parameter] - value).abs() < 2.0 * found.deviations[parameter]
/// }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Identified<const V: usize> {
    /// The base parameters, in the order of [`BaseModel`](crate::BaseModel).
    pub base: Vec<f64>,
    /// Their standard deviations: within twice these of the true value are 95.4 % of the
    /// parameters, if the model is that of the arm and the noise is normal.
    pub deviations: Vec<f64>,
    /// The standard deviation of what the estimate does not explain, by harmonics from 0 to H and
    /// joints: of the torque of one sample, N·m or N, if all harmonics had as much.
    pub noise: Vec<[f64; V]>,
    /// The condition number of the regressor with rows relative to this noise.
    pub condition: f64,
    /// The mean period of the motion by its measured positions.
    pub motion: FourierMotion<V>,
    /// S, of which the covariance is SᵀS.
    pub(crate) root: DMatrix<f64>,
}

impl<const V: usize> Identified<V> {
    /// The covariance of the base parameters, row by row.
    ///
    /// ```
    /// use identification::Identified;
    /// /// The standard deviation of the sum of two parameters.
    /// fn of_sum<const V: usize>(found: &Identified<V>, [a, b]: [usize; 2]) -> f64 {
    ///     let covariance = found.covariance();
    ///     (covariance[a][a] + 2.0 * covariance[a][b] + covariance[b][b]).sqrt()
    /// }
    /// ```
    #[must_use]
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let covariance = self.root.tr_mul(&self.root);
        covariance.row_iter().map(|row| row.iter().copied().collect()).collect()
    }
}
