//! The fastest motion of one joint from any state to rest at a goal, and slower ones, with limits
//! of velocity, acceleration and jerk.
//!
//! Haschke, Weitnauer & Ritter, "On-line planning of time-optimal, jerk-limited trajectories"
//! (2008). The velocity changes from v₀ at an acceleration a₀ to v at none by the jerks σj, 0 and
//! −σj, where σ is the sign of v − v₀ − a₀|a₀|/2j, and with the peak p of the acceleration
//!
//! ```text
//! p² = j |v − v₀| + a₀²/2       t₁ = (p − σ a₀)/j       t₃ = p/j
//! p = a_max, t₂ = (p² − a_max²)/(j a_max) if p is greater than a_max
//! ```
//!
//! A motion is such a change to a velocity c, a time at c, and the change from c to rest. In a
//! direction in which the goal is beyond the place where the joint comes to rest at once, its
//! length rises with c. If this place is nearer than c = v₀ + a₀|a₀|/2j leads, the acceleration has
//! one sign throughout: the jerk is j for a time, and then the joint comes to rest at once. If this
//! c is above the limit of velocity, a lower one leads to the goal.

use super::{JerkLimits, ROUNDED};
use crate::root;
use dynamics_core::scalar::{Real, positive_part};

/// A time with one jerk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Phase<R> {
    pub(super) time: R,
    pub(super) way: R,
    /// At its start.
    pub(super) v: R,
    pub(super) a: R,
    pub(super) jerk: R,
}

/// A motion: at most seven phases, and phases of no time.
pub(super) type Course<R> = [Phase<R>; 7];

/// A change of the velocity that ends without acceleration.
#[derive(Clone, Copy)]
struct Change<R> {
    phases: [Phase<R>; 3],
    length: R,
    time: R,
}

/// The lengths and durations of both changes of a motion.
#[derive(Clone, Copy)]
struct Changes<R> {
    length: R,
    time: R,
}

/// The start of a motion and its limits, in the direction of the goal from the place where the
/// joint comes to rest at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start<R> {
    limits: JerkLimits<R>,
    /// 1/j, and 1/(j a_max).
    inverse: [R; 2],
    pub(super) direction: R,
    v: R,
    a: R,
    /// The way to the goal, and to rest.
    length: R,
    rest: R,
}

/// The fastest motion: the time of its first jerk if the acceleration has one sign, else the time at
/// the velocity c; c, from which slower motions differ; and its duration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fastest<R> {
    of_one_sign: Option<R>,
    cruise: R,
    c: R,
    pub(super) time: R,
}

impl<R: Real> Fastest<R> {
    pub(super) const UNKNOWN: Self =
        Self { of_one_sign: None, cruise: R::ZERO, c: R::ZERO, time: R::ZERO };
}

/// The share of a duration, or of the square root of a length, at which a search ends.
const NEAR: f64 = 0.02;
/// Steps of the search for a velocity, which only has to be below the root.
const STEPS: usize = 7;
/// The ratio of velocities over which [`STEPS`] do not find the root.
const FAR: f64 = 64.0;
/// Steps of the search for the velocity of a slower motion.
const SLOWER_STEPS: usize = 3;
/// Steps of the search on which the place of the end depends.
const PRECISE_STEPS: usize = 12;

impl<R: Real> Start<R> {
    pub(super) fn new(limits: &JerkLimits<R>, v: R, a: R, length: R) -> Self {
        let inverse = R::ONE / (limits.jerk * limits.acceleration);
        let inverse = [inverse * limits.acceleration, inverse];
        let mut start =
            Self { limits: *limits, inverse, direction: R::ONE, v, a, length, rest: R::ZERO };
        start.rest = start.change(v, a, R::ZERO).length;
        if length < start.rest {
            start.direction = -R::ONE;
            for number in [&mut start.v, &mut start.a, &mut start.length, &mut start.rest] {
                *number = -*number;
            }
        }
        start
    }

    /// The change from the velocity v₀ and the acceleration a₀ to the velocity v.
    #[inline(always)]
    fn change(&self, v_0: R, a_0: R, v: R) -> Change<R> {
        let (half, step) = (R::from_f64(0.5), self.limits.jerk * (v - v_0));
        let side = R::either(step < half * a_0 * a_0.abs(), -R::ONE, R::ONE);
        let square = positive_part(side * step + half * a_0 * a_0);
        self.change_by(side, [square, root(square)], [v_0, a_0], v)
    }

