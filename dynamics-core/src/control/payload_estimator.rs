//! The inertial parameters of a load from the torques of the joints: recursive least squares by orthogonal transformations.
//!
//! The information about φ is Uᵀ D U, with a unit upper triangle U and a diagonal D, and U φ = d. One orthogonal transformation T
//! adds the rows of a tick, weighted by their noise (Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977,
//! chapter V):
//!
//! ```text
//! T [ √D U  √D d ] = [ √D⁺ U⁺  √D⁺ d⁺ ]
//!   [   Y     z  ]   [   0        e   ]
//! ```
//!
//! T is a product of ten Householder reflections. Each eliminates a column y by the row (D, u). Of another column x it leaves
//!
//! ```text
//! D⁺ = D + y·y      u⁺ = u + t / D⁺      x⁺ = x − y (u + t / (D⁺ + √(D D⁺)))      t = y·x − y·y u
//! ```
//!
//! so that a tick without information changes no bit. No product Yᵀ Y of different columns is stored: the condition of the problem
//! in f32 is that of Y, not of Yᵀ Y.

mod config;

pub use config::{PayloadEstimatorConfig, RejectedMeasurement};

use super::ConfigError;
use crate::scalar::Real;
use crate::spatial::SpatialInertia;
use crate::state::entry;

/// The inertial parameters of a body.
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
/// D_k is the information about parameter k given those after it. In each tick it loses the configured share, but never more than
/// the tick adds to it. Therefore no D_k ever falls, nor does the determinant of the information: what the motion does not show
/// is not forgotten and does not drift.
///
/// # Cost
/// [`Self::update`] takes some 2,100 flops for six joints, 10 reciprocal roots and 20 divisions; [`Self::update_joints`] 1,300
/// for three of them; [`Self::inertia`] 90 flops.
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
    /// 1/σ² of the parameters at the start.
    start: [R; PARAMETERS],
    forgetting: R,
    /// D.
    information: [R; PARAMETERS],
    /// Row k: the entries of U right of its diagonal, and that of d.
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
            start: config.prior.map(|x| R::ONE / (x * x)),
            forgetting: config.forgetting,
            information: [R::ZERO; PARAMETERS],
            rows: [[R::ZERO; PARAMETERS + 1]; PARAMETERS],
        };
        new.restart();
        Ok(new)
    }

    /// Forgets the load: for another one, or none.
    pub fn restart(&mut self) {
        self.information = self.start;
        self.rows = [[R::ZERO; PARAMETERS + 1]; PARAMETERS];
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
        self.update_joints(core::array::from_fn::<_, V, _>(|i| i), y, residual)
    }

    /// As [`Self::update`], with these joints only: half of them in each tick in turn cost less, and after two ticks the
    /// estimate has all of them. A joint that the robot does not have is left out.
    ///
    /// ```
    /// use dynamics_core::control::{PayloadEstimator, PayloadEstimatorConfig};
    /// let config = PayloadEstimatorConfig { noise: [1.0_f32; 2], prior: [2.0; 10], forgetting: 0.0 };
    /// let mut estimator = PayloadEstimator::try_new(config)?;
    /// let (y, residual) = ([[9.81; 10], [1.0; 10]], [30.0, 5.0]);
    /// for tick in 0..2 {
    ///     estimator.update_joints([tick], &y, &residual)?;
    /// }
    /// let mut both = PayloadEstimator::try_new(config)?;
    /// both.update(&y, &residual)?;
    /// assert!((both.inertia().mass - estimator.inertia().mass).abs() < 1e-5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::update`], for the numbers of these joints.
    #[inline(always)]
    pub fn update_joints<const N: usize>(
        &mut self,
        joints: [usize; N],
        y: &[[R; PARAMETERS]; V],
        residual: &[R; V],
    ) -> Result<(), RejectedMeasurement> {
        let mut size = R::ZERO;
        let mut columns: [[R; N]; PARAMETERS + 1] = core::array::from_fn(|k| {
            core::array::from_fn(|i| {
                let joint = entry(&joints, i);
                let row = y.get(joint).and_then(|row| row.get(k));
                let x = *row.unwrap_or(&entry(residual, joint)) * entry(&self.weights, joint);
                size += x * x;
                x
            })
        });
        // Every number reaches the sum; a NaN fails the comparison.
        let usable = size <= R::from_f64(LARGEST);
        if !usable {
            return Err(reason(joints, y, residual));
        }
        let mut columns = columns.as_mut_slice();
        let rows = self.rows.iter_mut().zip(&mut self.information);
        for (k, (row, information)) in rows.enumerate() {
            let (Some((y, later)), Some(row)) = (columns.split_first_mut(), row.get_mut(k + 1..))
            else {
                break;
            };
            let y = *y; // a copy stays in registers
            let new = dot(&y, &y);
            let old = self.forgetting * *information;
            let kept = *information - if old < new { old } else { new };
            let sum = kept + new;
            let gain = R::ONE / sum;
            let ratio = kept * gain;
            let half = gain / (R::ONE + ratio * ratio.rsqrt());
            for (u, x) in row.iter_mut().zip(later.iter_mut()) {
                let t = dot(&y, x) - new * *u;
                let (next, factor) = (*u + t * gain, *u + t * half);
                *x = core::array::from_fn(|i| entry(x, i) - factor * entry(&y, i));
                *u = next;
            }
            *information = sum;
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
        for (k, information) in self.information.iter().enumerate() {
            let unit = core::array::from_fn(|i| if i == k { R::ONE } else { R::ZERO });
            let per = R::ONE / *information;
            for (variance, x) in variances.iter_mut().zip(self.solve(unit)) {
                *variance += x * x * per;
            }
        }
        variances.map(R::sqrt)
    }

    /// x with U x = b, from the last row to the first.
    #[inline(always)]
    fn solve(&self, mut b: [R; PARAMETERS]) -> [R; PARAMETERS] {
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
fn dot<R: Real>(a: &[R], b: &[R]) -> R {
    let mut products = a.iter().zip(b).map(|(a, b)| *a * *b);
    let first = products.next().unwrap_or(R::ZERO);
    products.fold(first, |sum, product| sum + product)
}

/// Why the numbers of a tick are rejected.
#[cold]
#[inline(never)]
fn reason<R: Real, const N: usize, const V: usize>(
    joints: [usize; N],
    y: &[[R; PARAMETERS]; V],
    residual: &[R; V],
) -> RejectedMeasurement {
    let finite = |joint| {
        let mut numbers = y
            .get(joint)
            .into_iter()
            .flatten()
            .chain(residual.get(joint));
        numbers.all(|x: &R| x.is_finite())
    };
    let wrong = joints.into_iter().find(|&joint| !finite(joint));
    wrong.map_or(RejectedMeasurement::TooLarge, |joint| {
        RejectedMeasurement::NotFinite { joint }
    })
}
