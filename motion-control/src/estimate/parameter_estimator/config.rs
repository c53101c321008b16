//! The configuration of the estimator of an arm's parameters, and why it rejects a row.

use core::fmt;

use super::factors::Places;
use crate::limits::{ConfigError, ConfigParameter};
use dynamics_core::scalar::Real;

/// The parameters of a [`ParameterEstimator`](super::ParameterEstimator).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ParameterEstimatorConfig<R, const P: usize, const V: usize> {
    /// Standard deviation of the torque of each joint in one row, N·m or N: of the measurement, and
    /// of what the parameters cannot explain.
    pub noise: [R; V],
    /// Standard deviation of each parameter before the first row, about the nominal value.
    pub prior: [R; P],
    /// The number of parameters with an effect on the torque of this joint alone. They are the last
    /// ones, joint by joint, as [`SelectedParameters::own`](super::SelectedParameters::own) counts
    /// them; zeros if all parameters may have an effect on every joint.
    pub own: [u16; V],
    /// The share φ of the direction of a row that is forgotten, 0 to less than 1. 1/N averages over
    /// some N rows; 0 never forgets.
    pub forgetting: R,
    /// The greatest innovation, in standard deviations, from 3 to 1000; 4 or 5 for noise without
    /// outliers.
    pub limit: R,
}

impl<R: Real, const P: usize, const V: usize> ParameterEstimatorConfig<R, P, V> {
    /// Checks that each standard deviation of a torque is between 10⁻⁶ and 10⁶, of a parameter
    /// between 10⁻¹² and 10⁶, the forgetting at least 0 and less than 1, and the limit between 3
    /// and 1000; and that there are as many parameters as `own` has.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    pub fn check(&self) -> Result<(), ConfigError> {
        let within = |x: R, least, most| (x >= R::from_f64(least)) & (x <= R::from_f64(most));
        let noise = |x: &R| within(*x, 1e-6, 1e6);
        ConfigParameter::TorqueNoise.require(self.noise.iter().all(noise))?;
        // The square is far from the least normal f32. Products of inertia of small bodies are
        // below 10⁻⁶ kg·m².
        let prior = |x: &R| within(*x, 1e-12, 1e6);
        ConfigParameter::ParameterDeviation.require(self.prior.iter().all(prior))?;
        let own = self.own.iter().map(|&own| usize::from(own));
        ConfigParameter::OwnParameters.require(own.sum::<usize>() <= P)?;
        let share = (self.forgetting >= R::ZERO) & (self.forgetting < R::ONE);
        ConfigParameter::Forgetting.require(share)?;
        ConfigParameter::InnovationLimit.require(within(self.limit, 3.0, 1e3))
    }

    /// The places of the entries in the rows of each joint.
    pub(super) fn places(&self) -> [Places; V] {
        // Their sum is at most P.
        let own = self.own.iter().fold(0, |sum, own| sum + usize::from(*own));
        let common = P.saturating_sub(own).try_into().unwrap_or(u16::MAX);
        let mut start = common;
        self.own.map(|own| {
            let end = start.saturating_add(own);
            let places = Places { common, start, end };
            start = end;
            places
        })
    }
}

/// The reason why a [`ParameterEstimator`](super::ParameterEstimator) rejects a row.
///
/// ```
/// use motion_control::estimate::RejectedRow;
/// let reason = RejectedRow::Frozen { joint: 2 };
/// assert_eq!(reason.to_string(), "frozen: the torques of joint 2 contradict the estimate");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum RejectedRow {
    /// The torque or an entry of the row is infinite or not a number.
    NotFinite {
        /// The joint.
        joint: usize,
    },
    /// The numbers exceed 10⁹ standard deviations of the noise.
    TooLarge {
        /// The joint.
        joint: usize,
    },
    /// The row has an entry of a parameter that another joint alone has by `own`.
    OtherJoint {
        /// The joint of the row.
        joint: usize,
    },
    /// The torque is beyond the limit of the innovation.
    Outlier {
        /// The joint.
        joint: usize,
    },
    /// The torques of a joint do not agree with the estimate, which is frozen until they do, or
    /// until that joint rests for long.
    Frozen {
        /// The joint of these torques, which need not be that of the row.
        joint: usize,
    },
}

impl RejectedRow {
    /// Why the numbers of a row are rejected.
    #[cold]
    #[inline(never)]
    pub(super) fn of_numbers<R: Real>(joint: usize, (y, own): (&[R], bool), residual: R) -> Self {
        if !(residual.is_finite() && y.iter().all(|y| y.is_finite())) {
            Self::NotFinite { joint }
        } else if own {
            Self::TooLarge { joint }
        } else {
            Self::OtherJoint { joint }
        }
    }
}

impl fmt::Display for RejectedRow {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { joint } => {
                write!(out, "joint {joint}: its torque or its row is not finite")
            }
            Self::TooLarge { joint } => {
                write!(out, "joint {joint}: its torque or its row is too large")
            }
            Self::OtherJoint { joint } => {
                write!(out, "joint {joint}: its row has a parameter of another joint alone")
            }
            Self::Outlier { joint } => {
                write!(out, "joint {joint}: its torque contradicts the estimate")
            }
            Self::Frozen { joint } => {
                write!(out, "frozen: the torques of joint {joint} contradict the estimate")
            }
        }
    }
}

impl core::error::Error for RejectedRow {}