    /// The change to the velocity v, with p² and p.
    #[inline(always)]
    fn change_by(&self, side: R, [square, peak]: [R; 2], [v_0, a_0]: [R; 2], v: R) -> Change<R> {
        let ([half, sixth], [j_inv, ja_inv]) = ([0.5, 1.0 / 6.0].map(R::from_f64), self.inverse);
        let JerkLimits { acceleration, jerk, .. } = self.limits;
        let (mut peak, mut hold) = (peak, R::ZERO);
        if peak > acceleration {
            hold = (square - acceleration * acceleration) * ja_inv;
            peak = acceleration;
        }
        let a = side * a_0;
        let (rise, fall) = (positive_part((peak - a) * j_inv), peak * j_inv);
        let v_1 = v_0 + side * half * (a + peak) * rise;
        let v_2 = v - side * half * peak * fall;
        let (jerk, peak) = (side * jerk, side * peak);
        let ways = [
            rise * (v_0 + rise * (half * a_0 + sixth * jerk * rise)),
            half * hold * (v_1 + v_2),
            fall * (v - sixth * jerk * fall * fall),
        ];
        let phases = [
            Phase { time: rise, way: ways[0], v: v_0, a: a_0, jerk },
            Phase { time: hold, way: ways[1], v: v_1, a: peak, jerk: R::ZERO },
            Phase { time: fall, way: ways[2], v: v_2, a: peak, jerk: -jerk },
        ];
        Change { phases, length: ways[0] + ways[1] + ways[2], time: rise + hold + fall }
    }

    /// The change from the velocity c without acceleration to rest: its length and duration.
    #[inline(always)]
    fn stop(&self, c: R) -> (R, R) {
        let JerkLimits { acceleration, jerk, .. } = self.limits;
        let ([j_inv, ja_inv], half) = (self.inverse, R::from_f64(0.5));
        let square = jerk * c;
        let peak = root(square);
        let time = if peak > acceleration {
            square * ja_inv + acceleration * j_inv
        } else {
            (peak + peak) * j_inv
        };
        (half * c * time, time)
    }

    /// Both changes of a motion with the velocity c ≥ 0.
    #[inline(always)]
    fn changes(&self, c: R) -> Changes<R> {
        self.with_stop(&self.change(self.v, self.a, c), c)
    }

    #[inline(always)]
    fn with_stop(&self, first: &Change<R>, c: R) -> Changes<R> {
        let (length, time) = self.stop(c);
        Changes { length: first.length + length, time: first.time + time }
    }

    #[inline(always)]
    pub(super) fn fastest(&self) -> Fastest<R> {
        let JerkLimits { velocity, acceleration, jerk } = self.limits;
        let [j_inv, _] = self.inverse;
        let half = R::from_f64(0.5);
        let (mut top, mut most) = (velocity, self.changes(velocity));
        let mut found = (velocity, most);
        if most.length > self.length {
            // The velocity at which the acceleration has ended by one jerk.
            let level = self.v + half * self.a * self.a.abs() * j_inv;
            if level > R::from_f64(ROUNDED) * velocity {
                return self.braked(most);
            }
            let mut least = Changes { length: self.rest, time: R::ZERO };
            if (self.a < R::ZERO) & (level > R::ZERO) {
                least = self.changes(level);
            }
            if least.length > self.length {
                return self.of_one_sign(level);
            }
            // With jerk without a limit, a motion from v to c and back takes the way (c² − v²)/a,
            // which is shorter: no c is above the one of this way. The search starts from there if
            // the limit of velocity is far above.
            let v = if level > self.v { positive_part(level) } else { positive_part(self.v) };
            let way = self.length - self.rest + v * acceleration * j_inv;
            let square = v * v + acceleration * way;
            if square * R::from_f64(FAR * FAR) < velocity * velocity {
                (top, most) = self.nearer(root(square), (top, most));
            }
            // The root of the length beyond rest is nearly linear in p, c = v₀ + (p² − a₀²/2)/j.
            let base = self.v - half * self.a * self.a * j_inv;
            let p = |c: R| root(positive_part(jerk * (c - base)));
            let c = |square: R| base + square * j_inv;
            let beyond = |length: R| root(positive_part(length - self.rest));
            let goal = beyond(self.length);
            let end = |c: R, changes: Changes<R>| (p(c), beyond(changes.length) - goal, changes);
            let lowest = if level > R::ZERO { level } else { R::ZERO };
            let ends = [end(lowest, least), end(top, most)];
            let (p, changes) = below(ends, STEPS, R::from_f64(2.0 * NEAR) * goal, |p| {
                let square = p * p;
                let first = self.change_by(R::ONE, [square, p], [self.v, self.a], c(square));
                let changes = self.with_stop(&first, c(square));
                (beyond(changes.length) - goal, changes)
            });
            found = (c(p * p), changes);
            if (found.0 <= R::ZERO) | (found.1.time <= R::ZERO) {
                // The goal is where the joint comes to rest at once.
                return self.of_one_sign(level);
            }
        }
        self.by_way_of(found)
    }

    fn by_way_of(&self, (c, changes): (R, Changes<R>)) -> Fastest<R> {
        let cruise = positive_part(self.length - changes.length) / c;
        Fastest { of_one_sign: None, cruise, c, time: cruise + changes.time }
    }

    /// The motion of a joint that cannot have been at its limit of velocity before the goal, by way
    /// of a lower one.
    #[cold]
    #[inline(never)]
    fn braked(&self, most: Changes<R>) -> Fastest<R> {
        let least = Changes { length: self.rest, time: R::ZERO };
        let end = |c: R, changes: Changes<R>| (c, changes.length - self.length, changes);
        let ends = [end(R::ZERO, least), end(self.limits.velocity, most)];
        let near = R::from_f64(NEAR) * (self.length - self.rest);
        let found = below(ends, PRECISE_STEPS, near, |c| {
            let changes = self.changes(c);
            (changes.length - self.length, changes)
        });
        if found.0 <= R::ZERO { self.of_one_sign(R::ZERO) } else { self.by_way_of(found) }
    }

