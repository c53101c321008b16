//! The errors of a configuration.

use core::fmt;

use crate::limits::SafetyLimitsError;
use dynamics_core::scalar::Real;

/// The reason why a configuration is rejected.
///
/// ```
/// use motion_control::estimate::{Observer, ObserverConfig};
/// use motion_control::limits::{ConfigError, ConfigParameter};
/// let error = Observer::<f32, 6>::try_new(ObserverConfig { bandwidth: 250.0, tick: 0.0 }).unwrap_err();
/// assert_eq!(error, ConfigError::OutOfRange { parameter: ConfigParameter::Tick });
/// assert_eq!(error.to_string(), "the length of a tick is not a positive number");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ConfigError {
    /// A limit of a joint allows no motion or torque: the joint, the limit and its value.
    Limits(SafetyLimitsError),
    /// A number that holds for all joints is outside its range.
    OutOfRange {
        /// Which number.
        parameter: ConfigParameter,
    },
}

/// A number in a configuration that holds for all joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ConfigParameter {
    /// The nominal length of a tick.
    Tick,
    /// The bandwidth of the observer.
    Bandwidth,
    /// The rate at which the speed of a held arm decays.
    DecayRate,
    /// The margin of a contact detector.
    ContactMargin,
    /// The distance that an arm goes back after a contact.
    RetractDistance,
    /// The speed or the acceleration at which it goes back.
    RetractLimit,
    /// The damping of an arm that floats.
    FloatDamping,
    /// The speed beyond which an arm that floats is decelerated.
    FloatSpeed,
    /// The ticks without a contact after which an arm may be reset.
    ReleaseTicks,
    /// The largest force or couple that a contact is expected to have.
    WrenchSize,
    /// The share by which the friction model of hand guiding may exceed the friction.
    FrictionError,
    /// The share of the modelled friction that hand guiding compensates.
    CompensatedShare,
    /// The speed below which hand guiding compensates no friction.
    RestSpeed,
    /// The greatest compensation of friction in hand guiding.
    Compensation,
    /// The deceleration at which limits of speed fall.
    Deceleration,
    /// The damping of joints that a hand moves.
    FreeDamping,
    /// The speed limit of hand guiding, or the damping or the greatest torque of its brake.
    GuidingSpeed,
    /// The largest inertia of a joint.
    Inertia,
    /// The static friction, the least sliding friction, the energy or the greatest speed of a joint
    /// that is pushed out of its friction.
    Stiction,
    /// The shares of static friction of push and dither, or the compensated share of friction.
    BreakawayShare,
    /// The ticks of a standstill, of a push, or of half a period of a dither.
    BreakawayTicks,
    /// The ticks of the change from one law to another.
    HandOverTicks,
    /// The positions of a joint's virtual walls.
    WallPosition,
    /// The stiffness, the damping or the greatest torque of a virtual wall.
    Wall,
    /// The stiffness, the damping or the greatest torque that holds a locked joint.
    Lock,
    /// The amplification of external torques that shapes the inertia.
    Amplification,
    /// The dead band, the damping or the greatest torque of a joint whose inertia is shaped.
    ShapedJoint,
    /// A limit of velocity, acceleration or jerk.
    JerkLimit {
        /// The joint, from 0.
        joint: usize,
    },
    /// A position at which a reference is at rest.
    RestPosition,
    /// The spacing of the way-points of a path.
    PathSpacing,
    /// A stiffness of an impedance.
    Stiffness,
    /// The damping ratio of an impedance.
    DampingRatio,
    /// The slowest mode of an impedance that has the full damping ratio.
    SlowestMode,
    /// The step of the encoders, which may be zero.
    Resolution,
    /// The greatest distance from the trajectory at a restart, which may be infinite.
    RestartDistance,
    /// The standard deviation of a torque.
    TorqueNoise,
    /// The standard deviation of a load's parameter before the first measurement.
    PriorDeviation,
    /// The standard deviation of an arm's parameter before the first measurement.
    ParameterDeviation,
    /// The numbers of parameters that one joint alone has.
    OwnParameters,
    /// The share of the information that is forgotten.
    Forgetting,
    /// The greatest innovation of an estimator, in standard deviations.
    InnovationLimit,
    /// The continuous or peak torque of a motor, against each other and the limits of the gate.
    ThermalTorque {
        /// The joint, from 0.
        joint: usize,
    },
    /// A thermal time constant, a share of resistance or a temperature of a motor.
    ThermalMotor {
        /// The joint, from 0.
        joint: usize,
    },
    /// The damping, the length, the posture or its gain of a tip's motion.
    TipMotion,
    /// The range of a joint, its position in it, or its greatest speed or acceleration.
    JointRange {
        /// The joint, from 0.
        joint: usize,
    },
}

impl ConfigParameter {
    /// Accepts a finite number greater than zero.
    pub(crate) fn positive<R: Real>(self, x: R) -> Result<(), ConfigError> {
        self.require(x.is_finite() & (x > R::ZERO))
    }

