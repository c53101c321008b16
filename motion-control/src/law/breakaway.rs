//! A push and a dither for joints that stick, out of a tank of energy.
//!
//! With c the resolution of the encoders, h the tick, τ_k the torque of tick k and q_k the measured
//! positions, the energy E of a joint is in each tick
//!
//! ```text
//! E ← E − τ Δq                      the work of the torque of the step that has been measured
//! E ← min(E + (1 − σ) F |Δp|, E₀)   friction has absorbed this; p follows q with a play of ±2 c
//! E ← E − c |τ_k − τ_(k−1)|         what Δq may have been otherwise: see below
//! |τ_k| ≤ (E − (v h + 2 c) |τ_(k−1)| − c |τ_(k−1)|) / (v h + 4 c)
//! ```
//!
//! in which the term with τ_(k−1) and v h is that of a step that is not measured yet, for positions
//! that come a tick late. A true position differs from the measured one by e_k, |e_k| ≤ c. Then
//! Σ τ_k (e_(k+1) − e_k) = −Σ e_k (τ_k − τ_(k−1)), of which the third line has the bound; and a
//! joint whose measured position passes through the play by Δp has moved as far. Therefore
//!
//! ```text
//! Σ τ Δq_true ≤ E₀ + (1 − σ) F Σ |Δq_true|
//! ```
//!
//! for every motion that is not faster than v, whatever the noise: the law delivers no more than
//! its first energy and what friction F has taken that no compensation of the share σ gives back,
//! but for rounding: 10⁻⁷ of E₀ in a tick in f32.
//!
//! Ferraguti, Preda, Manurung, Bonfè, Lambercy, Gassert, Muradore, Fiorini & Secchi, "An energy
//! tank-based interactive control architecture for autonomous and teleoperated robotic surgery"
//! (2015), have tanks; Armstrong-Hélouvry, Dupont & Canudas de Wit (1994), section 4.1, has dither.

use crate::entry;
use crate::limits::{ConfigError, ConfigParameter};
use crate::real;
use dynamics_core::scalar::Real;
use dynamics_core::state::manifold::nearest_turn;

#[cfg(test)]
mod tests;

/// Steps of the encoder: a joint that has moved by so many within the window has left its place.
const MOVED: f64 = 4.0;
/// Steps of the encoder over which a push fades.
const FADE: f64 = 12.0;
/// A step of the joint that is longer by this factor than the longest one is none.
const FAR: f64 = 4.0;

/// The parameters of a [`Breakaway`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BreakawayConfig<R, const V: usize> {
    /// The length of a tick, s.
    pub tick: R,
    /// c, a step of the encoders, rad or m: measured positions are off by at most as much, by half
    /// a step and the noise.
    pub resolution: R,
    /// Whether the positions are those of the tick before, as of a
    /// [`MotionController`](crate::motion::MotionController) by
    /// [`PreviousTick`](crate::motion::PreviousTick).
    pub late: bool,
    /// The least static friction of each joint, N·m or N.
    pub stiction: [R; V],
    /// The push at its begin, as a share of the static friction.
    pub push: R,
    /// The amplitude of the dither, as a share of the static friction.
    pub dither: R,
    /// Ticks within which a joint has to move by four steps of its encoder to leave its place, and
    /// without which it stands.
    pub window: u32,
    /// Ticks after which a push has faded.
    pub push_ticks: u32,
    /// Ticks of half a period of the dither.
    pub dither_ticks: u32,
    /// E₀, the greatest energy of each joint, J; the dither leaves half of it to the push.
    pub energy: [R; V],
    /// F, the least sliding friction of each joint, N·m or N.
    pub friction: [R; V],
    /// σ, the share of the friction that other laws compensate, such as
    /// [`HandGuidingConfig::share`](crate::law::HandGuidingConfig::share).
    pub share: R,
    /// v, the greatest speed of each joint, rad/s or m/s, beyond which the supervisor stops it.
    pub speed: [R; V],
}

impl<R: Real, const V: usize> BreakawayConfig<R, V> {
    /// Checks that tick and resolution are greater than zero, shares of the static friction at
    /// least 0 and less than 1, that of the compensation up to 1, numbers of ticks not zero, and
    /// all others finite and not negative.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::Tick.positive(self.tick)?;
        ConfigParameter::Resolution.positive(self.resolution)?;
        let shares = [self.push, self.dither].into_iter();
        let partial = shares.map(|x| (x >= R::ZERO) & (x < R::ONE)).fold(true, |all, x| all & x);
        let compensated = (self.share >= R::ZERO) & (self.share <= R::ONE);
        ConfigParameter::BreakawayShare.require(partial & compensated)?;
        let ticks = [self.window, self.push_ticks, self.dither_ticks];
        ConfigParameter::BreakawayTicks.require(!ticks.contains(&0))?;
        let joints = [&self.stiction, &self.energy, &self.friction, &self.speed];
        let mut all = joints.into_iter().flatten();
        let good = all.all(|x| x.is_finite() & (*x >= R::ZERO));
        let longest = |v: &R| *v * self.tick + self.resolution + self.resolution;
        let steps = self.speed.iter().all(|v| longest(v).is_finite());
        ConfigParameter::Stiction.require(good & steps)
    }
}

