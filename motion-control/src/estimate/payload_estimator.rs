//! The inertial parameters of a load from the torques of the joints: recursive least squares by
//! orthogonal transformations.
//!
//! The information about φ is Uᵀ D U, with a unit upper triangle U and a diagonal D, and U φ = d.
//! One orthogonal transformation T adds the rows of a tick, weighted by their noise (Bierman,
//! *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V):
//!
//! ```text
//! T [ √D U  √D d ] = [ √D⁺ U⁺  √D⁺ d⁺ ]
//!   [   Y     z  ]   [   0        e   ]
//! ```
//!
//! T is a product of ten Householder reflections. Each eliminates a column y by the row (D, u), and
//! leaves of another column x
//!
//! ```text
//! D⁺ = D + y·y      u⁺ = u + t / D⁺      x⁺ = x − y (u + t / (D⁺ + √(D D⁺)))      t = y·x − y·y u
//! ```
//!
//! so that a tick without information changes no bit. No product Yᵀ Y of different columns is
//! stored: the condition of the problem in f32 is that of Y, not of Yᵀ Y.

use core::fmt;

use crate::entry;
use crate::limits::{ConfigError, ConfigParameter};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::SpatialInertia;

#[cfg(test)]
mod tests;

/// The inertial parameters of a body.
const PARAMETERS: usize = 10;

/// The sum of squares of all weighted numbers of a tick up to which no product overflows in f32.
const LARGEST: f64 = 1e18;

/// The share of a tick in the mean square of the innovations.
const RATE: f64 = 1.0 / 64.0;

/// The shares of the square of the limit at which a freeze begins and ends.
const FREEZES: f64 = 0.25;
const THAWS: f64 = 0.16;

/// The ticks after which another estimate may replace a frozen one: 16 time constants of its mean
/// square.
const OTHER: u32 = 1024;
/// The ticks from which on its mean square counts.
const FIRST: u32 = 256;

/// The parameters of a [`PayloadEstimator`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PayloadEstimatorConfig<R, const V: usize> {
    /// Standard deviation of the measured less the modelled torque of each joint in one tick, N·m
    /// or N.
    pub noise: [R; V],
    /// Standard deviation of each parameter before the first tick, about zero: kg, kg·m, kg·m². It
    /// decides what is estimated of a parameter that the motion does not show.
    pub prior: [R; PARAMETERS],
    /// The share of the information that a tick replaces at most, 0 to less than 1. 1/N forgets a
    /// load within a few times N ticks of motion and then averages over some N ticks; 0 never
    /// forgets.
    pub forgetting: R,
    /// The greatest root mean square of a tick's innovations, in standard deviations, of a tick
    /// that is used: 3 to 1000.
    pub limit: R,
}

impl<R: Real, const V: usize> PayloadEstimatorConfig<R, V> {
    /// Checks that each standard deviation is between 10⁻⁶ and 10⁶ the forgetting at least 0 and
    /// less than 1, and the limit between 3 and 1000.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    pub fn check(&self) -> Result<(), ConfigError> {
        let usable = |x: &R| (*x >= R::from_f64(1e-6)) & (*x <= R::from_f64(1e6));
        ConfigParameter::TorqueNoise.require(self.noise.iter().all(usable))?;
        ConfigParameter::PriorDeviation.require(self.prior.iter().all(usable))?;
        let share = (self.forgetting >= R::ZERO) & (self.forgetting < R::ONE);
        ConfigParameter::Forgetting.require(share)?;
        let limit = (self.limit >= R::from_f64(3.0)) & (self.limit <= R::from_f64(1e3));
        ConfigParameter::InnovationLimit.require(limit)
    }
}

/// The reason why a [`PayloadEstimator`] rejects a tick.
///
/// ```
/// use motion_control::estimate::RejectedMeasurement;
/// let reason = RejectedMeasurement::NotFinite { joint: 2 };
/// assert_eq!(reason.to_string(), "joint 2: its torque or its regressor is not finite");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum RejectedMeasurement {
    /// A torque or an entry of the regressor is infinite or not a number.
    NotFinite {
        /// The joint.
        joint: usize,
    },
    /// The numbers of the tick exceed 10⁹ standard deviations of the noise.
    TooLarge,
    /// The innovations of the tick are beyond the limit.
    Outlier,
    /// The innovations of many ticks were too large: noise, model or load are not as stated.
    Frozen,
}

