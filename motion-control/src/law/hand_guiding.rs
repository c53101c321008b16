//! Hand guiding of an arm without torque sensors: friction compensation that stays passive, damping,
//! a speed limit, virtual walls, locked joints.
//!
//! The torque follows from the modelled friction F̂, which exceeds the true friction F at most by
//! the share ε, and from the errors e of the torques that this one is added to:
//!
//! ```text
//! τ_c = s max(σ |F̂| − e, 0) sgn F̂      σ (1 + ε) ≤ 1      ⟹  |τ_c| + e ≤ |F| wherever e ≤ σ |F̂|
//! s = |q̇|/v₀ − 1, limited to 0 and 1
//! τ_d = −D_f clamp(q̇, ±v) − clamp(D_b (q̇ − clamp(q̇, ±v)), ±τ_b)
//! τ_w = −clamp(K d + D max(ḋ, 0), 0, τ_max) along the outward normal, d the depth in the wall
//! τ_l = K (q_l − q) − D q̇, limited to ±τ_max
//! ```
//!
//! A wall brakes before it, from the distance −d = ḋ D/K on: there the spring and the damper are
//! those of a joint that enters with q̈ = 0. With D² ≥ 4 K M the inertia M then comes to rest at d ≤
//! 0 from every speed, since with the poles −p₁ and −p₂, p₁ < p₂, d(t) = −a e^(−p₁ t) + b e^(−p₂ t)
//! and a > b > 0. For D = 2 M p and K = M p² the greatest torque of the way is M p ḋ / e, and the
//! way is 1.5 times the shortest one of this torque.
//!
//! No acceleration is needed. Colgate & Schenkel (1997) have the passivity of walls in discrete
//! time; Armstrong-Hélouvry, Dupont & Canudas de Wit (1994) the compensation of friction and its
//! limit cycles.

use crate::entry;
use crate::estimate::Estimate;
use crate::limits::{Circles, ConfigError, Fault};
use dynamics_core::scalar::Real;
use dynamics_core::state::manifold::nearest_turn;

mod config;
#[cfg(test)]
mod tests;

pub use config::{HandGuidingConfig, LimitedSpring, SpeedBrake};

/// The law of an arm that a hand moves: torques to add to the compensation of gravity.
///
/// - **Friction** is compensated in part, and never by more than there is: with a model that
///   over-estimates it at most by the stated share, the power of compensation and true friction
///   together is nowhere positive. True friction whose sign is steeper than that of the model, or
///   which sticks, exceeds the model near rest, where it is then compensated less; a true sign that
///   is wider than that of the model would not be.
/// - **Damping** acts on free joints always, and a stronger one with a limited torque on those that
///   are faster than their limit.
/// - **Walls** at bounds of the joints push back and never pull; their damping acts only on motion
///   into them, which they brake before the wall as early as its speed needs.
/// - **Locked joints** are held where they were locked, and their friction is not compensated.
///
/// Joints that are circles ([`Self::on_circles`]) are held and pushed by the short way.
///
/// Directions of the tip are locked by a [`CartesianImpedance`](crate::law::CartesianImpedance) of
/// these directions alone.
///
/// ```
/// use motion_control::estimate::Estimate;
/// use motion_control::law::{HandGuiding, HandGuidingConfig, LimitedSpring, SpeedBrake};
/// use dynamics_core::effects::{Coulomb, Gravity, Viscous, Width};
/// use dynamics_core::{Engine, robots::Ur5e, state::State};
/// let mut guiding = HandGuiding::try_new(HandGuidingConfig {
///     error: 0.1,
///     share: 0.85,
///     rest_speed: [0.004; 6],
///     compensation: [12.0_f32, 12.0, 9.0, 2.0, 2.0, 1.6],
///     damping: [0.0; 6],
///     brake: SpeedBrake { speed: [1.5; 6], damping: [20.0; 6], torque: [10.0; 6] },
///     lower: [-3.0; 6],
///     upper: [3.0; 6],
///     wall: LimitedSpring { stiffness: [300.0; 6], damping: [20.0; 6], torque: [40.0; 6] },
///     lock: LimitedSpring { stiffness: [300.0; 6], damping: [20.0; 6], torque: [20.0; 6] },
/// })?;
/// let estimate = Estimate { q: [0.0, -1.57, 1.57, -1.57, -1.57, 0.0], qd: [0.1; 6] };
/// guiding.lock(&[false, false, false, false, false, true], &estimate.q)?;
/// // In each tick:
/// let at = State { qd: estimate.qd, ..State::at(estimate.q) };
/// let coulomb = Coulomb { torque: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2], width: Width::new(0.01) };
/// let gravity = Engine::<Ur5e>::rnea(&at, &Gravity::EARTH);
/// let friction = Engine::<Ur5e>::rnea(&at, &(Viscous([12.0, 12.0, 8.0, 2.0, 2.0, 1.5]), coulomb));
/// let guide = guiding.torque(&estimate, &friction, &gravity.map(|g| 0.03 * g));
/// let tau: [f32; 6] = core::array::from_fn(|i| gravity[i] + guide[i]); // to the supervisor
/// assert!((guide[0] - 0.85 * (12.0 * 0.1 + 8.0)).abs() < 1e-4 && guide[5] < 0.0);
/// # let _ = tau;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "hand guiding")]
#[doc(alias = "lead-through")]
#[doc(alias = "kinesthetic teaching")]
#[doc(alias = "free drive")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandGuiding<R, const V: usize, const CIRCLES: u128 = 0> {
    config: HandGuidingConfig<R, V>,
    /// 1/v₀.
    rest_inv: [R; V],
    /// The places of locked joints.
    held: [Option<R>; V],
}

