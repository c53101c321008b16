//! Limits of torque that keep the windings of the motors below their greatest temperature.
//!
//! A motor is two masses (winding and housing) between two thermal resistances: R_w from the
//! winding to the housing, R_h from there to the ambient. Temperatures are shares of the greatest
//! rise of the winding over the ambient, w and c; ρ = R_w / (R_w + R_h), and τ_c is the torque that
//! makes w = 1 when it lasts:
//!
//! ```text
//! T_w ẇ = ρ (τ/τ_c)² − (w − c)
//! T_h ċ = (1 − ρ)/ρ (w − c) − c
//! ```
//!
//! In a block of n ticks of length h, with a = n h / T_w, ε = n h / T_h, d = ε (1 − ρ)/ρ,
//! κ = a (1 − a/2) and σ = ε (1 − ε/2) (1 − d), the model is stepped by
//!
//! ```text
//! g = a ρ Σ(τ/τ_c)²/n      c' = c + d (w − c + g)
//! w ← w + g − κ (w − c')   c ← c' − σ c                           (1)
//! |τ| ≤ min(τ_max, τ_c (q + s (1 − w)))     s = 4 τ_max/τ_c       (2)
//! ```
//!
//! **Neither temperature is below that of the equations**, whatever the order of the torques in a
//! block: all of its heat counts without a loss, κ and σ are less than the decay of a block,
//! 1 − e⁻ᵃ ≥ a − a²/2, c' is what the housing does not exceed within it, and (1) does not decrease
//! with w or c.
//!
//! **w does not exceed 1**: let c₁ be such that σ c₁ = d (1 + κ) (1 − c₁), and c̄ = c₁ (1 + σ).
//! From w ≤ 1 and c ≤ c₁, a heat g ≤ κ (1 − c̄) + (1 − κ) (1 − w) leads to w + g ≤ 1 + κ (1 − c),
//! so that c' ≤ c + d (1 + κ) (1 − c) ≤ c̄; by (1) then w ≤ 1 and c ≤ c₁ again. This bound of g is
//! linear in w. The heat of (2) is convex until τ_max, and constant beyond. Both ends of the
//! convex part are below the bound if q² = κ (1 − c̄) / (a ρ), which is 1 − O(a), and if 2 a ρ
//! (τ_max/τ_c)² is at most (1 − κ)/4, which [`ThermalConfig::check`] requires.
//!
//! The model and its numbers on data sheets: Braun, "Formulae Handbook" (maxon academy, 2012),
//! thermal behaviour. I²t, one mass alone, is ρ = 1.

use crate::entry;
use crate::limits::{ConfigError, ConfigParameter, SafetyLimits};
use dynamics_core::scalar::Real;

mod forecast;
#[cfg(test)]
mod tests;

/// The share of the greatest rise of temperature within which τ_max fades to nothing.
const FADE: f64 = 0.25;
/// The reserve for rounding, in units in the last place: a step has some twenty roundings.
const RESERVE: f64 = 64.0;
/// Torques up to so many times the peak are counted in full.
const FAR: f64 = 4.0;
/// The least number of ticks of a block. In a tick one joint at most is stepped, so that a robot of
/// more joints has blocks of as many ticks as joints.
const BLOCK: usize = 32;

/// The motors of a [`ThermalLimit`], from their data sheets and as seen at the joints: torques
/// behind the gear.
///
/// Data sheets state the continuous torque at the greatest temperature of the winding, whose
/// resistance then is greatest; a colder winding is heated less than the model says.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ThermalConfig<R, const V: usize> {
    /// The length of a tick, s.
    pub tick: R,
    /// τ_c, the torque of each joint that may last, at this ambient, N·m or N.
    pub continuous: [R; V],
    /// τ_max, the torque of each joint that a cold motor may have, N·m or N.
    pub peak: [R; V],
    /// T_w, the thermal time constant of the winding, s.
    pub winding_time: [R; V],
    /// T_h, the thermal time constant of the motor, s.
    pub housing_time: [R; V],
    /// ρ, the share of the resistance from winding to housing in that from winding to ambient;
    /// 1 for I²t alone, whose only time is that of the winding.
    pub share: [R; V],
    /// The greatest temperature of each winding, °C.
    pub hottest: [R; V],
    /// The greatest temperature of the ambient, °C.
    pub ambient: R,
}

