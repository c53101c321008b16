//! The configuration of hand guiding.

use crate::limits::{ConfigError, ConfigParameter};
use dynamics_core::scalar::Real;

/// A spring and a damper of each joint with a greatest torque; a stiffness and a damping may be
/// zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LimitedSpring<R, const V: usize> {
    /// Stiffness K, N·m/rad or N/m.
    pub stiffness: [R; V],
    /// Damping D, N·m·s/rad or N·s/m.
    pub damping: [R; V],
    /// Greatest torque τ_max, N·m or N.
    pub torque: [R; V],
}

/// The parameters of [`HandGuiding`](super::HandGuiding).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HandGuidingConfig<R, const V: usize> {
    /// ε: the modelled friction exceeds the true friction at most by this share of it.
    pub error: R,
    /// σ: the share of the modelled friction that is compensated, at most 1/(1 + ε).
    pub share: R,
    /// v₀, rad/s or m/s: joints whose estimated speed is below are at rest, and nothing is
    /// compensated; from twice this speed on it is in full. Above what the noise of the encoders
    /// becomes in the velocities, an arm at rest has steady torques.
    pub rest_speed: [R; V],
    /// The greatest compensation of each joint, N·m or N: of a velocity that is wrong, no more is
    /// compensated.
    pub compensation: [R; V],
    /// Position of each joint's lower wall, rad or m; −∞ for none.
    pub lower: [R; V],
    /// Position of each joint's upper wall, rad or m; ∞ for none.
    pub upper: [R; V],
    /// The walls.
    pub wall: LimitedSpring<R, V>,
    /// The spring and damper that hold locked joints.
    pub lock: LimitedSpring<R, V>,
}

impl<R: Real, const V: usize> HandGuidingConfig<R, V> {
    /// Checks that σ (1 + ε) ≤ 1, that each lower wall is below the upper one, and that all other
    /// numbers are finite and not negative, and that no speed of rest is zero.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    ///
    /// ```
    /// use motion_control::{ConfigError, ConfigParameter, HandGuidingConfig, LimitedSpring};
    /// let spring = LimitedSpring { stiffness: [100.0_f32], damping: [10.0], torque: [5.0] };
    /// let config = HandGuidingConfig {
    ///     error: 0.1, share: 1.0, rest_speed: [0.01], compensation: [4.0], lower: [-1.0], upper: [1.0], wall: spring, lock: spring,
    /// };
    /// let error = ConfigError::OutOfRange { parameter: ConfigParameter::CompensatedShare };
    /// assert_eq!(config.check(), Err(error));
    /// assert_eq!(HandGuidingConfig { share: 1.0 / 1.1, ..config }.check(), Ok(()));
    /// ```
    pub fn check(&self) -> Result<(), ConfigError> {
        let Self { error, share, .. } = *self;
        let not_negative = |x: R| x.is_finite() & (x >= R::ZERO);
        ConfigParameter::FrictionError.require(not_negative(error))?;
        let most = R::ONE + R::EPSILON; // σ = 1/(1 + ε) may be rounded up
        let passive = not_negative(share) & (share * (R::ONE + error) <= most);
        ConfigParameter::CompensatedShare.require(passive)?;
        for speed in self.rest_speed {
            ConfigParameter::RestSpeed.positive(speed)?;
        }
        ConfigParameter::Compensation.require(self.compensation.into_iter().all(not_negative))?;
        let mut walls = self.lower.iter().zip(&self.upper);
        ConfigParameter::WallPosition.require(walls.all(|(lower, upper)| lower < upper))?;
        for (spring, parameter) in
            [(&self.wall, ConfigParameter::Wall), (&self.lock, ConfigParameter::Lock)]
        {
            let LimitedSpring { stiffness, damping, torque } = spring;
            let numbers = stiffness.iter().chain(damping).chain(torque);
            parameter.require(numbers.copied().all(not_negative))?;
        }
        Ok(())
    }
}
