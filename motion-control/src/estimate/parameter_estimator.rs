//! The parameters of an arm from the torques of its joints: a recursive estimator of constant work,
//! one row in each update.
//!
//! With a row yᵀ θ = z + noise of the standard deviation 1 and the covariance P:
//!
//! ```text
//! r = yᵀ P y      e = z − yᵀ θ
//! θ⁺ = θ + P y e / (1 + r)      (P⁺)⁻¹ = P⁻¹ + ε y yᵀ      ε = max(0, 1 − φ (1 + r) / r)
//! ```
//!
//! With ε = 1 this is least squares. Kulhavý (1987) forgets the share φ in the direction of y
//! alone: ε = 1 − φ (1 + r) / r. If that is negative, the information of the direction would
//! shrink, and with it that of directions which noise mixes in. Here it is kept at that point, so
//! that P never grows; e r / (1 + r) still follows changes. The information is kept in [`factors`],
//! which need no root and no difference.

mod config;
mod factors;
mod physical;
mod record;
mod selection;
#[cfg(test)]
mod tests;

pub use config::{ParameterEstimatorConfig, RejectedRow};
pub use physical::{ImpossibleParameters, PhysicalParameters};
pub use record::RecordError;
pub use selection::{Excitation, SelectedParameters};

use self::factors::{Factors, Places, Row};
use crate::entry;
use crate::limits::ConfigError;
use dynamics_core::scalar::Real;

/// The numbers up to which no product overflows in f32.
const LARGEST: f64 = 1e18;

/// The rows of other joints that end a freeze: of five joints three time constants of their mean
/// squares.
const OTHERS: u32 = 1024;

/// The share of a row in the mean square of the innovations of its joint.
const RATE: f64 = 1.0 / 64.0;

/// P parameters of an arm with V joints, estimated from one joint's torque in each update.
///
/// A row is the torque per unit of each parameter, as a [`SelectedParameters`] gathers it. The
/// residual is what the nominal model does not explain, and the estimate is the deviation from it:
/// zero at the start.
///
/// # Forgetting
/// Only the direction of the row, and never more than the row adds. No parameter becomes less
/// certain, so that none drifts when the motion does not show it. Parameters that the motion shows
/// follow changes within some 1/φ rows.
///
/// # Faults
/// The innovation of a row is what the estimate does not explain, divided by the standard deviation
/// that noise and estimate imply. A row beyond `limit` is rejected. If the root mean square of a
/// joint's innovations over some 64 rows exceeds `limit`/2, the estimate is frozen until it is at
/// most 0.4 `limit`. A joint that then rests has no rows: the freeze also ends after 1,024 rows of
/// other joints within `limit`, without a row of that joint or of one above 0.4 `limit` between
/// them. The mean square of the joint that rests is kept, so that the estimate freezes again at its
/// next row if it still exceeds `limit`/2.
///
/// # Joints
/// Parameters that have an effect on one joint alone, such as its friction, come last, joint by
/// joint, `own` of each. They are correlated with those of other joints by the common parameters
/// only, and a row is added where its joint has entries: of three common parameters and 21 of six
/// joints, six or seven places in place of 24.
///
/// # Cost
/// Some 3 n² + 35 n flops and n divisions for a row of n entries. A rejected row takes a third. 2.8
/// kB for 24 parameters.
///
/// # Source
/// Gentleman, "Least squares computations by Givens transformations without square roots" (1973);
/// Bierman, *Factorization Methods for Discrete Sequential Estimation* (1977), chapter V; Kulhavý,
/// "Restricted exponential forgetting in real-time identification" (1987); without the growth of P,
/// after Bittanti, Bolzern & Campi, "Convergence and exponential convergence of identification
/// algorithms with directional forgetting factor" (1990), and Cao & Schwartz, "A directional
/// forgetting algorithm based on the decomposition of the information matrix" (2000).
///
/// # Example
/// ```
/// use motion_control::estimate::{ParameterEstimator, ParameterEstimatorConfig};
/// let config = ParameterEstimatorConfig { noise: [0.01_f32], prior: [1.0, 1.0], own: [2], forgetting: 1e-3, limit: 5.0 };
/// let mut friction = ParameterEstimator::try_new(config)?;
/// for tick in 0..200 {
///     let speed = (0.05 * tick as f32).sin();
///     let row = [speed, speed.signum()]; // viscous and Coulomb
///     friction.update(0, &row, 0.3 * row[0] - 0.2 * row[1])?;
/// }
/// let [viscous, coulomb] = friction.estimate();
/// assert!((viscous - 0.3).abs() < 1e-3 && (coulomb + 0.2).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "system identification")]
#[doc(alias = "recursive least squares")]
#[doc(alias = "RLS")]
#[doc(alias = "Kalman filter")]
#[doc(alias = "directional forgetting")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterEstimator<R, const P: usize, const V: usize> {
    config: ParameterEstimatorConfig<R, P, V>,
    /// 1/σ of the torques.
    weights: [R; V],
    places: [Places; V],
    factors: Factors<R, P>,
    /// The mean square of the innovations of each joint.
    levels: [R; V],
    frozen: Option<usize>,
    /// The consistent rows of other joints since the last row that was not.
    others: u32,
    rejected: [u32; V],
}