impl<R: Real, const V: usize> ThermalConfig<R, V> {
    /// Checks that 0 < τ_c ≤ τ_max, that ρ is in (0, 1], that windings may be warmer than the
    /// ambient, and that the times are long: 8 blocks of max(32, V) ticks
    /// at least, and long enough for a block at τ_max to heat the winding by no more than an eighth
    /// of the rise that it may have.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number and the joint.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::Tick.positive(self.tick)?;
        (0..V).try_for_each(|i| self.joint(i, block_ticks::<V>()).1)
    }

    /// The share of the greatest rise of a joint's winding that a temperature is, °C.
    fn rise(&self, i: usize, celsius: R) -> R {
        (celsius - self.ambient) / (entry(&self.hottest, i) - self.ambient)
    }

    /// The coefficients of (1) and (2) for blocks of so many ticks, of a joint as hot as it may be,
    /// and whether they are valid.
    fn joint(&self, i: usize, ticks: u32) -> (Joint<R>, Result<(), ConfigError>) {
        let of = |values| entry::<R>(values, i);
        let (continuous, peak, rho) = (of(&self.continuous), of(&self.peak), of(&self.share));
        let [half, eighth, fade] = [0.5, 0.125, FADE].map(R::from_f64);
        let span = of(&self.hottest) - self.ambient;
        let ticks = crate::real::<R>(ticks);
        let block = self.tick * ticks;
        let [a, epsilon] = [&self.winding_time, &self.housing_time].map(|time| block / of(time));
        let reserve = R::from_f64(RESERVE) * R::EPSILON;
        let (more, less) = (R::ONE + reserve, R::ONE - reserve);
        let d = epsilon * (R::ONE - rho) / rho * more;
        let kappa = a * (R::ONE - half * a) * less;
        let sigma = epsilon * (R::ONE - half * epsilon) * (R::ONE - d) * less;
        let heat = a * rho / (ticks * continuous * continuous) * more;
        let most = ticks * peak * peak;
        let long = |x: R| (x > R::ZERO) & (x <= eighth);
        let slow = (heat + heat) * most <= (R::ONE - kappa) * fade;
        let torques = (continuous > R::ZERO) & (peak >= continuous) & peak.is_finite();
        let shares = (rho > R::ZERO) & (rho <= R::ONE) & (span > R::ZERO) & span.is_finite();
        let times = long(a) & long(epsilon) & (d <= eighth) & slow;
        let checked = (ConfigParameter::ThermalTorque { joint: i }.require(torques))
            .and(ConfigParameter::ThermalMotor { joint: i }.require(shares & times));
        let inflow = d * (R::ONE + kappa);
        let hottest = inflow / (sigma + inflow);
        let cooled = kappa * (R::ONE - hottest * (R::ONE + sigma));
        let slope = peak / fade;
        let base = (cooled / (heat * ticks)).sqrt() * less + slope;
        let (winding, housing) = (Sum::of(R::ONE), Sum::of(hottest));
        let most = most * R::from_f64(FAR * FAR);
        (
            Joint { heat, most, kappa, d, sigma, base, slope, peak, hottest, winding, housing },
            checked,
        )
    }
}

/// The ticks of a block.
const fn block_ticks<const V: usize>() -> u32 {
    if V > BLOCK { V as u32 } else { BLOCK as u32 }
}

fn ticks<R: Real, const V: usize>() -> R {
    crate::real(block_ticks::<V>())
}

/// The temperatures of the motors, as shares of the greatest rise over the ambient, to be saved
/// before the supply is switched off: see [`ThermalLimit::resumed`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ThermalState<R, const V: usize> {
    /// w of each joint: 0 at the ambient, 1 at the greatest temperature.
    pub winding: [R; V],
    /// c of each joint.
    pub housing: [R; V],
}

