//! The configuration of the estimator of a load, and why it rejects a tick.

use core::fmt;

use super::PARAMETERS;
use crate::limits::{ConfigError, ConfigParameter};
use dynamics_core::scalar::Real;

/// The parameters of a [`PayloadEstimator`](super::PayloadEstimator).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PayloadEstimatorConfig<R, const V: usize> {
    /// Standard deviation of the measured less the modelled torque of each joint in one tick, N·m or N.
    pub noise: [R; V],
    /// Standard deviation of each parameter before the first tick, about zero: kg, kg·m, kg·m². It decides what is estimated
    /// of a parameter that the motion does not show.
    pub prior: [R; PARAMETERS],
    /// The share of the information that a tick replaces at most, 0 to less than 1. 1/N forgets a load within a few times N ticks
    /// of motion and then averages over some N ticks; 0 never forgets.
    pub forgetting: R,
    /// The greatest root mean square of a tick's innovations, in standard deviations, of a tick that is used: 3 to 1000.
    pub limit: R,
}

impl<R: Real, const V: usize> PayloadEstimatorConfig<R, V> {
    /// Checks that each standard deviation is between 10⁻⁶ and 10⁶ the forgetting at least 0 and less than 1,
    /// and the limit between 3 and 1000.
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

/// The reason why a [`PayloadEstimator`](super::PayloadEstimator) rejects a tick.
///
/// ```
/// use motion_control::RejectedMeasurement;
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
                write!(
                    out,
                    "joint {joint}: its torque or its regressor is not finite"
                )
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
