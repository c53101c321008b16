//! A tip that is moved by twists: damped differential inverse kinematics within the joints' limits.
//!
//! In each tick the joint speeds solve (1), where d are the speeds of least squares, p those
//! towards a posture, and clamp limits a joint to speeds from which it can still stop before the
//! end of its range:
//!
//! ```text
//! q̇ = clamp(d)      d = p + Jᵀ x      J clamp(p + Jᵀ x) + λ² x = v          (1)
//! ```
//!
//! This is one step of Newton's method in each tick, from the set of clamped joints of the tick
//! before: these joints are held at their limits, and x is solved for the others. x are multipliers
//! of the task, so that a held joint becomes free when its d leads away from the end.
//!
//! With the step s = a h of the speed in a tick h, a speed u towards an end at the distance e,
//! measured from where the joint is in the middle of the tick, can be stopped in whole ticks if
//!
//! ```text
//! g(u) = u (u/2 + s) ≤ a e                                                  (2)
//! ```
//!
//! which the speed u − s of the next tick then fulfils too. Only the speeds from w − s to w + s can
//! come after w, and g is convex: the speed of which its chord over them is a e fulfils (2), and
//! the speed by the chord above that one is nearer to the greatest which does. This takes two
//! divisions in place of a square root. While w + s fulfils (2) the end is no limit.
//!
//! A joint that moves the tip by the singular value σ = |v|/|d| comes to the singular posture ahead
//! when σ has fallen to zero, and should have stopped there: all speeds are scaled so that none is
//! greater than √(a σ). Nakamura & Hanafusa, "Inverse kinematic
//! solutions with singularity robustness for robot manipulator control" (1986); Flacco, De Luca &
//! Khatib, "Control of redundant robots under hard joint constraints: saturation in the null space"
//! (2015); Hintermüller, Ito & Kunisch, "The primal-dual active set strategy as a semismooth Newton
//! method" (2002).

use super::damped_motion::{Damping, damped_motion, square};
use crate::entry;
use crate::limits::{ConfigError, ConfigParameter, MotionLimits};
use crate::reference::Reference;
use crate::root;
use dynamics_core::algorithms::frame::Pose;
use dynamics_core::scalar::{Matrix, Real, Vector, positive_part};
use dynamics_core::spatial::Motion;
use dynamics_core::state::{State, all_finite};

#[cfg(test)]
mod tests;

/// Roundings of a position that the ends of a range are kept away from.
const ROUNDINGS: f64 = 4.0;
/// The least λ².
const LEAST_DAMPING: f64 = 1e-3;
/// The square that is added to that of a twist, (rad/s)²: a twist of zero has a size.
const TINY: f64 = 1e-20;
/// The sum of the squares of joint speeds from which they count as not finite, (rad/s)² or (m/s)².
const OVERFLOW: f64 = 1e12;
/// The least limit of a speed, rad/s or m/s.
const LEAST_VELOCITY: f64 = 1e-8;
/// 4 cos²(θ/2) of a rotation that is next to half a turn.
const HALF_A_TURN: f64 = 1e-4;
/// The bound of a speed that no end of a range limits, rad/s or m/s.
const UNBOUNDED: f64 = 1e30;

/// The limits of a [`TipMotion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipMotionConfig<R, const V: usize> {
    /// The length of a tick, s.
    pub tick: R,
    /// The least position of each joint, rad or m; −∞ for none.
    pub lower: [R; V],
    /// The greatest position of each joint, rad or m; ∞ for none.
    pub upper: [R; V],
    /// The greatest speed, which may be infinite, and the greatest acceleration of each joint.
    pub limits: [MotionLimits<R>; V],
    /// T, s, of the damping λ² = T |(ω, v/ℓ)| + 10⁻³: in a direction of the singular value σ the tip
    /// moves by the share σ²/(σ² + λ²). The tip comes to the end of its reach in a time of about T;
    /// 0.01 s suits arms.
    pub damping: R,
    /// ℓ, the length at which a displacement counts as much as a rotation, m: a third of the reach.
    pub length: R,
    /// The posture towards which the joints move as far as the tip's motion leaves them free, rad
    /// or m; only arms of more than six joints have such a freedom.
    pub posture: [R; V],
    /// Speed towards the posture per distance, 1/s; 0 for no posture.
    pub posture_gain: R,
}

