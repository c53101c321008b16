//! The parameters of an arm from the torques of its joints: a recursive estimator of constant work, one row in each update.
//!
//! Of a row yᵀ θ = z + noise of the standard deviation 1 and the covariance P = U D Uᵀ, with a unit upper triangle U and a
//! diagonal D (Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V; Thornton & Bierman 1980):
//!
//! ```text
//! f = Uᵀ y      v = D f      r = f·v = yᵀ P y      b = U v = P y      e = z − yᵀ θ
//! θ⁺ = θ + b e / (1 + r)      P⁺ = P − ε b bᵀ / (1 + ε r)      ε = max(0, 1 − φ (1 + r) / r)
//! ```
//!
//! The information P⁻¹ grows by ε y yᵀ. With ε = 1 this is least squares. Kulhavý (1987) forgets the share φ in the direction
//! of y alone: ε = 1 − φ (1 + r) / r. Where that is negative, the information of the direction would shrink, and with it that of
//! directions which noise mixes in. Here it is kept at that point, so that P never grows; e r / (1 + r) still follows changes.
//! The factors of P⁺ need no root and no difference: with α_j = α_{j−1} + ε v_j f_j ≥ 1,
//!
//! ```text
//! D_j⁺ = D_j α_{j−1} / α_j      U_ij⁺ = U_ij − ε f_j / α_{j−1} Σ_{k<j} U_ik v_k
//! ```

mod config;
mod physical;
mod record;
mod selection;

pub use config::{ParameterEstimatorConfig, RejectedRow};
pub use physical::{ImpossibleParameters, PhysicalParameters};
pub use record::RecordError;
pub use selection::{Excitation, SelectedParameters};

use super::ConfigError;
use crate::math::entry;
use crate::scalar::Real;

/// The numbers up to which no product overflows in f32.
const LARGEST: f64 = 1e18;

/// The rows of other joints that end a freeze: of five joints three time constants of their mean squares.
const OTHERS: u32 = 1024;

/// The share of a row in the mean square of the innovations of its joint.
const RATE: f64 = 1.0 / 64.0;