/// The law of joints that stick: torques to add to those of
/// [`HandGuiding`](crate::law::HandGuiding), or of a loop that holds the arm.
///
/// - A **push** helps a joint that stood and has just been moved, in the direction of this motion.
///   It fades over twelve steps of the encoder, or with the time. There is none while a joint is
///   held still, and no other one before it has stood again.
/// - A **dither**, a sine, acts on joints that stand, so that less force moves them. It ends when
///   half of the joint's energy is spent: an arm that stands for long is silent.
///
/// Both are passive by construction: the work of the torques comes out of a tank of each joint,
/// which is filled by friction alone, and by what the joint gives back. Less torque than is
/// returned, or none, breaks this account. The step of a joint that is faster than `speed` is paid
/// for as measured, by a debt if need be.
///
/// ```
/// use motion_control::law::{Breakaway, BreakawayConfig};
/// let mut breakaway = Breakaway::<f32, 1>::try_new(BreakawayConfig {
///     tick: 2e-3, resolution: 0.38e-3, late: true,
///     stiction: [2.4], push: 0.6, dither: 0.0,
///     window: 20, push_ticks: 100, dither_ticks: 5,
///     energy: [0.2], friction: [0.45], share: 0.75, speed: [1.5],
/// })?;
/// // It stands, and is moved by a hand: 0.2 rad/s.
/// assert_eq!([(); 30].map(|()| breakaway.torque(&[0.5])[0]), [0.0; 30]);
/// let pushes = [1.0, 2.0, 3.0, 4.0, 5.0, 20.0].map(|k| breakaway.torque(&[0.5 + 0.4e-3 * k])[0]);
/// assert!(pushes[..3].iter().all(|push| *push == 0.0));
/// assert!((pushes[3] - 1.44).abs() < 1e-6 && pushes[4] < pushes[3] && pushes[5] == 0.0);
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
#[doc(alias = "stiction compensation")]
#[doc(alias = "dither")]
#[doc(alias = "energy tank")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breakaway<R, const V: usize> {
    config: BreakawayConfig<R, V>,
    /// The share of a half period that a tick of the dither is.
    dither_tick: R,
    joints: [Joint<R>; V],
}

/// The motion of a joint, and the energy that it has been given.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Joint<R> {
    /// E.
    energy: R,
    /// The position of the tick before; not finite if it was not measured.
    last: R,
    /// The torques of the last ticks whose steps have not been measured: of the tick before, and of
    /// the one before that.
    torque: [R; 2],
    /// q − p, within the play.
    play: R,
    /// The way since the begin of the window.
    way: R,
    /// Ticks since the joint left its place.
    still: u32,
    /// The sign of the push, or zero if there is none.
    side: R,
    /// The ticks of the push.
    pushed: u32,
    /// The way along the push.
    along: R,
    /// The ticks of the dither since the last change of its sign.
    phase: u32,
    sign: R,
}

impl<R: Real, const V: usize> Breakaway<R, V> {
    /// The law of this configuration, with full tanks, of joints that have just moved.
    ///
    /// # Errors
    /// [`ConfigError`], as [`BreakawayConfig::check`].
    pub fn try_new(config: BreakawayConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        let joints = config.energy.map(|energy| Joint {
            energy,
            last: R::from_f64(f64::INFINITY),
            torque: [R::ZERO; 2],
            play: R::ZERO,
            way: R::ZERO,
            still: 0,
            side: R::ZERO,
            pushed: 0,
            along: R::ZERO,
            phase: 0,
            sign: R::ONE,
        });
        Ok(Self { config, dither_tick: R::ONE / real(config.dither_ticks), joints })
    }

    /// The energy that each joint may still be given, J.
    pub fn energy(&self) -> [R; V] {
        self.joints.map(|joint| joint.energy)
    }

    /// The torques to add in this tick, N·m or N, from the measured positions, rad or m: call it
    /// once in each tick.
    ///
    /// A joint without a measured step gets no torque: where this position or the last one is not
    /// finite, or the step between them is longer than four at the greatest speed. Its energy then
    /// pays for the longest step that it may have made, and it has to stand again.
    ///
    /// # Cost
    /// By count: some 35 flops a joint, fewer for joints that move; a push divides three times, and any
    /// torque once where the energy is short.
    #[inline]
    #[must_use]
    pub fn torque(&mut self, q: &[R; V]) -> [R; V] {
        let Self { config, dither_tick, joints } = self;
        let mut torque = [R::ZERO; V];
        for (i, (out, (joint, &q))) in torque.iter_mut().zip(joints.iter_mut().zip(q)).enumerate() {
            let (speed, c) = (entry(&config.speed, i), config.resolution);
            // The longest step that can be measured.
            let longest = speed * config.tick + c + c;
            let step = joint.step(q, config.late, longest);
            let friction = (R::ONE - config.share) * entry(&config.friction, i);
            joint.refill(step, friction, c + c, entry(&config.energy, i));
            joint.watch(step, config);
            *out = joint.give(step.is_some(), config, *dither_tick, i, longest);
        }
        torque
    }
}