impl<R: Real, const V: usize> HandGuiding<R, V> {
    /// The law of this configuration, with no joint locked.
    ///
    /// # Errors
    /// [`ConfigError`], as [`HandGuidingConfig::check`].
    pub fn try_new(config: HandGuidingConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self {
            config,
            rest_inv: config.rest_speed.map(|speed| R::ONE / speed),
            held: [None; V],
        })
    }

    /// The same law for joints of which those of [`Circles::bits`] are points on a circle: walls
    /// within a turn push towards the nearest end of their range, and a lock pulls the short way.
    ///
    /// # Errors
    /// [`ConfigError::Limits`] if walls of a circle count turns.
    pub fn on_circles<const CIRCLES: u128>(
        self,
    ) -> Result<HandGuiding<R, V, CIRCLES>, ConfigError> {
        let Self { config, rest_inv, held } = self;
        Circles::from_bits(CIRCLES).check_ranges(&config.lower, &config.upper)?;
        Ok(HandGuiding { config, rest_inv, held })
    }
}

impl<R: Real, const V: usize, const CIRCLES: u128> HandGuiding<R, V, CIRCLES> {
    /// Which joints are locked.
    pub fn locked(&self) -> [bool; V] {
        self.held.map(|held| held.is_some())
    }

    /// Locks these joints and no others: joints that were free are held at the positions q, rad or
    /// m, joints that were locked remain where they are held.
    ///
    /// # Errors
    /// [`Fault::NotFinite`] names the first joint to be locked whose position is not finite;
    /// nothing is changed then.
    ///
    /// ```
    /// # use motion_control::law::{HandGuiding, HandGuidingConfig, LimitedSpring, SpeedBrake};
    /// # use motion_control::limits::Fault;
    /// # let spring = LimitedSpring { stiffness: [100.0; 2], damping: [10.0; 2], torque: [5.0; 2] };
    /// # let mut guiding = HandGuiding::<f32, 2>::try_new(HandGuidingConfig {
    /// #     error: 0.1, share: 0.8, rest_speed: [0.01; 2], compensation: [2.0; 2], lower: [-1.0; 2], upper: [1.0; 2],
    /// #     damping: [0.0; 2], brake: SpeedBrake { speed: [1.0; 2], damping: [5.0; 2], torque: [5.0; 2] },
    /// #     wall: spring, lock: spring,
    /// # })?;
    /// guiding.lock(&[false, true], &[0.0, 0.5])?;
    /// assert_eq!(guiding.locked(), [false, true]);
    /// assert_eq!(guiding.lock(&[true, true], &[f32::NAN, 0.7]), Err(Fault::NotFinite { joint: 0 }));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn lock(&mut self, joints: &[bool; V], q: &[R; V]) -> Result<(), Fault> {
        let mut wanted = joints.iter().zip(q);
        if let Some(joint) = wanted.position(|(lock, q)| *lock & !q.is_finite()) {
            return Err(Fault::NotFinite { joint });
        }
        for ((held, lock), q) in self.held.iter_mut().zip(joints).zip(q) {
            *held = lock.then_some(held.unwrap_or(*q));
        }
        Ok(())
    }

    /// Replaces the configuration between two ticks, such as by one of
    /// [`HandGuidingConfig::from_limits`] with the limits that the supervisor takes from
    /// [`MotionController::set_limits`](crate::motion::MotionController::set_limits): walls, speed
    /// limit and damping then hold at once. Locked joints stay where they are held. Returns whether
    /// it is another one than before, whose torque goes on from the present one by
    /// [`HandOver::begin`](crate::law::HandOver::begin).
    ///
    /// # Errors
    /// [`ConfigError`], as [`Self::try_new`] and [`Self::on_circles`]; nothing is changed then.
    ///
    /// ```
    /// # use motion_control::law::{HandGuiding, HandGuidingConfig, HandOver};
    /// # use motion_control::limits::SafetyLimits;
    /// # let limits = SafetyLimits { torque: [60.0], rate: [60.0], speed: [3.0], lower: [-2.0], upper: [2.0] };
    /// let config = |limits| HandGuidingConfig::from_limits(limits, &[2.0_f64], 30.0);
    /// let mut guiding = HandGuiding::try_new(config(limits)?)?;
    /// let mut hand_over = HandOver::<f64, 1>::try_new(50)?;
    /// // The door is open: controller.set_limits(&slow, 2.0)? in each tick, and
    /// let slow = limits.with_speed_share(0.2);
    /// if guiding.set_config(config(slow)?)? {
    ///     hand_over.begin();
    /// }
    /// assert_eq!(guiding.set_config(config(slow)?), Ok(false)); // in the next tick
    /// # Ok::<(), motion_control::limits::ConfigError>(())
    /// ```
    pub fn set_config(&mut self, config: HandGuidingConfig<R, V>) -> Result<bool, ConfigError> {
        let HandGuiding { config, rest_inv, .. } = HandGuiding::try_new(config)?;
        Circles::from_bits(CIRCLES).check_ranges(&config.lower, &config.upper)?;
        let changed = self.config != config;
        (self.config, self.rest_inv) = (config, rest_inv);
        Ok(changed)
    }

    /// The torques to add to the compensation of gravity, N·m or N: finite whatever the arguments
    /// are.
    ///
    /// `friction` is F̂, [`rnea`](dynamics_core::algorithms::rnea()) under the friction of the
    /// scene alone at the estimated velocities. `errors` bound how far the other torques are off,
    /// for example 3 % of gravity: by so much less is friction compensated, so that a released arm
    /// comes to rest. Their sign does not count.
    ///
    /// A velocity that is not finite counts as zero; without a finite position there is neither
    /// wall nor lock, without finite friction and errors no compensation. Friction that does not
    /// oppose the velocity is not compensated.
    ///
    /// # Cost
    /// By count: some 15 flops a joint, 25 more where it is faster than its limit or at a wall.
    ///
    /// ```
    /// # use motion_control::estimate::Estimate;
    /// # use motion_control::law::{HandGuiding, HandGuidingConfig, LimitedSpring, SpeedBrake};
    /// # let spring = LimitedSpring { stiffness: [100.0], damping: [10.0], torque: [5.0] };
    /// # let guiding = HandGuiding::<f64, 1>::try_new(HandGuidingConfig {
    /// #     error: 0.25, share: 0.8, rest_speed: [0.01], compensation: [4.0], lower: [-1.0], upper: [1.0],
    /// #     damping: [0.0], brake: SpeedBrake { speed: [1.0], damping: [5.0], torque: [5.0] },
    /// #     wall: spring, lock: spring,
    /// # })?;
    /// let torque = |q, qd, friction, error| guiding.torque(&Estimate { q: [q], qd: [qd] }, &[friction], &[error])[0];
    /// assert_eq!(torque(0.0, 0.1, 2.5, 0.5), 1.5); // 0.8 · 2.5 − 0.5
    /// assert_eq!(torque(0.0, f64::NAN, f64::NAN, 0.5), 0.0);
    /// assert!((torque(1.01, 0.1, 0.0, 0.0) + 2.0).abs() < 1e-12); // spring and damper
    /// assert!((torque(1.01, -0.1, 0.0, 0.0) + 1.0).abs() < 1e-12); // the spring alone
    /// assert_eq!(torque(1.2, 0.1, 0.0, 0.0), -5.0);
    /// assert!((torque(0.95, 0.6, 0.0, 0.0) + 1.0).abs() < 1e-12); // fast towards the wall
    /// assert!((torque(0.0, 1.2, 0.0, 0.0) + 1.0).abs() < 1e-12); // beyond the speed limit
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn torque(&self, estimate: &Estimate<R, V>, friction: &[R; V], errors: &[R; V]) -> [R; V] {
        core::array::from_fn(|i| {
            let q = entry(&estimate.q, i);
            let qd = finite(entry(&estimate.qd, i));
            let law = match self.held.get(i).copied().flatten() {
                Some(held) => self.config.lock.pull(i, off::<_, CIRCLES>(i, held, q), qd),
                None => {
                    let free = self.compensation(i, qd, entry(friction, i), entry(errors, i));
                    free + self.damper(i, qd)
                }
            };
            law + self.walls(i, q, qd)
        })
    }

    /// The walls of a joint. Most ticks have none: then neither its positions nor the way that
    /// its speed needs reach one, and nothing has to be limited.
    #[inline(always)]
    fn walls(&self, i: usize, q: R, qd: R) -> R {
        let HandGuidingConfig { lower, upper, wall, .. } = &self.config;
        let [lower, upper] = [entry(lower, i), entry(upper, i)];
        let q = if Circles::from_bits(CIRCLES).has(i) {
            nearest_turn(q, R::from_f64(0.5) * (lower + upper))
        } else {
            q
        };
        let [below, above] = [lower - q, q - upper];
        let ahead = if qd > R::ZERO { above } else { below };
        let brake = entry(&wall.stiffness, i) * ahead + entry(&wall.damping, i) * qd.abs();
        if (brake > R::ZERO) | (below > R::ZERO) | (above > R::ZERO) {
            wall.push(i, below, -qd) - wall.push(i, above, qd)
        } else {
            R::ZERO
        }
    }

    /// The damping of a free joint, and the brake beyond its speed limit.
    #[inline(always)]
    fn damper(&self, i: usize, qd: R) -> R {
        let brake = &self.config.brake;
        let (limit, damping) = (entry(&brake.speed, i), entry(&self.config.damping, i));
        if qd.abs() <= limit {
            return -finite(damping * qd);
        }
        let (slow, most) = (qd.clamped(-limit, limit), entry(&brake.torque, i));
        let brakes = (entry(&brake.damping, i) * (slow - qd)).clamped(-most, most);
        brakes - finite(damping * slow)
    }

    /// σ F̂, less the errors, towards zero.
    #[inline(always)]
    fn compensation(&self, i: usize, qd: R, friction: R, error: R) -> R {
        let moves = qd.abs() * entry(&self.rest_inv, i) - R::ONE;
        let share = self.config.share * friction;
        let tau = share.abs() - error.abs();
        // False for NaN, too.
        if !((moves > R::ZERO) & (tau > R::ZERO) & (share * qd > R::ZERO) & tau.is_finite()) {
            return R::ZERO;
        }
        let most = entry(&self.config.compensation, i);
        let tau = if tau < most { tau } else { most };
        let tau = if moves < R::ONE { moves * tau } else { tau };
        if qd > R::ZERO { tau } else { -tau }
    }
}