impl fmt::Display for RejectedMeasurement {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { joint } => {
                write!(out, "joint {joint}: its torque or its regressor is not finite")
            }
            Self::TooLarge => out.write_str("the torques or the regressor are too large"),
            Self::Outlier => out.write_str("the torques are not those of the estimated load"),
            Self::Frozen => {
                out.write_str("the torques of many ticks are not those of the estimated load")
            }
        }
    }
}

impl core::error::Error for RejectedMeasurement {}

/// The inertial parameters of a load on one body, estimated from the torques of V joints.
///
/// Each tick adds the torques that the model without the load does not explain, and the body's
/// [columns of the regressor](dynamics_core::algorithms::regressor_columns). The work is the same
/// in every tick, and the covariance is never formed.
///
/// # Forgetting
/// D_k is the information about parameter k given those after it. In each tick it loses the
/// configured share, but never more than the tick adds to it. Therefore no D_k ever falls, nor does
/// the determinant of the information: what the motion does not show is not forgotten and does not
/// drift.
///
/// # Faults
/// ‖e‖² is the square of the tick's innovations in units of the standard deviations that noise and
/// estimate imply. A tick whose innovations have a root mean square beyond `limit` is rejected; the
/// factors of the next tick are computed into a second set, so that it changes nothing. If the root
/// mean square over some 64 ticks exceeds `limit`/2, the estimate is frozen until it explains the
/// torques again, within 0.4 `limit`. Meanwhile another estimate begins in the second set. If this
/// one explains the torques after 1,024 ticks or more, by parameters within `limit` times the
/// prior, it replaces the frozen one: the load has changed, or the first ticks were wrong. A model
/// that is wrong is explained by no load, and the estimate stays frozen.
///
/// # Cost
/// [`Self::update`] takes some 2,200 flops for six joints, 10 reciprocal roots and 20 divisions;
/// [`Self::update_joints`] 1,300 for three of them; [`Self::inertia`] 90 flops.
///
/// # Source
/// Bierman (1977), chapter V; the forgetting after Kulhavý, "Restricted exponential forgetting in
/// real-time identification" (1987).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{regressor_columns, rnea};
/// use motion_control::estimate::{PayloadEstimator, PayloadEstimatorConfig};
/// use dynamics_core::effects::{Payload, RIGID_BODY};
/// use dynamics_core::model::{BodyInertia, Robot};
/// use dynamics_core::{robots::Ur5e, state::State};
/// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
/// let mut estimator: PayloadEstimator<f64, 6> = PayloadEstimator::try_new(PayloadEstimatorConfig {
///     noise: [1.0, 1.0, 1.0, 0.3, 0.3, 0.3],
///     prior: [5.0, 0.5, 0.5, 0.5, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05],
///     forgetting: 0.0,
///     limit: 5.0,
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
    /// The square of the limit.
    most: R,
    /// The factors of this tick and of the next one.
    factors: [Factors<R>; 2],
    /// Whether this tick has the second of them.
    second: bool,
    /// The mean square of the innovations.
    level: R,
    freeze: Option<Freeze<R>>,
}

impl<R: Real, const V: usize> PayloadEstimator<R, V> {
    /// An estimator without a load, as uncertain as the prior.
    ///
    /// # Errors
    /// [`ConfigError`], as [`PayloadEstimatorConfig::check`].
    pub fn try_new(config: PayloadEstimatorConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        let start = config.prior.map(|x| R::ONE / (x * x));
        Ok(Self {
            weights: config.noise.map(|deviation| R::ONE / deviation),
            start,
            forgetting: config.forgetting,
            most: config.limit * config.limit,
            factors: [Factors::of(start); 2],
            second: false,
            level: R::ONE,
            freeze: None,
        })
    }

    /// Forgets the load and ends a freeze: for another load, or none: at once, without the ticks of
    /// a freeze.
    pub fn restart(&mut self) {
        self.factors = [Factors::of(self.start); 2];
        (self.second, self.level, self.freeze) = (false, R::ONE, None);
    }

    /// Whether the innovations have frozen the estimate.
    #[must_use]
    pub fn frozen(&self) -> bool {
        self.freeze.is_some()
    }