impl<R: Real> Joint<R> {
    /// The measured step, if there is one; what it may have been is paid for.
    fn step(&mut self, q: R, late: bool, longest: R) -> Option<R> {
        let [last, before] = self.torque;
        let torque = if late { before } else { last };
        // The short way, for angles that are within a turn.
        let step = nearest_turn(q - self.last, R::ZERO);
        self.last = q;
        let step = (step.abs() <= R::from_f64(FAR) * longest).then_some(step);
        self.energy -= step.map_or(torque.abs() * longest, |step| torque * step);
        step
    }

    /// The energy that friction has absorbed on the way of the play.
    fn refill(&mut self, step: Option<R>, friction: R, play: R, most: R) {
        let to = step.map_or(R::ZERO, |step| self.play + step);
        self.play = to.clamped(-play, play);
        let filled = self.energy + friction * (to - self.play).abs();
        self.energy = if filled < most { filled } else { most };
    }

    /// Whether the joint stands, has left its place, or is pushed.
    fn watch<const V: usize>(&mut self, step: Option<R>, config: &BreakawayConfig<R, V>) {
        let Some(step) = step else {
            (self.still, self.way, self.side) = (0, R::ZERO, R::ZERO);
            return;
        };
        let steps = |count| R::from_f64(count) * config.resolution;
        self.way += step;
        if self.side.abs() > R::ZERO {
            self.along += self.side * step;
            self.pushed = self.pushed.saturating_add(1);
            // The end of the push, by its time and way, or by a hand that turns back.
            let pushed = (self.pushed >= config.push_ticks) | (self.along >= steps(FADE));
            if pushed | (self.along <= -steps(MOVED)) {
                self.side = R::ZERO;
            }
        }
        if self.way.abs() >= steps(MOVED) {
            if self.still >= config.window {
                self.side = if self.way > R::ZERO { R::ONE } else { -R::ONE };
                (self.pushed, self.along) = (0, R::ZERO);
            }
            (self.still, self.way) = (0, R::ZERO);
        } else {
            self.still = self.still.saturating_add(1);
            let twice = config.window.saturating_add(config.window);
            if (self.still == config.window) | (self.still >= twice) {
                (self.still, self.way) = (config.window, R::ZERO);
            }
        }
    }

    /// The torque that is wanted, as far as the energy goes, which pays for its change.
    fn give<const V: usize>(
        &mut self,
        measured: bool,
        config: &BreakawayConfig<R, V>,
        dither_tick: R,
        i: usize,
        longest: R,
    ) -> R {
        let (stiction, c) = (entry(&config.stiction, i), config.resolution);
        let [last, _] = self.torque;
        let pending = if config.late { last.abs() * longest } else { R::ZERO };
        let free = self.energy - pending - c * last.abs();
        let pushes = self.side.abs() > R::ZERO;
        let (wanted, free) = if pushes {
            let faded = R::ONE - self.along / (R::from_f64(FADE) * c);
            let left = R::ONE - real::<R>(self.pushed) / real(config.push_ticks);
            let push = config.push * faded.clamped(R::ZERO, R::ONE) * left;
            (self.side * push * stiction, free)
        } else if self.still >= config.window {
            let half = R::from_f64(0.5) * entry(&config.energy, i);
            (self.dither(config.dither_ticks, dither_tick) * config.dither * stiction, free - half)
        } else {
            self.phase = 0;
            (R::ZERO, free)
        };
        let torque = if measured & (free > R::ZERO) & (wanted.abs() > R::ZERO) {
            // A division alone where the energy is short.
            let span = longest + c + c;
            if wanted.abs() * span <= free {
                wanted
            } else if wanted > R::ZERO {
                free / span
            } else {
                -free / span
            }
        } else {
            R::ZERO
        };
        self.energy -= c * (torque - last).abs();
        self.torque = [torque, last];
        torque
    }

    /// The dither in this tick, of amplitude 1: half periods that are parabolas, a sine within 0.06.
    fn dither(&mut self, ticks: u32, tick: R) -> R {
        if self.phase >= ticks {
            (self.phase, self.sign) = (0, -self.sign);
        }
        // The middle of the tick, so that the half periods are symmetric.
        let x = (real::<R>(self.phase) + R::from_f64(0.5)) * tick;
        self.phase = self.phase.saturating_add(1);
        R::from_f64(4.0) * self.sign * x * (R::ONE - x)
    }
}