/// How a tip moves in a tick of a [`TipMotion`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TipStatus {
    /// As the twist says, up to damping and while the joints accelerate.
    Follows,
    /// Along the twist, but slower: the joint of this number is at its greatest speed, or at that
    /// from which it can stop at a singular posture ahead.
    Slowed(usize),
    /// As near to the twist as the other joints can: the joint of this number, and those before it
    /// maybe, is at the end of its range or brakes before it.
    Limited(usize),
    /// It comes to rest: a number of the twist or of the Jacobian is not finite.
    NotFinite,
}

/// The reference of an arm whose tip is moved by a twist that is new in each tick: a joystick, or
/// [`TipGoal`].
///
/// [`Self::step`] takes the Jacobian of the tip at the reference [`Self::state`] and advances it;
/// as a [`Reference`] it has this state in every tick. No joint ever exceeds its range, speed or
/// acceleration, and each can always stop before the end of its range. A reference that begins
/// beyond one of them, see [`Self::restart`], comes back at the greatest acceleration; beyond the
/// end of a range it stops, and moves inwards only.
///
/// - A joint at its greatest speed slows the whole arm, and joints that have to accelerate do so
///   together, so that the tip keeps its direction.
/// - A joint at the end of its range stays there, and the others move the tip as near to the twist
///   as they can; an arm of more than six joints goes on along the twist.
/// - Near a singular posture the arm slows down, and motions along directions that the tip loses
///   fade out.
/// - The tip comes first: the posture uses what freedom is left.
///
/// ```
/// use motion_control::limits::MotionLimits;
/// use motion_control::motion::{TipMotion, TipMotionConfig, TipStatus};
/// use motion_control::reference::Reference;
/// use dynamics_core::{Engine, algorithms::frame::LocalWorldAligned, robots::Ur5e, spatial::Motion};
/// use dynamics_core::{glam::Vec3, model::{OnBody, Robot}};
/// const TIP: OnBody<{ Ur5e::MODEL.body("wrist_3") }> = OnBody;
/// let mut tip = TipMotion::try_new(TipMotionConfig {
///     tick: 1e-3_f32, lower: [-6.2; 6], upper: [6.2; 6],
///     limits: [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6],
///     damping: 0.01, length: 0.3, posture: [0.0; 6], posture_gain: 0.0,
/// }, &[0.0, -1.2, 1.5, 0.3, 0.7, 0.0])?;
/// let height = |tip: &TipMotion<f32, 6>| Engine::<Ur5e>::poses_of(&tip.at(0).q, TIP)[0].pos.z;
/// let (before, up) = (height(&tip), Motion::new(Vec3::ZERO, Vec3::Z * 0.1)); // m/s
/// for _ in 0..1000 {
///     let jacobian = Engine::<Ur5e>::jacobian(&tip.state().q, TIP, LocalWorldAligned);
///     assert_eq!(tip.step(&jacobian, &up), TipStatus::Follows);
/// }
/// assert!((height(&tip) - before - 0.1).abs() < 2e-3); // m
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
#[doc(alias = "inverse kinematics")]
#[doc(alias = "servo")]
#[doc(alias = "jog")]
#[doc(alias = "teleoperation")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipMotion<R, const V: usize> {
    config: TipMotionConfig<R, V>,
    state: State<R, V, V>,
    /// The parts of the positions that rounding has left.
    rest: [R; V],
    /// The joints that are not held at a limit, and the d of those that are.
    free: [bool; V],
    held: [R; V],
    /// 1/ℓ and 1/h.
    inverse: [R; 2],
    /// 1/v² and 1/a of the limits of each joint.
    per_limit: [[R; 2]; V],
    /// The positions between which no speed is limited by (2).
    within: [[R; 2]; V],
}

impl<R: Real, const V: usize> TipMotion<R, V> {
    /// The reference that rests at q, rad or m.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names a number that is beyond its range, among them a limit of
    /// velocity below 10⁻⁸ rad/s or m/s.
    pub fn try_new(mut config: TipMotionConfig<R, V>, q: &[R; V]) -> Result<Self, ConfigError> {
        let tip = ConfigParameter::TipMotion;
        [config.tick, config.damping, config.length].iter().try_for_each(|x| tip.positive(*x))?;
        let (gain, posture) = (config.posture_gain, all_finite(&config.posture));
        tip.require(posture & gain.is_finite() & (gain >= R::ZERO))?;
        for (j, limits) in config.limits.iter().enumerate() {
            let range = ConfigParameter::JointRange { joint: j };
            let some = (config.lower[j] <= config.upper[j])
                & (limits.velocity > R::from_f64(LEAST_VELOCITY));
            range.require(some & q[j].is_finite())?;
            range.positive(limits.acceleration)?;
        }
        // The greatest speeds leave room for their rounding.
        config.limits.iter_mut().for_each(|limits| limits.velocity *= less::<R>());
        let per_limit = config.limits.map(|MotionLimits { velocity, acceleration }| {
            [velocity * velocity, acceleration].map(|x| R::ONE / x)
        });
        let within = core::array::from_fn(|j| {
            let MotionLimits { velocity, acceleration: a } = config.limits[j];
            let far = velocity * (velocity / (a + a) + config.tick + config.tick);
            [config.lower[j] + far, config.upper[j] - far]
        });
        let inverse = [config.length, config.tick].map(|x| R::ONE / x);
        let (state, rest, held, free) = (State::at(*q), [R::ZERO; V], [R::ZERO; V], [true; V]);
        Ok(Self { config, state, rest, held, free, inverse, per_limit, within })
    }

