//! The mass, centre of mass and inertia of a load from the torques of the joints: recursive least squares in square-root form.
//!
//! With the rows of a tick weighted by their noise, the triangle R of the information Rᵀ R, and R φ = d, one orthogonal
//! transformation adds a tick (Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V):
//!
//! ```text
//! T [ R  d ] = [ R⁺ d⁺ ]
//!   [ Y  z ]   [ 0  e  ]
//! ```
//!
//! T is a product of ten Householder reflections. Each is written as an increment, ρ² = a² + y·y of the pivot a and the column y:
//!
//! ```text
//! δ = ρ − a = y·y / (ρ + a)      r⁺ = r + (y·x − δ r) / ρ      x⁺ = x − y (r + r⁺) / (ρ + a)
//! ```
//!
//! so that a tick without information changes no bit of R and d. Nothing is squared that is not under a root: the condition of
//! the problem in f32 is that of Y, not of Yᵀ Y.

mod config;

pub use config::{PayloadEstimatorConfig, RejectedMeasurement};

use super::ConfigError;
use crate::scalar::Real;
use crate::spatial::SpatialInertia;
use crate::state::entry;

/// Parameters of a body, and beside them the right side.
const PARAMETERS: usize = 10;

/// The sum of squares of all weighted numbers of a tick up to which no product overflows in f32.
const LARGEST: f64 = 1e18;

/// The inertial parameters of a load on one body, estimated from the torques of V joints.
///
/// Each tick adds the torques that the model without the load does not explain, and the body's
/// [columns of the regressor](crate::algorithms::regressor_columns). The work is the same in every tick, and the covariance
/// is never formed.
///
/// # Forgetting
/// Row k of the triangle is the information about a parameter given those after it. In each tick it loses the configured share,
/// but never more than the tick adds to its pivot. Therefore no pivot of the triangle ever falls, nor does the determinant of the
/// information: what the motion does not show is not forgotten and does not drift.
///
/// # Cost
/// [`Self::update`] takes some 2,000 flops for six joints, 10 reciprocal roots and 20 divisions; [`Self::inertia`] 100 flops
/// and 10 divisions.
///
/// # Source
/// Bierman (1977), chapter V; the forgetting after Kulhavý, "Restricted exponential forgetting in real-time identification"
/// (1987).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{regressor_columns, rnea};
/// use dynamics_core::control::{PayloadEstimator, PayloadEstimatorConfig};
/// use dynamics_core::effects::{Payload, RIGID_BODY};
/// use dynamics_core::model::{BodyInertia, Robot};
/// use dynamics_core::{robots::Ur5e, state::State};
/// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
/// let mut estimator: PayloadEstimator<f64, 6> = PayloadEstimator::try_new(PayloadEstimatorConfig {
///     noise: [1.0, 1.0, 1.0, 0.3, 0.3, 0.3],
///     prior: [5.0, 0.5, 0.5, 0.5, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05],
///     forgetting: 0.0,
/// })?;
/// let held = BodyInertia { mass: 1.5, com: [0.02, 0.0, 0.06], inertia: [0.0; 6] };
/// let scene = (RIGID_BODY, Payload::<f64, WRIST>::from_inertia(held));
/// for tick in 0..500 {
///     let phase: [f64; 6] = core::array::from_fn(|i| 0.01 * (1.0 + 0.3 * i as f64) * f64::from(tick));
///     let state = State { q: phase.map(f64::sin), qd: phase.map(f64::cos), qdd: phase.map(|x| -x.sin()) };
///     let measured = rnea(&Ur5e::MODEL, &state, &scene);
///     let modelled = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
///     let y = regressor_columns(&Ur5e::MODEL, &state, &RIGID_BODY, WRIST);
///     estimator.update(&y, &core::array::from_fn(|i| measured[i] - modelled[i]))?;
/// }
/// let load = BodyInertia::about_com(&estimator.inertia());
/// assert!((load.mass - 1.5).abs() < 0.01 && (load.com[2] - 0.06).abs() < 0.002);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "payload identification")]
#[doc(alias = "load identification")]
#[doc(alias = "recursive least squares")]
#[doc(alias = "RLS")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PayloadEstimator<R, const V: usize> {
    /// 1/σ of the torques.
    weights: [R; V],
    /// 1/σ of the parameters at the start.
    start: [R; PARAMETERS],
    forgetting: R,
    /// Row k: the entries of R from its pivot, at k, and that of d.
    rows: [[R; PARAMETERS + 1]; PARAMETERS],
}

impl<R: Real, const V: usize> PayloadEstimator<R, V> {
    /// An estimator without a load, as uncertain as the prior.
    ///
    /// # Errors
    /// [`ConfigError`], as [`PayloadEstimatorConfig::check`].
    pub fn try_new(config: PayloadEstimatorConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        let mut new = Self {
            weights: config.noise.map(|deviation| R::ONE / deviation),
            start: config.prior.map(|deviation| R::ONE / deviation),
            forgetting: config.forgetting,
            rows: [[R::ZERO; PARAMETERS + 1]; PARAMETERS],
        };
        new.restart();
        Ok(new)
    }

    /// Forgets the load: for another one, or none.
    pub fn restart(&mut self) {
        for (k, (row, start)) in self.rows.iter_mut().zip(&self.start).enumerate() {
            *row = [R::ZERO; PARAMETERS + 1];
            if let Some(pivot) = row.get_mut(k) {
                *pivot = *start;
            }
        }
    }

