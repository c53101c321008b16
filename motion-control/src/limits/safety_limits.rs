//! The limits of each joint, and what is wrong with them.

use core::fmt;

use crate::limits::MotionLimits;
use dynamics_core::model::JointLimits;
use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;

/// The limits of each joint that a [`MotionController`](crate::motion::MotionController) enforces.
///
/// They can be made from the [`JointLimits`] of a robot's description; the rate of the torque is
/// then unlimited:
///
/// ```
/// use motion_control::limits::SafetyLimits;
/// use dynamics_core::model::JointLimits;
/// let joint = JointLimits { lower: -3.1_f32, upper: 3.1, velocity: 3.2, torque: 150.0 };
/// let limits = SafetyLimits::from([joint; 6]).with_rate_share(0.5).with_position_margin(0.1);
/// assert_eq!((limits.rate[0], limits.speed[0], limits.upper[0]), (75.0, 3.2, 3.0));
/// ```
#[doc(alias = "soft limits")]
#[doc(alias = "Bounds")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SafetyLimits<R, const V: usize> {
    /// Greatest |τ|, N·m or N.
    pub torque: [R; V],
    /// Greatest change of τ from one tick to the next, N·m or N.
    pub rate: [R; V],
    /// Greatest |q̇|, rad/s or m/s.
    pub speed: [R; V],
    /// Least position, rad or m.
    pub lower: [R; V],
    /// Greatest position, rad or m.
    pub upper: [R; V],
}

impl<R: Real, const V: usize> From<[JointLimits<R>; V]> for SafetyLimits<R, V> {
    /// The joints' limits, of which none is on the rate of the torque.
    #[inline]
    fn from(limits: [JointLimits<R>; V]) -> Self {
        Self {
            torque: limits.map(|limit| limit.torque),
            rate: [R::ONE / R::ZERO; V],
            speed: limits.map(|limit| limit.velocity),
            lower: limits.map(|limit| limit.lower),
            upper: limits.map(|limit| limit.upper),
        }
    }
}

impl<R: Real> From<JointLimits<R>> for MotionLimits<R> {
    /// The joint's speed, and any acceleration.
    fn from(limits: JointLimits<R>) -> Self {
        Self { velocity: limits.velocity, acceleration: R::ONE / R::ZERO }
    }
}

impl<R: Real, const V: usize> SafetyLimits<R, V> {
    /// The same limits with a rate of the torque, per tick, of this share of the torque limit.
    #[inline]
    pub fn with_rate_share(self, share: R) -> Self {
        Self { rate: self.torque.map(|torque| torque * share), ..self }
    }

    /// The same limits with a range of positions that is smaller by `margin` (rad or m) at both
    /// ends.
    pub fn with_position_margin(self, margin: R) -> Self {
        Self {
            lower: self.lower.map(|lower| lower + margin),
            upper: self.upper.map(|upper| upper - margin),
            ..self
        }
    }

    /// The same limits with speeds of this share of the joints' limits.
    pub fn with_speed_share(self, share: R) -> Self {
        Self { speed: self.speed.map(|speed| speed * share), ..self }
    }

    /// Checks that every limit allows some motion or torque, as
    /// [`crate::motion::MotionController::try_new`] requires.
    ///
    /// Positions, speeds and rates may be unlimited (infinite), torques may not. Zero is a valid
    /// limit, such as of a joint that stays on its brake;
    /// [`MotionControllerConfig::advice`](crate::motion::MotionControllerConfig::advice) names a
    /// rate of zero.
    ///
    /// ```
    /// use motion_control::limits::{LimitKind, SafetyLimits, SafetyLimitsError};
    /// let limits = SafetyLimits { torque: [9.0, -9.0], rate: [1.0; 2], speed: [2.0; 2], lower: [-1.0; 2], upper: [1.0; 2] };
    /// let error = limits.check().unwrap_err();
    /// assert_eq!(error, SafetyLimitsError::Negative { joint: 1, of: LimitKind::Torque, value: -9.0 });
    /// assert_eq!(error.to_string(), "joint 1: its torque limit, -9, is negative");
    /// assert_eq!(error.named(&["shoulder", "elbow"]).to_string(), "joint `elbow`: its torque limit, -9, is negative");
    /// ```
    ///
    /// # Errors
    /// [`SafetyLimitsError`] names the joint, the limit and its value: NaN, negative, infinite for
    /// a torque, or a range of positions that is empty.
    pub fn check(&self) -> Result<(), SafetyLimitsError> {
        let limits = [
            (LimitKind::Torque, &self.torque),
            (LimitKind::Rate, &self.rate),
            (LimitKind::Speed, &self.speed),
        ];
        for (of, limits) in limits {
            for (joint, &limit) in limits.iter().enumerate() {
                let must_be_finite = matches!(of, LimitKind::Torque);
                // False for a NaN, too.
                let allows = limit >= R::ZERO && (!must_be_finite || limit.is_finite());
                if !allows {
                    return Err(refused(joint, of, limit));
                }
            }
        }
        for (joint, (&lower, &upper)) in self.lower.iter().zip(&self.upper).enumerate() {
            let is_range = lower <= upper;
            if !is_range {
                return Err(no_range(joint, lower, upper));
            }
        }
        Ok(())
    }
}