/// P parameters of an arm with V joints, estimated from one joint's torque in each update.
///
/// A row is the torque per unit of each parameter, as a [`SelectedParameters`] gathers it. The residual is what the nominal model
/// does not explain, and the estimate is the deviation from it: zero at the start.
///
/// # Forgetting
/// Only the direction of the row, and never more than the row adds. No parameter becomes less certain, so that none drifts
/// when the motion does not show it. What the motion shows follows changes within some 1/φ rows.
///
/// # Faults
/// The innovation of a row is what the estimate does not explain, divided by the standard deviation that noise and estimate imply. A
/// row beyond `limit` is rejected. If the root mean square of a joint's innovations over some 64 rows exceeds `limit`/2, the
/// estimate is frozen until it is at most 0.4 `limit`. A joint that then rests has no rows: the freeze also ends after 1,024
/// rows of other joints within `limit`, without a row of that joint or of one above 0.4 `limit` between them. The mean square of the joint
/// that rests is kept, so that the estimate freezes again at its next row if it still exceeds `limit`/2.
///
/// # Cost
/// 3 P² flops, P divisions and some 20 P more flops for the row of any joint: 2,300 for 24 parameters, and 2.7 kB. A rejected row
/// takes a third.
///
/// # Source
/// Bierman (1977), chapter V; Kulhavý, "Restricted exponential forgetting in real-time identification" (1987); without the growth
/// of P, after Bittanti, Bolzern & Campi, "Convergence and exponential convergence of identification algorithms with directional
/// forgetting factor" (1990), and Cao & Schwartz, "A directional forgetting algorithm based on the decomposition of the
/// information matrix" (2000).
///
/// # Example
/// ```
/// use dynamics_core::control::{ParameterEstimator, ParameterEstimatorConfig};
/// let config = ParameterEstimatorConfig { noise: [0.01_f32], prior: [1.0, 1.0], forgetting: 1e-3, limit: 5.0 };
/// let mut friction = ParameterEstimator::try_new(config)?;
/// for tick in 0..200 {
///     let speed = (0.05 * tick as f32).sin();
///     let row = [speed, speed.signum()]; // viscous and Coulomb
///     friction.update(0, &row, 0.3 * row[0] - 0.2 * row[1])?;
/// }
/// let [viscous, coulomb] = *friction.estimate();
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
    estimate: [R; P],
    /// Column j of U above its diagonal, and zeros from it on.
    columns: [[R; P]; P],
    /// D.
    diagonal: [R; P],
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
        let mut new = Self {
            config,
            weights: config.noise.map(|deviation| R::ONE / deviation),
            estimate: [R::ZERO; P],
            columns: [[R::ZERO; P]; P],
            diagonal: [R::ZERO; P],
            levels: [R::ONE; V],
            frozen: None,
            others: 0,
            rejected: [0; V],
        };
        new.reopen();
        Ok(new)
    }

    /// Returns to the uncertainty of the prior with the estimate as it is, and ends a freeze: for an arm that has changed.
    ///
    /// ```
    /// use dynamics_core::control::{ParameterEstimator, ParameterEstimatorConfig};
    /// let config = ParameterEstimatorConfig { noise: [0.01_f64], prior: [1.0], forgetting: 0.0, limit: 5.0 };
    /// let mut one = ParameterEstimator::try_new(config)?;
    /// one.update(0, &[1.0], 0.5)?;
    /// one.reopen();
    /// assert!((one.estimate()[0] - 0.5).abs() < 1e-3 && one.deviations() == [1.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn reopen(&mut self) {
        self.columns = [[R::ZERO; P]; P];
        self.diagonal = self.config.prior.map(|prior| prior * prior);
        self.levels = [R::ONE; V];
        self.frozen = None;
    }

    /// Adds a row: the torque of this joint per unit of each parameter, and its measured less its nominal torque, N·m or N.
    ///
    /// The nominal torque is at all times that of the nominal model from which the estimate deviates, also if the arm is controlled
    /// by learned parameters: a residual against these would lack the deviation that the estimate already has. A row of a joint
    /// that the robot does not have is left out.
    ///
    /// # Errors
    /// [`RejectedRow`] names the reason and the joint; the estimate is then unchanged.
    #[inline]
    pub fn update(&mut self, joint: usize, y: &[R; P], residual: R) -> Result<(), RejectedRow> {
        let (Some(level), Some(count)) = (self.levels.get_mut(joint), self.rejected.get_mut(joint))
        else {
            return Ok(());
        };
        let weight = entry(&self.weights, joint);
        let row = y.map(|y| y * weight);
        let (mut f, mut v, mut r) = ([R::ZERO; P], [R::ZERO; P], R::ZERO);
        let out = f.iter_mut().zip(&mut v).zip(&self.diagonal).zip(&row);
        for (j, ((((f, v), d), y), column)) in out.zip(&self.columns).enumerate() {
            *f = dot_above(column, &row, j) + *y;
            *v = *d * *f;
            r += *f * *v;
        }
        let error = residual * weight - dot_above(&row, &self.estimate, P);
        let (size, square) = (R::ONE + r, error * error);
        // Every number reaches one of the two; a NaN fails the comparison.
        let usable = size + square <= R::from_f64(LARGEST);
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
            let known = if r > forgotten {
                R::ONE - forgotten / r
            } else {
                R::ZERO
            };
            self.add(&f, &v, known, error / size);
            return Ok(());
        }
        *count = count.saturating_add(1);
        Err(match self.frozen {
            _ if !usable => RejectedRow::of_numbers(joint, y, residual),
            Some(by) => RejectedRow::Frozen { joint: by },
            None => RejectedRow::Outlier { joint },
        })
    }

    /// Updates the factors with the weight ε of the row, and the estimate by b times `gain`.
    #[inline(always)]
    fn add(&mut self, f: &[R; P], v: &[R; P], weight: R, gain: R) {
        let mut b = [R::ZERO; P];
        let (mut alpha, mut per) = (R::ONE, R::ONE); // and 1 / α
        let factors = self.columns.iter_mut().zip(&mut self.diagonal);
        for (j, ((column, d), (f, v))) in factors.zip(f.iter().zip(v)).enumerate() {
            let factor = -(weight * *f) * per;
            let ((four, rest), (b_four, b_rest)) =
                (column.as_chunks_mut::<4>(), b.as_chunks_mut::<4>());
            for (column, b) in four.iter_mut().zip(b_four).take(j.div_ceil(4)) {
                raise(column, b, factor, *v);
            }
            raise(rest, b_rest, factor, *v);
            let next = alpha + weight * (*v * *f);
            per = R::ONE / next;
            *d *= alpha * per;
            if let Some(b) = b.get_mut(j) {
                *b = *v;
            }
            alpha = next;
        }
        for (estimate, b) in self.estimate.iter_mut().zip(b) {
            *estimate += b * gain;
        }
    }

    /// The estimated deviations from the nominal parameters, in their units.
    #[must_use]
    pub fn estimate(&self) -> &[R; P] {
        &self.estimate
    }

    /// The standard deviation of each estimated parameter, if the noise is as stated and white. Not for the tick: P² flops.
    #[must_use]
    pub fn deviations(&self) -> [R; P] {
        core::array::from_fn(|i| {
            let columns = self.columns.iter().zip(&self.diagonal);
            let terms = columns.map(|(column, d)| entry(column, i) * entry(column, i) * *d);
            let own = entry(&self.diagonal, i);
            terms.fold(own, |sum, term| sum + term).sqrt()
        })
    }

    /// The joint whose innovations have frozen the estimate; `None` while rows are accepted.
    #[must_use]
    pub fn frozen(&self) -> Option<usize> {
        self.frozen
    }

    /// The mean square of the innovations of each joint over some 64 rows: one if noise and model are as stated.
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

/// U_ij − ε f_j / α_{j−1} b_i and b_i + U_ij v_j: with b = 0 below the rows so far, the zeros of U there remain.
#[inline(always)]
fn raise<R: Real>(column: &mut [R], b: &mut [R], factor: R, v: R) {
    for (u, b) in column.iter_mut().zip(b) {
        let old = *u;
        *u += factor * *b;
        *b += old * v;
    }
}

/// The scalar product of the first n of P numbers, where `a` is zero from there on: by fours, for fewer branches.
#[inline(always)]
fn dot_above<R: Real, const P: usize>(a: &[R; P], b: &[R; P], n: usize) -> R {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sum = R::ZERO;
    for (a, b) in a.iter().zip(b).take(n.div_ceil(4)) {
        let products: [R; 4] = core::array::from_fn(|i| a[i] * b[i]);
        sum += (products[0] + products[1]) + (products[2] + products[3]);
    }
    let rest = a_rest.iter().zip(b_rest);
    rest.fold(sum, |sum, (a, b)| sum + *a * *b)
}