    /// The state of the reference in this tick: where the next [`Self::step`] needs the Jacobian.
    #[inline(always)]
    pub fn state(&self) -> &State<R, V, V> {
        &self.state
    }

    /// Begins again from a state, that of the arm, after a fault or another motion. A state that is
    /// not finite is not taken, and the answer is false.
    ///
    /// ```
    /// # use motion_control::limits::MotionLimits;
    /// # use motion_control::motion::{TipMotion, TipMotionConfig};
    /// use dynamics_core::state::State;
    /// # let mut tip = TipMotion::try_new(TipMotionConfig {
    /// #     tick: 1e-3_f32, lower: [-1.0], upper: [1.0],
    /// #     limits: [MotionLimits { velocity: 3.0, acceleration: 10.0 }],
    /// #     damping: 0.01, length: 0.3, posture: [0.0], posture_gain: 0.0,
    /// # }, &[0.0])?;
    /// assert!(tip.restart(&State { q: [0.5], qd: [0.1], qdd: [0.0] }));
    /// assert!(!tip.restart(&State::at([f32::NAN])));
    /// assert_eq!(tip.state().q, [0.5]);
    /// # Ok::<(), motion_control::limits::ConfigError>(())
    /// ```
    #[must_use = "a state that is not finite is not taken"]
    pub fn restart(&mut self, state: &State<R, V, V>) -> bool {
        let finite = state.is_finite();
        if finite {
            (self.state, self.rest, self.free) = (*state, [R::ZERO; V], [true; V]);
        }
        finite
    }

    /// Advances the reference by a tick, in which the tip moves by `twist`, rad/s and m/s;
    /// `jacobian` is that of the tip at [`Self::state`], in the frame of the twist.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository: one factorisation of 6 × 6, whatever the joints do; more for
    /// each joint that is near an end or held there.
    ///
    /// # Errors
    /// [`TipStatus::NotFinite`]: the joints brake within their limits.
    #[inline]
    pub fn step(&mut self, jacobian: &[Motion<R>; V], twist: &Motion<R>) -> TipStatus {
        let [per_length, _] = self.inverse;
        let mut rest = *twist;
        let mut places = self.state.q.iter().zip(&self.within);
        // Not between them also if a limit of speed is infinite.
        let near = !places.all(|(q, [lower, upper])| (q > lower) & (q < upper));
        let bounds = near.then(|| self.hold(jacobian, &mut rest));
        let mut sum = square(*twist, per_length) + R::from_f64(TINY);
        let mut inverse = sum.rsqrt();
        let damping = Damping {
            square: self.config.damping * (sum * inverse) + R::from_f64(LEAST_DAMPING),
            length: self.config.length,
        };
        let gain = self.config.posture_gain;
        let (has_posture, mut p) = (gain > R::ZERO, [R::ZERO; V]);
        if has_posture {
            for j in 0..V {
                let quarter = R::from_f64(0.25) * self.config.limits[j].velocity;
                let wanted = gain * (self.config.posture[j] - self.state.q[j]);
                p[j] = wanted.clamped(-quarter, quarter);
                if self.free[j] {
                    sum += p[j] * p[j];
                    rest -= jacobian[j] * p[j];
                }
            }
            inverse = sum.rsqrt();
        }
        let x = damped_motion(jacobian, &self.free, damping, &rest);
        let mut speeds = jacobian.map(|column| column.dot(x));
        if has_posture {
            speeds.iter_mut().zip(&p).for_each(|(speed, p)| *speed += *p);
        }
        let status = self.limit(bounds.as_ref(), inverse, &mut speeds);
        self.advance(bounds.as_ref(), &speeds);
        status
    }

