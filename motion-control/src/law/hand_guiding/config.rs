//! The configuration of hand guiding.

use crate::entry;
use crate::limits::{ConfigError, ConfigParameter, LimitKind, SafetyLimits, SafetyLimitsError};
use dynamics_core::scalar::Real;

/// The numbers of [`HandGuidingConfig::from_limits`]: the distance of a wall from its bound, rad or
/// m.
const MARGIN: f64 = 0.05;
/// Shares of the joint's speed and torque limits.
const SPEED: f64 = 0.5;
const WALL_TORQUE: f64 = 0.5;
const TORQUE: f64 = 0.25;
/// Free damping of a unit of inertia, 1/s.
const DECAY: f64 = 1.0;
/// Stated excess of the friction model, the compensated share, and the speed of rest, rad/s or m/s.
const ERROR: f64 = 0.1;
const SHARE: f64 = 0.87;
const REST: f64 = 0.005;

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

/// A damper of each joint that acts on what its speed is beyond a limit, with a greatest torque.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SpeedBrake<R, const V: usize> {
    /// Speed limit, rad/s or m/s; infinite for none.
    pub speed: [R; V],
    /// Damping of the speed beyond, N·m·s/rad or N·s/m.
    pub damping: [R; V],
    /// Greatest torque, N·m or N.
    pub torque: [R; V],
}

/// The parameters of [`HandGuiding`](super::HandGuiding).
///
/// [`Self::from_limits`] has all of them from the limits of a robot:
///
/// ```
/// use motion_control::law::{HandGuiding, HandGuidingConfig};
/// use dynamics_core::{model::Robot, robots::Ur5e};
/// let limits = Ur5e::MODEL.to_f32().links.map(|link| link.limits);
/// let inertia = [4.5, 4.5, 2.0, 0.3, 0.3, 0.26]; // the largest diagonal of M, rotors included
/// let config = HandGuidingConfig::from_limits(limits, &inertia, 30.0)?;
/// let guiding = HandGuiding::try_new(HandGuidingConfig { rest_speed: [0.002; 6], ..config })?;
/// assert_eq!(guiding.locked(), [false; 6]);
/// assert!((config.upper[2] - (limits[2].upper - 0.05)).abs() < 1e-6);
/// assert_eq!(config.brake.speed[0], 0.5 * limits[0].velocity);
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
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
    /// Damping of free joints at every speed up to that of the brake, N·m·s/rad or N·s/m: without
    /// friction a released joint of inertia M coasts M q̇ / D.
    pub damping: [R; V],
    /// The brake of free joints that are too fast.
    pub brake: SpeedBrake<R, V>,
    /// Position of each joint's lower wall, rad or m; −∞ for none.
    pub lower: [R; V],
    /// Position of each joint's upper wall, rad or m; ∞ for none.
    pub upper: [R; V],
    /// The walls. A joint of inertia M comes to rest before its wall from every speed if D² ≥ 4 K M
    /// and τ_max ≥ q̇ √(K M) / e; it is braked from the distance q̇ D/K on.
    pub wall: LimitedSpring<R, V>,
    /// The spring and damper that hold locked joints.
    pub lock: LimitedSpring<R, V>,
}