    pub(crate) fn require(self, holds: bool) -> Result<(), ConfigError> {
        if holds { Ok(()) } else { Err(ConfigError::OutOfRange { parameter: self }) }
    }
}

impl From<SafetyLimitsError> for ConfigError {
    fn from(error: SafetyLimitsError) -> Self {
        Self::Limits(error)
    }
}

impl fmt::Display for ConfigError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parameter = match self {
            Self::Limits(error) => return error.fmt(out),
            Self::OutOfRange { parameter } => parameter,
        };
        out.write_str(match parameter {
            ConfigParameter::Tick => "the length of a tick is not a positive number",
            ConfigParameter::Bandwidth => "the bandwidth of the observer is not a positive number",
            ConfigParameter::DecayRate => "the decay rate of a held arm is not a positive number",
            ConfigParameter::ContactMargin => {
                "a margin of the contact detector is not a positive number"
            }
            ConfigParameter::RetractDistance => {
                "the distance back from a contact is not a positive number"
            }
            ConfigParameter::RetractLimit => {
                "the speed or the acceleration back from a contact is not a positive number"
            }
            ConfigParameter::FloatDamping => {
                "the damping of a floating arm is not a positive number"
            }
            ConfigParameter::FloatSpeed => "the speed of a floating arm is not a positive number",
            ConfigParameter::ReleaseTicks => "an arm would be released in the tick of its contact",
            ConfigParameter::WrenchSize => {
                "the largest force is not a positive number, or the largest couple a negative one"
            }
            ConfigParameter::FrictionError => "the error of the friction is negative or not finite",
            ConfigParameter::CompensatedShare => {
                "the compensated share of the friction is negative, or exceeds it at its stated \
                 error"
            }
            ConfigParameter::RestSpeed => "a speed of rest is not a positive number",
            ConfigParameter::Compensation => {
                "a greatest compensation of friction is negative or not finite"
            }
            ConfigParameter::Deceleration => "a deceleration is not a number greater than zero",
            ConfigParameter::FreeDamping => "a damping of free joints is negative or not finite",
            ConfigParameter::GuidingSpeed => {
                "a number of the speed limit of hand guiding is negative, or none of a joint"
            }
            ConfigParameter::Stiction => {
                "a friction, an energy or a greatest speed is negative or not finite"
            }
            ConfigParameter::BreakawayShare => {
                "a share of the static friction is not at least 0 and less than 1, or that of the \
                 compensation not between 0 and 1"
            }
            ConfigParameter::BreakawayTicks => "a standstill, a push or a dither has no ticks",
            ConfigParameter::HandOverTicks => "the change to another law has no ticks",
            ConfigParameter::Inertia => "an inertia of a joint is not a positive number",
            ConfigParameter::WallPosition => "a lower wall is not below the upper one",
            ConfigParameter::Wall => {
                "a number of a virtual wall is negative or not finite, or it damps without a spring"
            }
            ConfigParameter::Lock => "a number of a lock is negative or not finite",
            ConfigParameter::Amplification => "the amplification is negative or not finite",
            ConfigParameter::ShapedJoint => {
                "a number of a joint whose inertia is shaped is negative or not finite"
            }
            ConfigParameter::JerkLimit { .. } => {
                "a limit of velocity, acceleration or jerk is not within 1e-9 and 1e9"
            }
            ConfigParameter::RestPosition => "a position of rest is not finite",
            ConfigParameter::PathSpacing => "a spacing of way-points is not a positive number",
            ConfigParameter::Stiffness => "a stiffness of the impedance is not a positive number",
            ConfigParameter::DampingRatio => "the damping ratio is not a positive number",
            ConfigParameter::SlowestMode => "the slowest mode is not a positive number",
            ConfigParameter::Resolution => "the step of the encoders is negative or not finite",
            ConfigParameter::RestartDistance => "the restart distance is negative or not a number",
            ConfigParameter::TorqueNoise => {
                "a standard deviation of the torques is not between 1e-6 and 1e6"
            }
            ConfigParameter::PriorDeviation => {
                "a standard deviation of the prior is not between 1e-6 and 1e6"
            }
            ConfigParameter::ParameterDeviation => {
                "a standard deviation of the prior is not between 1e-12 and 1e6"
            }
            ConfigParameter::OwnParameters => "the joints have more parameters than there are",
            ConfigParameter::Forgetting => "the share to forget is not at least 0 and less than 1",
            ConfigParameter::InnovationLimit => {
                "the limit of innovations is not between 3 and 1000"
            }
            ConfigParameter::ThermalTorque { .. } => {
                "a continuous torque is not a positive number, or is above the peak, or the peak \
                 above the limit of torque, or the rate of the torque too low"
            }
            ConfigParameter::ThermalMotor { .. } => {
                "a thermal time, share or temperature of a motor is outside its range"
            }
            ConfigParameter::TipMotion => {
                "a damping or length is not a positive number, or a posture or its gain not finite"
            }
            ConfigParameter::JointRange { .. } => {
                "a range of a joint is empty, a position not finite, or a limit not positive"
            }
        })
    }
}

impl core::error::Error for ConfigError {}