/// Why a limit that allows nothing is refused.
#[cold]
fn refused<R: Real>(joint: usize, of: LimitKind, limit: R) -> SafetyLimitsError {
    let value = limit.to_f64();
    if value.is_nan() {
        SafetyLimitsError::NotANumber { joint, of }
    } else if value < 0.0 {
        SafetyLimitsError::Negative { joint, of, value }
    } else {
        SafetyLimitsError::Infinite { joint, of }
    }
}

/// Why a range of positions is refused.
#[cold]
fn no_range<R: Real>(joint: usize, lower: R, upper: R) -> SafetyLimitsError {
    let (lower, upper) = (lower.to_f64(), upper.to_f64());
    let not_a_number = |of| SafetyLimitsError::NotANumber { joint, of };
    match (lower.is_nan(), upper.is_nan()) {
        (true, _) => not_a_number(LimitKind::LeastPosition),
        (false, true) => not_a_number(LimitKind::GreatestPosition),
        (false, false) => SafetyLimitsError::Empty { joint, lower, upper },
    }
}

/// The quantity that a limit applies to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LimitKind {
    /// The torque.
    Torque,
    /// The torque's change in a tick.
    Rate,
    /// The speed.
    Speed,
    /// The acceleration.
    Acceleration,
    /// The least position.
    LeastPosition,
    /// The greatest position.
    GreatestPosition,
}

impl fmt::Display for LimitKind {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Torque => "torque limit",
            Self::Rate => "torque rate limit",
            Self::Speed => "speed limit",
            Self::Acceleration => "acceleration limit",
            Self::LeastPosition => "least position",
            Self::GreatestPosition => "greatest position",
        })
    }
}

/// The reason why the limits of a joint are rejected: the joint, the limit and its value. Joints
/// are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SafetyLimitsError {
    /// A limit is NaN.
    NotANumber {
        /// The joint.
        joint: usize,
        /// The quantity.
        of: LimitKind,
    },
    /// A limit that has to be finite is infinite: that of a torque.
    Infinite {
        /// The joint.
        joint: usize,
        /// The quantity.
        of: LimitKind,
    },
    /// A limit is negative.
    Negative {
        /// The joint.
        joint: usize,
        /// The quantity.
        of: LimitKind,
        /// The limit, in the unit of the quantity.
        value: f64,
    },
    /// The least position is above the greatest.
    Empty {
        /// The joint.
        joint: usize,
        /// The least position, rad or m.
        lower: f64,
        /// The greatest position, rad or m.
        upper: f64,
    },
    /// The joint is outside the range of positions that is to replace its present one.
    Outside {
        /// The joint.
        joint: usize,
        /// Its position, rad or m.
        position: f64,
    },
    /// The range of a joint that is a circle counts turns: it is more than one, or has one end. See
    /// [`Circles::counted`](crate::limits::Circles::counted).
    CountsTurns {
        /// The joint.
        joint: usize,
        /// The least position, rad.
        lower: f64,
        /// The greatest position, rad.
        upper: f64,
    },
}

impl SafetyLimitsError {
    /// The joint.
    pub const fn joint(&self) -> usize {
        match *self {
            Self::NotANumber { joint, .. }
            | Self::Infinite { joint, .. }
            | Self::Negative { joint, .. }
            | Self::Empty { joint, .. }
            | Self::Outside { joint, .. }
            | Self::CountsTurns { joint, .. } => joint,
        }
    }

    /// The text of the error with the joint's name in place of its number, where `names` has one:
    /// [`Model::coordinate_names`](dynamics_core::model::Model::coordinate_names), or the joints of
    /// an imported robot.
    pub const fn named<'a>(&self, names: &'a [&'a str]) -> impl fmt::Display + 'a {
        ErrorText { error: *self, names }
    }

    fn write_reason(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotANumber { of, .. } => write!(out, "its {of} is not a number"),
            Self::Infinite { of, .. } => {
                write!(out, "its {of} is infinite and has to be finite")
            }
            Self::Negative { of, value, .. } => {
                // The digits that an f32 has: -35.1 and not -35.099998.
                let value = value as f32;
                write!(out, "its {of}, {value}, is negative")
            }
            Self::Empty { lower, upper, .. } => {
                let (lower, upper) = (lower as f32, upper as f32);
                write!(out, "its least position, {lower}, is above its greatest, {upper}")
            }
            Self::Outside { position, .. } => {
                write!(out, "its position, {}, is outside its new range", position as f32)
            }
            Self::CountsTurns { lower, upper, .. } => {
                let (lower, upper) = (lower as f32, upper as f32);
                write!(
                    out,
                    "its range, {lower} to {upper}, counts turns, but its position is a point on a \
                     circle"
                )
            }
        }
    }
}

impl fmt::Display for SafetyLimitsError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "joint {}: ", self.joint())?;
        self.write_reason(out)
    }
}

impl core::error::Error for SafetyLimitsError {}

/// An error with the names of the joints.
struct ErrorText<'a> {
    error: SafetyLimitsError,
    names: &'a [&'a str],
}

impl fmt::Display for ErrorText<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.names.get(self.error.joint()) {
            Some(name) => write!(out, "joint `{name}`: ")?,
            None => write!(out, "joint {}: ", self.error.joint())?,
        }
        self.error.write_reason(out)
    }
}