/// q_l − q, of a circle the short way.
#[inline(always)]
fn off<R: Real, const CIRCLES: u128>(i: usize, held: R, q: R) -> R {
    if Circles::from_bits(CIRCLES).has(i) { nearest_turn(held, q) - q } else { held - q }
}

impl<R: Real, const V: usize> LimitedSpring<R, V> {
    /// K (q_l − q) − D q̇, limited.
    #[inline(always)]
    fn pull(&self, i: usize, off: R, qd: R) -> R {
        let most = entry(&self.torque, i);
        finite(entry(&self.stiffness, i) * off - entry(&self.damping, i) * qd).clamped(-most, most)
    }

    /// K d + D max(ḋ, 0), limited and never negative; the depth d is negative before the wall.
    #[inline(always)]
    fn push(&self, i: usize, depth: R, inward: R) -> R {
        let inward = if inward > R::ZERO { inward } else { R::ZERO };
        let push = entry(&self.stiffness, i) * depth + entry(&self.damping, i) * inward;
        if depth.is_finite() { push.clamped(R::ZERO, entry(&self.torque, i)) } else { R::ZERO }
    }
}

/// x, or zero if it is not finite.
#[inline(always)]
fn finite<R: Real>(x: R) -> R {
    R::either(x.is_finite(), x, R::ZERO)
}