    /// The bounds of the joints; takes the motions of those that are held there from the rest of the
    /// twist.
    #[inline(never)]
    fn hold(&mut self, jacobian: &[Motion<R>; V], rest: &mut Motion<R>) -> [[R; 2]; V] {
        core::array::from_fn(|j| {
            let [lower, upper] = self.bounds(j);
            if !self.free[j] {
                let known = self.held[j].clamped(lower, upper);
                self.free[j] = known == self.held[j];
                if !self.free[j] {
                    *rest -= jacobian[j] * known;
                }
            }
            [lower, upper]
        })
    }

    /// The least and the greatest speed of joint j in the next tick from which it can stop before the
    /// ends of its range, by (2).
    #[inline(always)]
    fn bounds(&self, j: usize) -> [R; 2] {
        let Self { config, state, .. } = self;
        let (half, h) = (R::from_f64(0.5), config.tick);
        let (q, qd) = (entry(&state.q, j), entry(&state.qd, j));
        let a = config.limits.get(j).map_or(R::ONE, |limits| limits.acceleration);
        let (s, margin) = (a * h, R::from_f64(ROUNDINGS) * R::EPSILON * q.abs());
        let way = half * h * qd + entry(&self.rest, j);
        let bound = |way: R, w: R| {
            let (e, most) = (way - margin, positive_part(w + s));
            if e <= margin {
                return R::ZERO;
            }
            if most * (half * most + s) <= a * e {
                return R::from_f64(UNBOUNDED);
            }
            let chord = |u: R| u + (a * e - u * (half * u + s)) / (half * (u + most) + s);
            chord(chord(positive_part(w - s))).clamped(R::ZERO, R::from_f64(UNBOUNDED))
        };
        [
            -bound(q - entry(&config.lower, j) + way, -qd),
            bound(entry(&config.upper, j) - q - way, qd),
        ]
    }

    /// Limits the speeds; `bounds` are those of joints near the ends of their ranges, and `inverse`
    /// is 1 over the size of their motion.
    #[inline(always)]
    fn limit(
        &mut self,
        bounds: Option<&[[R; 2]; V]>,
        inverse: R,
        speeds: &mut [R; V],
    ) -> TipStatus {
        let mut squares = speeds.map(|d| d * d);
        let add = |squares: &[R; V]| squares.iter().fold(R::MIN_POSITIVE, |sum, x| sum + *x);
        let mut sum = add(&squares);
        // Squares of greater speeds might overflow.
        let usual = sum < R::from_f64(OVERFLOW);
        if !usual {
            *speeds = [R::ZERO; V];
            return TipStatus::NotFinite;
        }
        if bounds.is_some() && self.free.contains(&false) {
            let held = squares.iter_mut().zip(&self.free).filter(|(_, free)| !**free);
            held.for_each(|(square, _)| *square = R::ZERO);
            sum = add(&squares);
        }
        // 1/σ; the square of the share that is left is 1/most.
        let per_sigma = root(sum) * inverse;
        let (mut most, mut status) = (R::ONE, TipStatus::Follows);
        for (joint, now) in squares.into_iter().enumerate() {
            let [fast, turning] = self.per_limit[joint];
            let turning = turning * per_sigma;
            let over = now * if fast > turning { fast } else { turning };
            if over > most {
                (most, status) = (over, TipStatus::Slowed(joint));
            }
        }
        let share = most.rsqrt();
        speeds.iter_mut().for_each(|speed| *speed *= share);
        self.free = [true; V];
        let Some(bounds) = bounds else {
            return status;
        };
        for (joint, [lower, upper]) in bounds.iter().enumerate() {
            let most = self.config.limits[joint].velocity;
            let wanted = speeds[joint].clamped(-most, most);
            speeds[joint] = wanted.clamped(*lower, *upper);
            if speeds[joint] != wanted {
                (self.held[joint], self.free[joint]) = (wanted, false);
                status = TipStatus::Limited(joint);
            }
        }
        status
    }

    /// Advances all joints towards these speeds, together and within their limits.
    #[inline(always)]
    fn advance(&mut self, bounds: Option<&[[R; 2]; V]>, speeds: &[R; V]) {
        let (h, half, [_, per_tick]) = (self.config.tick, R::from_f64(0.5), self.inverse);
        let old = self.state.qd;
        let changes: [R; V] = core::array::from_fn(|j| speeds[j] - old[j]);
        // The greatest change over the one that the acceleration allows.
        let mut most = h;
        for (change, [_, per_limit]) in changes.iter().zip(&self.per_limit) {
            let over = change.abs() * *per_limit;
            most = if over > most { over } else { most };
        }
        let (share, per_tick) = (h / most, per_tick * less::<R>());
        for j in 0..V {
            let change = share * changes[j];
            let (mut new, mut qdd) = (old[j] + change, change * per_tick);
            if let Some(bounds) = bounds {
                let ([lower, upper], a) = (bounds[j], self.config.limits[j].acceleration);
                let kept = new.clamped(lower, upper);
                if kept != new {
                    new = kept.clamped(old[j] - a * h, old[j] + a * h);
                    qdd = ((new - old[j]) * per_tick).clamped(-a, a);
                }
            }
            let (q, way) = (self.state.q[j], half * h * (old[j] + new) + self.rest[j]);
            (self.state.q[j], self.state.qd[j]) = (q + way, new);
            self.rest[j] = way - (self.state.q[j] - q);
            self.state.qdd[j] = qdd;
        }
    }
}