/// The state of the motors before it is a fault. Joints are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ThermalStatus {
    /// Every joint may have its peak torque.
    Cool,
    /// The torque of the joint, whose winding is the hottest, is limited to less than its peak.
    Limited {
        /// The joint.
        joint: usize,
    },
    /// The winding is above its greatest temperature: the drive measured more than the model
    /// says, or its torque was not that of the gate. Stop the arm before the limit falls to zero:
    /// [`react`](crate::motion::MotionController::react) to
    /// [`Fault::Hot`](crate::limits::Fault::Hot).
    Hot {
        /// The joint.
        joint: usize,
    },
}

/// A limit of torque by a thermal model of each motor: its peak while it is cold, less the hotter
/// it is, and the continuous torque when the winding is as hot as it may be.
///
/// In each tick [`MotionController::limit_torques`](crate::motion::MotionController::limit_torques)
/// gives the limits to the gate, which every torque passes, that of a held arm too, and
/// [`Self::update`] gets the torques that went to the drives. A winding then does not exceed its
/// greatest temperature; the source has the proof. The torque that may last is less than τ_c by 64
/// ticks in T_w: 0.5 % at 1 ms and 12 s.
///
/// There is no step of torque: in a tick a limit changes by no more than the rate of the gate,
/// which [`Self::try_new`] checks, and by 4 % of a peak of 3 τ_c at 1 ms, 12 s and ρ = 0.4.
///
/// A new one has motors that are as hot as they may be: unless [`Self::resumed`] says
/// otherwise, this is what is known after a restart.
///
/// ```
/// use motion_control::limits::SafetyLimits;
/// use motion_control::safety::{ThermalConfig, ThermalLimit, ThermalState, ThermalStatus};
/// let limits = SafetyLimits { torque: [9.0], rate: [4.0], speed: [8.0], lower: [-1.0], upper: [1.0] };
/// let motor = ThermalConfig {
///     tick: 1e-3, continuous: [3.0_f32], peak: [9.0], winding_time: [12.0], housing_time: [600.0],
///     share: [0.4], hottest: [120.0], ambient: 30.0,
/// };
/// let mut thermal = ThermalLimit::try_new(motor, &limits)?; // nothing is known
/// assert!(thermal.torque()[0] < 3.0 && thermal.torque()[0] > 2.99);
/// thermal = thermal.resumed(&ThermalState { winding: [0.0], housing: [0.0] }, 0.0);
/// assert_eq!((thermal.torque(), thermal.status()), (&[9.0], ThermalStatus::Cool));
/// // What a planner asks: 6.2 s at 7 N·m, and any time at 2.9 N·m.
/// let seconds = [2.9, 7.0, 9.1].map(|torque| thermal.holds_for(0, torque));
/// assert!(seconds[0].is_infinite() && (seconds[1] - 6.2).abs() < 0.1 && seconds[2] == 0.0);
/// for _ in 0..60_000 {
///     thermal.update(&[thermal.torque()[0]]); // all that is allowed, for a minute
/// }
/// assert!(thermal.torque()[0] < 5.0 && thermal.celsius(0) < 120.0);
/// assert_eq!(thermal.status(), ThermalStatus::Limited { joint: 0 });
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
#[doc(alias = "I2t")]
#[doc(alias = "overload protection")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalLimit<R, const V: usize> {
    config: ThermalConfig<R, V>,
    joints: [Joint<R>; V],
    /// Σ τ² of the block so far.
    energy: [R; V],
    limit: [R; V],
    /// The tick within the block, which is the joint that ends its own in it.
    at: u32,
    /// Whether the joints are in their first blocks, which are shorter.
    first: bool,
}