impl<R: Real, const P: usize, const V: usize> ParameterEstimator<R, P, V> {
    /// An estimator at the nominal model, as uncertain as the prior.
    ///
    /// # Errors
    /// [`ConfigError`], as [`ParameterEstimatorConfig::check`].
    pub fn try_new(config: ParameterEstimatorConfig<R, P, V>) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self {
            config,
            weights: config.noise.map(|deviation| R::ONE / deviation),
            places: config.places(),
            factors: Factors::new(&[R::ZERO; P], &config.prior.map(|prior| prior * prior)),
            levels: [R::ONE; V],
            frozen: None,
            others: 0,
            rejected: [0; V],
        })
    }

    /// Returns to the uncertainty of the prior with the estimate as it is, and ends a freeze: for
    /// an arm that has changed.
    ///
    /// ```
    /// use motion_control::estimate::{ParameterEstimator, ParameterEstimatorConfig};
    /// let config = ParameterEstimatorConfig { noise: [0.01_f64], prior: [1.0], own: [0], forgetting: 0.0, limit: 5.0 };
    /// let mut one = ParameterEstimator::try_new(config)?;
    /// one.update(0, &[1.0], 0.5)?;
    /// one.reopen();
    /// assert!((one.estimate()[0] - 0.5).abs() < 1e-3 && one.deviations() == [1.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn reopen(&mut self) {
        let variances = self.config.prior.map(|prior| prior * prior);
        self.factors = Factors::new(&self.estimate(), &variances);
        self.levels = [R::ONE; V];
        self.frozen = None;
    }

    /// Adds a row: the torque of this joint per unit of each parameter, and its measured less its
    /// nominal torque, N·m or N.
    ///
    /// The nominal torque is at all times that of the nominal model from which the estimate
    /// deviates, also if the arm is controlled by learned parameters: a residual against these
    /// would lack the deviation that the estimate already has. A row of a joint that the robot does
    /// not have is left out.
    ///
    /// # Errors
    /// [`RejectedRow`] names the reason and the joint; the estimate is then unchanged.
    #[inline]
    pub fn update(&mut self, joint: usize, y: &[R; P], residual: R) -> Result<(), RejectedRow> {
        let (Some(level), Some(count), Some(&places)) =
            (self.levels.get_mut(joint), self.rejected.get_mut(joint), self.places.get(joint))
        else {
            return Ok(());
        };
        let weight = entry(&self.weights, joint);
        let mut row = Row::ZERO;
        row.set(places, y, weight);
        self.factors.reduce(places, &mut row);
        let (r, own) = (row.variance, places.have_all(y));
        let error = residual * weight - row.explained;
        let (size, square) = (R::ONE + r, error * error);
        // Every number reaches one of the two; a NaN fails the comparison.
        let usable = own & (size + square <= R::from_f64(LARGEST));
        let most = self.config.limit * self.config.limit;
        let within = usable & (square <= most * size);
        let innovation = if within { square / size } else { most };
        *level += (innovation - *level) * R::from_f64(RATE);
        let consistent = *level <= most * R::from_f64(0.16);
        self.others = match self.frozen {
            Some(_) if consistent => self.others.wrapping_add(u32::from(within)),
            _ => 0,
        };
        self.frozen = match self.frozen {
            Some(by) if consistent & ((by == joint) | (self.others >= OTHERS)) => None,
            None if *level > most * R::from_f64(0.25) => Some(joint),
            same => same,
        };
        if within & self.frozen.is_none() {
            let forgotten = self.config.forgetting * size;
            // Without a direction nothing is added.
            let known = if r > forgotten { R::ONE - forgotten / r } else { R::ZERO };
            self.factors.add(places, &mut row, known, error / size);
            return Ok(());
        }
        *count = count.saturating_add(1);
        Err(match self.frozen {
            _ if !usable => RejectedRow::of_numbers(joint, (y, own), residual),
            Some(by) => RejectedRow::Frozen { joint: by },
            None => RejectedRow::Outlier { joint },
        })
    }

    /// The torque of a row by the estimate, N·m or N: yᵀ θ, with the work of a rejected row. Zero
    /// for a joint that the robot does not have.
    #[inline]
    #[must_use]
    pub fn explained(&self, joint: usize, y: &[R; P]) -> R {
        let places = self.places.get(joint);
        places.map_or(R::ZERO, |&places| {
            let mut row = Row::ZERO;
            row.set(places, y, R::ONE);
            self.factors.reduce(places, &mut row);
            row.explained
        })
    }

    /// The estimated deviations from the nominal parameters, in their units. Not for the tick: n²
    /// flops for each.
    #[must_use]
    pub fn estimate(&self) -> [R; P] {
        self.factors.estimate(&self.places)
    }

    /// The standard deviation of each estimated parameter, if the noise is as stated and white. Not
    /// for the tick: n² flops for each.
    #[must_use]
    pub fn deviations(&self) -> [R; P] {
        self.factors.variances(&self.places).map(R::sqrt)
    }

    /// The joint whose innovations have frozen the estimate; `None` while rows are accepted.
    #[must_use]
    pub fn frozen(&self) -> Option<usize> {
        self.frozen
    }

    /// The mean square of the innovations of each joint over some 64 rows: one if noise and model
    /// are as stated.
    #[must_use]
    pub fn consistency(&self) -> &[R; V] {
        &self.levels
    }

    /// The rejected rows of each joint since the start.
    #[must_use]
    pub fn rejected(&self) -> &[u32; V] {
        &self.rejected
    }
}

/// The scalar product of two rows of P numbers: by fours, for fewer branches.
#[inline(always)]
fn dot<R: Real, const P: usize>(a: &[R; P], b: &[R; P]) -> R {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sum = R::ZERO;
    for (a, b) in a.iter().zip(b) {
        let products: [R; 4] = core::array::from_fn(|i| a[i] * b[i]);
        sum += (products[0] + products[1]) + (products[2] + products[3]);
    }
    let rest = a_rest.iter().zip(b_rest);
    rest.fold(sum, |sum, (a, b)| sum + *a * *b)
}