    /// Adds a tick: the body's [columns](crate::algorithms::regressor_columns) of the regressor, and the measured torques
    /// less those of the model without the load, N·m or N.
    ///
    /// # Errors
    /// [`RejectedMeasurement`] names the reason; the estimate is then unchanged.
    #[inline]
    pub fn update(
        &mut self,
        y: &[[R; PARAMETERS]; V],
        residual: &[R; V],
    ) -> Result<(), RejectedMeasurement> {
        let mut columns = [[R::ZERO; V]; PARAMETERS + 1];
        let mut size = R::ZERO;
        for (k, column) in columns.iter_mut().enumerate() {
            for (i, x) in column.iter_mut().enumerate() {
                let row = y.get(i).and_then(|row| row.get(k));
                *x = *row.unwrap_or(&entry(residual, i)) * entry(&self.weights, i);
                size += *x * *x;
            }
        }
        // Every number reaches the sum; a NaN fails the comparison.
        if !(size <= R::from_f64(LARGEST)) {
            return Err(reason(y, residual));
        }
        let mut columns = columns.as_mut_slice();
        for (k, row) in self.rows.iter_mut().enumerate() {
            let (Some((y, later)), Some((a, row))) = (
                columns.split_first_mut(),
                row.get_mut(k..).and_then(<[R]>::split_first_mut),
            ) else {
                break;
            };
            let y = *y; // a copy stays in registers
            let new = dot(&y, &y);
            // (1 − s/2)² a² + y·y is not less than a² if s a² is at most y·y.
            let share = (new / (*a * *a)).clamped(R::ZERO, self.forgetting);
            let keep = R::ONE - R::from_f64(0.5) * share;
            let kept = keep * *a;
            let square = kept * kept + new;
            let rho_inv = square.rsqrt();
            let sum_inv = R::ONE / (square * rho_inv + kept);
            let delta = new * sum_inv;
            for (r, x) in row.iter_mut().zip(later.iter_mut()) {
                let before = keep * *r;
                let after = before + (dot(&y, x) - delta * before) * rho_inv;
                let factor = (before + after) * sum_inv;
                *x = core::array::from_fn(|i| entry(x, i) - factor * entry(&y, i));
                *r = after;
            }
            *a = kept + delta;
            columns = later;
        }
        Ok(())
    }

    /// The estimated inertia of the load in the frame of its body, about that frame's origin: kg, kg·m, kg·m².
    ///
    /// It need not be that of a body: [`Payload::try_new`](crate::effects::Payload::try_new) refuses an impossible one. Where the
    /// motion does not show the moments of inertia, use mass and centre of mass alone.
    #[must_use]
    pub fn inertia(&self) -> SpatialInertia<R> {
        let right = self.rows.map(|[.., d]| d);
        SpatialInertia::from_parameters(self.solve(right))
    }

    /// The standard deviation of each estimated parameter, kg, kg·m and kg·m² in the order of
    /// [`SpatialInertia::parameters`], if the noise is as stated and white. Not for the tick: some 1,000 flops.
    ///
    /// ```
    /// use dynamics_core::control::{PayloadEstimator, PayloadEstimatorConfig};
    /// let prior = [5.0, 0.5, 0.5, 0.5, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05];
    /// let config = PayloadEstimatorConfig { noise: [2.0_f64], prior, forgetting: 0.0 };
    /// let mut estimator = PayloadEstimator::try_new(config)?;
    /// estimator.update(&[[9.81, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]], &[19.62])?;
    /// let [mass, moment, ..] = estimator.deviations();
    /// assert!((mass - 2.0 / 9.81).abs() < 1e-3 && (moment - 0.5).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn deviations(&self) -> [R; PARAMETERS] {
        let mut variances = [R::ZERO; PARAMETERS];
        for k in 0..PARAMETERS {
            let unit = core::array::from_fn(|i| if i == k { R::ONE } else { R::ZERO });
            for (variance, x) in variances.iter_mut().zip(self.solve(unit)) {
                *variance += x * x;
            }
        }
        variances.map(R::sqrt)
    }

    /// x with R x = b, from the last row to the first.
    #[inline(always)]
    fn solve(&self, mut b: [R; PARAMETERS]) -> [R; PARAMETERS] {
        for (k, row) in self.rows.iter().enumerate().rev() {
            let (Some((b, known)), Some((pivot, row))) = (
                b.get_mut(k..).and_then(<[R]>::split_first_mut),
                row.get(k..PARAMETERS).and_then(<[R]>::split_first),
            ) else {
                break;
            };
            *b = (*b - dot(row, known)) / *pivot;
        }
        b
    }
}

/// The scalar product.
#[inline(always)]
fn dot<R: Real>(a: &[R], b: &[R]) -> R {
    let products = a.iter().zip(b).map(|(a, b)| *a * *b);
    products.fold(R::ZERO, |sum, product| sum + product)
}

/// Why the numbers of a tick are rejected.
#[cold]
#[inline(never)]
fn reason<R: Real, const V: usize>(
    y: &[[R; PARAMETERS]; V],
    residual: &[R; V],
) -> RejectedMeasurement {
    let mut joints = y.iter().zip(residual);
    let wrong = joints.position(|(row, z)| !(row.iter().all(|x| x.is_finite()) & z.is_finite()));
    wrong.map_or(RejectedMeasurement::TooLarge, |joint| {
        RejectedMeasurement::NotFinite { joint }
    })
}