impl<R: Real, const V: usize> ThermalLimit<R, V> {
    /// The limit of motors that are as hot as they may be; `limits` are those of the gate.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`]: those of [`ThermalConfig::check`], and
    /// [`ConfigParameter::ThermalTorque`] if a peak is above the gate's limit of torque, or the
    /// gate's rate slower than the limit may fall.
    pub fn try_new(
        config: ThermalConfig<R, V>,
        limits: &SafetyLimits<R, V>,
    ) -> Result<Self, ConfigError> {
        config.check()?;
        let joints: [_; V] = core::array::from_fn(|i| config.joint(i, block_ticks::<V>()).0);
        let gate = limits.rate.iter().zip(&limits.torque);
        for (i, (joint, (rate, torque))) in joints.iter().zip(gate).enumerate() {
            let heat = joint.heat * ticks::<R, V>() * joint.peak * joint.peak;
            let holds = (joint.slope * (heat + heat) <= *rate) & (joint.peak <= *torque);
            ConfigParameter::ThermalTorque { joint: i }.require(holds)?;
        }
        let zero = [R::ZERO; V];
        Ok(Self { config, joints, energy: zero, limit: zero, at: 0, first: true }.begun())
    }

    /// The limits of these temperatures, before the first tick.
    fn begun(mut self) -> Self {
        self.limit = self.joints.map(|joint| joint.limit());
        (self.energy, self.at, self.first) = ([R::ZERO; V], 0, true);
        self
    }

    /// Ends the first block of a joint, which has fewer ticks, with their decay. The proof above holds
    /// for it with the limit of whole blocks: for fewer ticks κ/a is greater, and c₁ less.
    #[cold]
    #[inline(never)]
    fn end_first_block(&mut self, at: usize) {
        self.first = self.at > 0;
        let joint = self.joints.get_mut(at).zip(self.energy.get_mut(at));
        let Some(((joint, energy), limit)) = joint.zip(self.limit.get_mut(at)) else {
            return;
        };
        let (shorter, _) = self.config.joint(at, at as u32 + 1);
        let Joint { heat, most, kappa, d, sigma, .. } = shorter;
        let mut end = Joint { heat, most, kappa, d, sigma, ..*joint };
        end.step(*energy);
        (joint.winding, joint.housing) = (end.winding, end.housing);
        (*energy, *limit) = (R::ZERO, joint.limit());
    }

    /// The same limit with temperatures that were saved `off` seconds before (0 if nobody knows),
    /// and without torque since. A number that cannot be one counts as the greatest temperature.
    #[must_use]
    pub fn resumed(mut self, saved: &ThermalState<R, V>, off: R) -> Self {
        let blocks = (off / (self.config.tick * ticks::<R, V>())).to_u32();
        let two = R::ONE + R::ONE;
        let warm = |x: R, most: R| R::either((x >= R::ZERO) & (x <= two), x, most);
        for (i, joint) in self.joints.iter_mut().enumerate() {
            let housing = warm(entry(&saved.housing, i), joint.hottest);
            joint.winding = Sum::of(warm(entry(&saved.winding, i), R::ONE));
            joint.housing = Sum::of(R::either(housing < joint.hottest, housing, joint.hottest));
            joint.cool(blocks);
        }
        self.begun()
    }

    /// The temperatures, to be saved.
    pub fn state(&self) -> ThermalState<R, V> {
        let mut winding = self.joints.map(|joint| joint.winding.sum);
        for ((w, joint), &energy) in winding.iter_mut().zip(&self.joints).zip(&self.energy) {
            *w += joint.heated(energy);
        }
        ThermalState { winding, housing: self.joints.map(|joint| joint.housing.sum) }
    }

    /// Takes the torques that the drives have in this tick,
    /// [`Command::torque`](crate::limits::Command::torque), N·m or N: once in each tick, and again
    /// for each one that was missed. A torque that is not finite counts as four times the peak.
    ///
    /// # Cost
    /// By count: 2 flops a joint, and 25 flops in V of max(32, V) ticks; no division.
    #[inline]
    pub fn update(&mut self, torque: &[R; V]) {
        for (energy, &tau) in self.energy.iter_mut().zip(torque) {
            *energy += tau * tau;
        }
        let at = self.at as usize;
        self.at = if at + 1 >= V.max(BLOCK) { 0 } else { self.at + 1 };
        if self.first {
            return self.end_first_block(at);
        }
        let joint = self.joints.get_mut(at).zip(self.energy.get_mut(at));
        if let (Some((joint, energy)), Some(limit)) = (joint, self.limit.get_mut(at)) {
            joint.step(*energy);
            *energy = R::ZERO;
            *limit = joint.limit();
        }
    }