    /// The changes to a velocity in place of those to a greater one, if their way is long enough.
    #[cold]
    #[inline(never)]
    fn nearer(&self, c: R, far: (R, Changes<R>)) -> (R, Changes<R>) {
        let changes = self.changes(c);
        if changes.length >= self.length { (c, changes) } else { far }
    }

    /// The jerk j for a time less than that which ends the deceleration, and then to rest.
    fn of_one_sign(&self, level: R) -> Fastest<R> {
        let beyond = |t: R| {
            let (way, rest) = self.after(t);
            (way + rest.length - self.length, rest.time)
        };
        let most = positive_part(-self.a * self.inverse[0]);
        let ends = [R::ZERO, most].map(|t| {
            let (beyond, time) = beyond(t);
            (t, beyond, time)
        });
        let (t, rest) = below(ends, PRECISE_STEPS, R::ZERO, beyond);
        Fastest { of_one_sign: Some(t), cruise: R::ZERO, c: level, time: t + rest }
    }

    /// The way in a time t with the jerk j, and the change to rest after it.
    fn after(&self, t: R) -> (R, Change<R>) {
        let ([half, sixth], jerk) = ([0.5, 1.0 / 6.0].map(R::from_f64), self.limits.jerk);
        let (v, a) = (self.v + t * (self.a + half * jerk * t), self.a + jerk * t);
        let way = t * (self.v + t * (half * self.a + sixth * jerk * t));
        (way, self.change(v, a, R::ZERO))
    }

    /// The motion of a duration that is at least that of the fastest, in [`Self::direction`]; the
    /// fastest one if there is none of this kind.
    pub(super) fn course(&self, fastest: &Fastest<R>, time: R) -> Course<R> {
        let way = self.length - self.rest;
        let (mut c, mut cruise, mut of_one_sign) = (fastest.c, fastest.cruise, fastest.of_one_sign);
        if (c > R::ZERO) & (way > R::ZERO) & (time > fastest.time) {
            let late = |c_inv: R| {
                let changes = self.changes(R::ONE / c_inv);
                let cruise = (self.length - changes.length) * c_inv;
                let needed = R::either(cruise < R::ZERO, R::ZERO, cruise + changes.time);
                (needed - time, cruise)
            };
            let [least, most] = [R::ONE / c, time / way];
            let last = late(most);
            let ends = [(least, fastest.time - time, cruise), (most, last.0, last.1)];
            let slower = below(ends, SLOWER_STEPS, R::from_f64(NEAR) * time, late);
            if (slower.0 > least) & (slower.1 >= R::ZERO) {
                (c, cruise, of_one_sign) = (R::ONE / slower.0, slower.1, None);
            }
        }
        let rest = Phase { time: R::ZERO, way: R::ZERO, v: R::ZERO, a: R::ZERO, jerk: R::ZERO };
        if let Some(time) = of_one_sign {
            let (way, Change { phases: [p_2, p_3, p_4], .. }) = self.after(time);
            let p_1 = Phase { time, way, v: self.v, a: self.a, jerk: self.limits.jerk };
            return [p_1, p_2, p_3, p_4, rest, rest, rest];
        }
        let [p_1, p_2, p_3] = self.change(self.v, self.a, c).phases;
        let p_4 = Phase { time: cruise, way: cruise * c, v: c, ..rest };
        let [p_5, p_6, p_7] = self.change(c, R::ZERO, R::ZERO).phases;
        [p_1, p_2, p_3, p_4, p_5, p_6, p_7]
    }
}

/// A place below the root of a rising function between two ends, and what the function returns
/// beside its value, both of which are given at the ends: by the Illinois algorithm.
fn below<R: Real, T: Copy>(
    ends: [(R, R, T); 2],
    steps: usize,
    near: R,
    f: impl Fn(R) -> (R, T),
) -> (R, T) {
    let half = R::from_f64(0.5);
    let [(mut low, mut f_low, mut found), (mut high, mut f_high, _)] = ends;
    let (mut last_low, mut last_high) = (false, false);
    for _ in 0..steps {
        let between = f_high - f_low;
        // A number that is not finite ends the search too.
        if (f_low >= -near) | !(between.is_finite() & (between > R::ZERO)) {
            break;
        }
        let x = low - (f_low + half * near) * (high - low) / between;
        let (f_x, beside) = f(x);
        if f_x <= R::ZERO {
            (low, f_low, found) = (x, f_x, beside);
            f_high = R::either(last_low, half * f_high, f_high);
        } else {
            (high, f_high) = (x, f_x);
            f_low = R::either(last_high, half * f_low, f_low);
        }
        (last_low, last_high) = (f_x <= R::ZERO, f_x > R::ZERO);
    }
    (low, found)
}