impl<R: Real, const V: usize> HandGuidingConfig<R, V> {
    /// The configuration from the limits of the joints, such as [`JointLimits`] or those of the
    /// supervisor, the largest inertia of each joint (kg·m² or kg, rotors included, as for
    /// [`Gains::from_inertia`]) and the bandwidth of the observer of this law, rad/s.
    ///
    /// [`JointLimits`]: dynamics_core::model::JointLimits
    /// [`Gains::from_inertia`]: crate::law::Gains::from_inertia
    ///
    /// | number | value |
    /// |---|---|
    /// | walls | 0.05 rad or m inside the limits of position, with half of the torque limit |
    /// | stiffness K, damping D of walls and locks | M p² and 2 M p, with p an eighth of the observer's bandwidth, or less, so that a wall's torque stops the joint from its speed limit |
    /// | speed limit, damping of the brake | half of the joint's; M p with a quarter of the torque limit |
    /// | damping of free joints | M times 1/s: a joint that is released at 1 rad/s coasts at most 1 rad |
    /// | compensation of friction | 0.87 of a model that is at most 10 % above the friction, from 0.005 rad/s on, up to a quarter of the torque limit |
    ///
    /// A hand that pushes a joint by more than K times 0.05 rad into its wall leads it out of its
    /// bounds: a faster observer makes stiffer walls.
    ///
    /// # Errors
    /// [`ConfigError`]: of the limits, of a speed or a torque that is infinite or zero, of an
    /// inertia or the bandwidth that is not a positive number, of a range that leaves no space
    /// between the walls.
    pub fn from_limits(
        limits: impl Into<SafetyLimits<R, V>>,
        inertia: &[R; V],
        bandwidth: R,
    ) -> Result<Self, ConfigError> {
        let limits: SafetyLimits<R, V> = limits.into();
        limits.check()?;
        ConfigParameter::Bandwidth.positive(bandwidth)?;
        if let Some(joint) = limits.speed.iter().position(|speed| !speed.is_finite()) {
            return Err(SafetyLimitsError::Infinite { joint, of: LimitKind::Speed }.into());
        }
        for (speed, torque) in limits.speed.iter().zip(&limits.torque) {
            ConfigParameter::GuidingSpeed.positive(*speed)?;
            ConfigParameter::Wall.positive(*torque)?;
        }
        for inertia in inertia {
            ConfigParameter::Inertia.positive(*inertia)?;
        }
        let of = |share: f64, all: &[R; V]| all.map(|x| R::from_f64(share) * x);
        let most = of(WALL_TORQUE, &limits.torque);
        // p: by the observer, and by the torque that a wall has, M p q̇ / e.
        let rate = |i| {
            let by_observer = R::from_f64(0.125) * bandwidth;
            let by_torque = R::from_f64(core::f64::consts::E) * entry(&most, i)
                / (entry(inertia, i) * entry(&limits.speed, i));
            if by_torque < by_observer { by_torque } else { by_observer }
        };
        let damping: [R; V] = core::array::from_fn(|i| rate(i) * entry(inertia, i));
        let wall = LimitedSpring {
            stiffness: core::array::from_fn(|i| rate(i) * entry(&damping, i)),
            damping: damping.map(|d| d + d),
            torque: most,
        };
        let walls = limits.with_position_margin(R::from_f64(MARGIN));
        let config = Self {
            error: R::from_f64(ERROR),
            share: R::from_f64(SHARE),
            rest_speed: [R::from_f64(REST); V],
            compensation: of(TORQUE, &limits.torque),
            damping: of(DECAY, inertia),
            brake: SpeedBrake {
                speed: of(SPEED, &limits.speed),
                damping,
                torque: of(TORQUE, &limits.torque),
            },
            lower: walls.lower,
            upper: walls.upper,
            wall,
            lock: wall,
        };
        config.check().map(|()| config)
    }

    /// Checks that σ (1 + ε) ≤ 1, that each lower wall is below the upper one, that a wall with a
    /// damping has a stiffness, that all other numbers are finite and not negative (but the speed
    /// limit of a brake, which may be infinite), and that no speed of rest is zero.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    ///
    /// ```
    /// use motion_control::law::{HandGuidingConfig, LimitedSpring, SpeedBrake};
    /// use motion_control::limits::{ConfigError, ConfigParameter};
    /// let spring = LimitedSpring { stiffness: [100.0_f32], damping: [10.0], torque: [5.0] };
    /// let config = HandGuidingConfig {
    ///     error: 0.1, share: 1.0, rest_speed: [0.01], compensation: [4.0], damping: [0.5],
    ///     brake: SpeedBrake { speed: [1.0], damping: [5.0], torque: [5.0] },
    ///     lower: [-1.0], upper: [1.0], wall: spring, lock: spring,
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
        ConfigParameter::FreeDamping.require(self.damping.into_iter().all(not_negative))?;
        let SpeedBrake { speed, damping, torque } = &self.brake;
        let limits = speed.iter().all(|speed| *speed >= R::ZERO);
        let brakes = damping.iter().chain(torque).copied().all(not_negative);
        ConfigParameter::GuidingSpeed.require(limits & brakes)?;
        let mut walls = self.lower.iter().zip(&self.upper);
        ConfigParameter::WallPosition.require(walls.all(|(lower, upper)| lower < upper))?;
        for (spring, parameter) in
            [(&self.wall, ConfigParameter::Wall), (&self.lock, ConfigParameter::Lock)]
        {
            let LimitedSpring { stiffness, damping, torque } = spring;
            let numbers = stiffness.iter().chain(damping).chain(torque);
            parameter.require(numbers.copied().all(not_negative))?;
        }
        // A damper without a spring would brake wherever the joint is.
        let mut dampers = self.wall.damping.iter().zip(&self.wall.stiffness);
        let springs =
            dampers.all(|(damping, stiffness)| (damping <= stiffness) | (*stiffness > R::ZERO));
        ConfigParameter::Wall.require(springs)
    }
}