    /// The temperature of a joint's winding that its drive has measured, °C, such as
    /// `motor_temperature` of a drive in MIT mode: not more often than once in a tick.
    ///
    /// It raises that of the model, no faster than the peak torque does, so that there is no step
    /// of the limit; it never lowers it, since a sensor lags behind the winding. One that is not a
    /// number changes nothing.
    pub fn measured(&mut self, joint: usize, celsius: R) {
        let rise = self.config.rise(joint, celsius);
        if let Some(joint) = self.joints.get_mut(joint) {
            let (up, most) = (rise - joint.winding.sum, joint.heat * joint.peak * joint.peak);
            if up > R::ZERO {
                joint.winding.add(R::either(up < most, up, most));
            }
        }
    }

    /// The limit of each torque in the next tick, N·m or N: at least 0, at most the peak.
    #[inline(always)]
    pub fn torque(&self) -> &[R; V] {
        &self.limit
    }

    /// The temperature of a joint's winding by the model, °C.
    pub fn celsius(&self, joint: usize) -> R {
        let ambient = self.config.ambient;
        let rise = self.joints.get(joint).map_or(R::ZERO, |joint| joint.winding.sum);
        ambient + rise * (entry(&self.config.hottest, joint) - ambient)
    }

    /// Whether a torque is limited, and of which joint: the one whose winding is the hottest.
    pub fn status(&self) -> ThermalStatus {
        let (mut joint, mut hottest) = (V, R::ZERO);
        for (i, at) in self.joints.iter().enumerate() {
            let w = at.winding.sum;
            if (at.limit() < at.peak) & (w > hottest) {
                (joint, hottest) = (i, w);
            }
        }
        match joint {
            _ if joint == V => ThermalStatus::Cool,
            _ if hottest > R::ONE => ThermalStatus::Hot { joint },
            _ => ThermalStatus::Limited { joint },
        }
    }
}

/// The coefficients of (1) and (2) of a joint, and its temperatures.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Joint<R> {
    /// g of a torque of 1 in one tick, and the greatest Σ τ² that is counted.
    heat: R,
    most: R,
    kappa: R,
    d: R,
    sigma: R,
    /// The limit is base − slope w, within 0 and the peak.
    base: R,
    slope: R,
    peak: R,
    /// c₁.
    hottest: R,
    winding: Sum<R>,
    housing: Sum<R>,
}

impl<R: Real> Joint<R> {
    /// g of this Σ τ².
    #[inline(always)]
    fn heated(&self, energy: R) -> R {
        self.heat * R::either(energy <= self.most, energy, self.most)
    }

    /// A block with this Σ τ², by (1).
    #[inline(always)]
    fn step(&mut self, energy: R) {
        let g = self.heated(energy);
        let (w, c) = (self.winding.sum, self.housing.sum);
        let inflow = self.d * (w - c + g);
        self.winding.add(g - self.kappa * (w - c - inflow));
        self.housing.add(inflow - self.sigma * c);
    }

    /// The limit of the torque, by (2).
    #[inline(always)]
    fn limit(&self) -> R {
        (self.base - self.slope * self.winding.sum).clamped(R::ZERO, self.peak)
    }
}

/// A sum that keeps what rounding takes: a step of the housing is less than a digit of f32.
///
/// Kahan, "Further remarks on reducing truncation errors" (1965).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sum<R> {
    sum: R,
    rest: R,
}

impl<R: Real> Sum<R> {
    const fn of(sum: R) -> Self {
        Self { sum, rest: R::ZERO }
    }

    #[inline(always)]
    fn add(&mut self, x: R) {
        let x = x + self.rest;
        let sum = self.sum + x;
        (self.sum, self.rest) = (sum, x - (sum - self.sum));
    }
}