impl<R: Real, const V: usize> Reference<R, V> for TipMotion<R, V> {
    #[inline(always)]
    fn at(&self, _: u32) -> State<R, V, V> {
        self.state
    }

    fn ticks(&self) -> u32 {
        0
    }
}

/// A pose that a tip moves to, as a twist for [`TipMotion::step`].
///
/// ```
/// use motion_control::motion::TipGoal;
/// use dynamics_core::{algorithms::frame::Pose, glam::DVec3};
/// let pose = Pose { pos: DVec3::X, ..Pose::<f64>::IDENTITY };
/// let goal = TipGoal { pose, gain: 4.0, linear: 0.25, angular: 1.0 };
/// assert_eq!(goal.twist(&Pose::IDENTITY).lin, DVec3::X * 0.25); // 4/s · 1 m, limited to 0.25 m/s
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipGoal<R: Real> {
    /// The pose in the base's frame.
    pub pose: Pose<R>,
    /// Speed per distance, 1/s: the joints decelerate by as many times their speed, so that 4 suits
    /// 2 rad/s and 10 rad/s².
    pub gain: R,
    /// The greatest linear speed, m/s.
    pub linear: R,
    /// The greatest angular speed, rad/s.
    pub angular: R,
}

impl<R: Real> TipGoal<R> {
    /// The twist of a tip at `pose` towards the goal, rad/s and m/s, in the base's axes: straight
    /// on and about one axis, both at once.
    ///
    /// # Cost
    /// All data take the same instructions, but for rotations next to half a turn.
    #[inline]
    #[must_use]
    pub fn twist(&self, pose: &Pose<R>) -> Motion<R> {
        let turn = turn::<R>(&pose.rot, &self.pose.rot, self.gain);
        let way = (self.pose.pos - pose.pos) * self.gain;
        // The speed that is the greater multiple of its limit decides.
        let [angular, linear] = [self.angular * self.angular, self.linear * self.linear];
        let [a, b] = [turn.dot(turn), way.dot(way)];
        let of_turn = a * linear > b * angular;
        let (square, most) = if of_turn { (a, angular) } else { (b, linear) };
        let slower = if of_turn { self.angular } else { self.linear } * square.rsqrt();
        let share = if square > most { slower } else { R::ONE };
        Motion::new(turn * share, way * share)
    }
}

/// The share of a limit that leaves room for roundings.
#[inline(always)]
fn less<R: Real>() -> R {
    R::ONE - R::from_f64(2.0 * ROUNDINGS) * R::EPSILON
}

/// `gain` times the rotation [`quaternion_error`](crate::law::quaternion_error), 2 sin(θ/2) along
/// its axis n, by the sum Σ a × w = 2 n sin θ over the axes of both attitudes; next to half a turn,
/// where that vanishes, along the longest a + w.
#[inline(always)]
fn turn<R: Real>(attitude: &R::Mat3, wanted: &R::Mat3, gain: R) -> R::Vec3 {
    let (a, w) = (attitude.cols(), wanted.cols());
    let dots: [R; 3] = core::array::from_fn(|k| a[k].dot(w[k]));
    let sum = a[0].cross(w[0]) + a[1].cross(w[1]) + a[2].cross(w[2]);
    // 4 cos²(θ/2).
    let square = R::ONE + dots[0] + dots[1] + dots[2];
    if square > R::from_f64(HALF_A_TURN) {
        return sum * (gain * square.rsqrt());
    }
    let k = if dots[1] > dots[0] { 1 } else { 0 };
    let k = if dots[2] > entry(&dots, k) { 2 } else { k };
    let [a, w] = [a, w].map(|axes| axes.get(k).copied().unwrap_or(axes[0]));
    let along = a + w;
    let twice = if along.dot(sum) < R::ZERO { -gain - gain } else { gain + gain };
    along * (twice * along.dot(along).rsqrt())
}