    /// The mean square of the innovations over some 64 ticks: one if noise and model are as stated.
    #[must_use]
    pub fn consistency(&self) -> R {
        self.level
    }

    #[inline(always)]
    fn factors(&self) -> &Factors<R> {
        let [first, second] = &self.factors;
        if self.second { second } else { first }
    }

    /// Adds a tick: the body's [columns](dynamics_core::algorithms::regressor_columns) of the
    /// regressor, and the measured torques less those of the model without the load, N·m or N.
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

    /// As [`Self::update`], with these joints only: half of them in each tick in turn cost less,
    /// and after two ticks the estimate has all of them. A joint that the robot does not have is
    /// left out.
    ///
    /// ```
    /// use motion_control::estimate::{PayloadEstimator, PayloadEstimatorConfig};
    /// let config = PayloadEstimatorConfig { noise: [1.0_f32; 2], prior: [2.0; 10], forgetting: 0.0, limit: 5.0 };
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
        if self.freeze.is_some() {
            return self.frozen_tick(&mut columns);
        }
        let [first, second] = &mut self.factors;
        let (now, next) = if self.second { (second, first) } else { (first, second) };
        let innovation = next.transform(now, self.forgetting, &mut columns);
        let within = innovation <= self.most;
        let bounded = if within { innovation } else { self.most };
        self.level += (bounded - self.level) * R::from_f64(RATE);
        if self.level > self.most * R::from_f64(FREEZES) {
            self.freeze();
            return Err(RejectedMeasurement::Frozen);
        }
        if !within {
            return Err(RejectedMeasurement::Outlier);
        }
        self.second = !self.second;
        Ok(())
    }

    /// The estimated inertia of the load in the frame of its body, about that frame's origin: kg,
    /// kg·m, kg·m².
    ///
    /// It need not be that of a body:
    /// [`Payload::try_new`](dynamics_core::effects::Payload::try_new) refuses an impossible one.
    /// If the motion does not show the moments of inertia, use mass and centre of mass alone.
    #[must_use]
    pub fn inertia(&self) -> SpatialInertia<R> {
        let right = self.factors().rows.map(|[.., d]| d);
        SpatialInertia::from_parameters(self.factors().solve(right))
    }

    /// The standard deviation of each estimated parameter, kg, kg·m and kg·m² in the order of
    /// [`SpatialInertia::parameters`], if the noise is as stated and white. Not for the tick: some
    /// 1,000 flops.
    ///
    /// ```
    /// use motion_control::estimate::{PayloadEstimator, PayloadEstimatorConfig};
    /// let prior = [5.0, 0.5, 0.5, 0.5, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05];
    /// let config = PayloadEstimatorConfig { noise: [2.0_f64], prior, forgetting: 0.0, limit: 5.0 };
    /// let mut estimator = PayloadEstimator::try_new(config)?;
    /// estimator.update(&[[9.81, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]], &[19.62])?;
    /// let [mass, moment, ..] = estimator.deviations();
    /// assert!((mass - 2.0 / 9.81).abs() < 1e-3 && (moment - 0.5).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn deviations(&self) -> [R; PARAMETERS] {
        let mut variances = [R::ZERO; PARAMETERS];
        for (k, information) in self.factors().information.iter().enumerate() {
            let unit = core::array::from_fn(|i| if i == k { R::ONE } else { R::ZERO });
            let per = R::ONE / *information;
            for (variance, x) in variances.iter_mut().zip(self.factors().solve(unit)) {
                *variance += x * x * per;
            }
        }
        variances.map(R::sqrt)
    }
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
        let mut numbers = y.get(joint).into_iter().flatten().chain(residual.get(joint));
        numbers.all(|x: &R| x.is_finite())
    };
    let wrong = joints.into_iter().find(|&joint| !finite(joint));
    wrong.map_or(RejectedMeasurement::TooLarge, |joint| RejectedMeasurement::NotFinite { joint })
}

/// A freeze.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Freeze<R> {
    /// The frozen parameters.
    parameters: [R; PARAMETERS],
    /// The mean square of the innovations of the estimate that began with the freeze, and its
    /// ticks.
    level: R,
    ticks: u32,
}

impl<R: Real, const V: usize> PayloadEstimator<R, V> {
    /// Freezes the estimate, and begins another one in the second set of factors.
    #[cold]
    fn freeze(&mut self) {
        let factors = self.factors();
        let parameters = factors.solve(factors.rows.map(|[.., d]| d));
        self.begin(parameters);
    }

    /// Begins another estimate beside these frozen parameters.
    fn begin(&mut self, parameters: [R; PARAMETERS]) {
        *self.other() = Factors::of(self.start);
        self.freeze = Some(Freeze { parameters, level: self.most, ticks: 0 });
    }

    #[inline(always)]
    fn other(&mut self) -> &mut Factors<R> {
        let [first, second] = &mut self.factors;
        if self.second { first } else { second }
    }

    /// Whether no parameter of the other estimate is beyond the limit of its deviation before the
    /// first tick.
    fn other_is_expected(&mut self) -> bool {
        let (most, start) = (self.most, self.start);
        let other = self.other();
        let parameters = other.solve(other.rows.map(|[.., d]| d));
        parameters.iter().zip(start).all(|(x, start)| *x * *x * start <= most)
    }

    /// A tick of a frozen estimate.
    #[cold]
    #[inline(never)]
    fn frozen_tick<const N: usize>(
        &mut self,
        columns: &mut [[R; N]; PARAMETERS + 1],
    ) -> Result<(), RejectedMeasurement> {
        let (most, rate) = (self.most, R::from_f64(RATE));
        let bounded = |square: R| if square <= most { square } else { most };
        let thaws = most * R::from_f64(THAWS);
        let Some(mut freeze) = self.freeze else {
            return Ok(());
        };
        let [y @ .., z] = &*columns;
        let mut error = *z;
        for (y, parameter) in y.iter().zip(&freeze.parameters) {
            error = core::array::from_fn(|i| entry(&error, i) - entry(y, i) * *parameter);
        }
        let share = R::from_f64(const { 1.0 / (if N == 0 { 1 } else { N }) as f64 });
        self.level += (bounded(dot(&error, &error) * share) - self.level) * rate;

        let forgetting = self.forgetting;
        let other = self.other();
        let before = *other;
        let innovation = other.transform(&before, forgetting, columns);
        freeze.level += (bounded(innovation) - freeze.level) * rate;
        freeze.ticks = freeze.ticks.saturating_add(1);
        self.freeze = Some(freeze);
        if self.level <= thaws {
            self.freeze = None;
        } else if (freeze.ticks >= OTHER) & (freeze.level <= thaws) && self.other_is_expected() {
            (self.second, self.level, self.freeze) = (!self.second, freeze.level, None);
        } else if (freeze.ticks >= FIRST) & (freeze.level > most * R::from_f64(FREEZES)) {
            // It has ticks of a fault.
            self.begin(freeze.parameters);
        }
        Err(RejectedMeasurement::Frozen)
    }
}

/// The information about the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Factors<R> {
    /// D.
    information: [R; PARAMETERS],
    /// Row k: the entries of U right of its diagonal, and that of d.
    rows: [[R; PARAMETERS + 1]; PARAMETERS],
}

impl<R: Real> Factors<R> {
    fn of(information: [R; PARAMETERS]) -> Self {
        Self { information, rows: [[R::ZERO; PARAMETERS + 1]; PARAMETERS] }
    }

    /// T: these from the factors of the tick before and from its rows. Returns the mean square of
    /// e.
    #[inline(never)] // shared by the tick and that of a freeze: 3 kB
    fn transform<const N: usize>(
        &mut self,
        now: &Self,
        forgetting: R,
        columns: &mut [[R; N]; PARAMETERS + 1],
    ) -> R {
        let mut rest = columns.as_mut_slice();
        let rows = now.rows.iter().zip(&now.information);
        let next_rows = self.rows.iter_mut().zip(&mut self.information);
        for (k, ((row, information), (next_row, next))) in rows.zip(next_rows).enumerate() {
            let (Some((y, later)), Some(row), Some(next_row)) =
                (rest.split_first_mut(), row.get(k + 1..), next_row.get_mut(k + 1..))
            else {
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
    fn solve(&self, mut b: [R; PARAMETERS]) -> [R; PARAMETERS] {
        for (k, row) in self.rows.iter().enumerate().rev() {
            let (Some((b, known)), Some(row)) =
                (b.get_mut(k..).and_then(<[R]>::split_first_mut), row.get(k + 1..PARAMETERS))
            else {
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
