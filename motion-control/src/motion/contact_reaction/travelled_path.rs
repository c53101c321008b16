//! The path that a reference has travelled, and the retraction along it.
//!
//! The uniform cubic B-spline r(u) of N points P has r′ within the differences of neighbouring
//! points and r″ within their second differences (de Boor, *A Practical Guide to Splines*, 1978,
//! chapter X). The arm is at a gap g from r(0). With n steps and the quintic w from rest to rest
//! over T,
//!
//! ```text
//! q = r(n w) + (1 − w) g    |q̇| ≤ s max|w′|/T    |q̈| ≤ (s max|w″| + max|Δ²P| n² max|w′|²)/T²    s = n max|ΔP| + |g|
//! ```

use crate::entry;
use crate::limits::{Circles, MotionLimits};
use crate::motion::approach::{ACCELERATION, SPEED};
use crate::real;
use crate::reference::Reference;
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};

#[cfg(test)]
mod tests;

/// The last points of a path, at about equal distances along it, and the time in which to go back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TravelledPath<R, const V: usize, const N: usize> {
    points: [[R; V]; N],
    /// The place of the newest point.
    newest: usize,
    count: usize,
    spacing: R,
    distance: R,
    /// n of the retraction, which ends between two points.
    steps: R,
    /// g.
    gap: [R; V],
    ticks: u32,
    ticks_inv: R,
    seconds_inv: R,
}

impl<R: Real, const V: usize, const N: usize> TravelledPath<R, V, N> {
    pub(super) fn new(distance: R) -> Self {
        const { assert!(N >= 3, "a path has at least three points") };
        Self {
            points: [[R::ZERO; V]; N],
            newest: 0,
            count: 0,
            // A point is at most a tick's motion further than this from the last one: N − 1 steps
            // are at least the distance.
            spacing: distance / R::from_f64((N - 1) as f64),
            distance,
            steps: R::ZERO,
            gap: [R::ZERO; V],
            ticks: 0,
            ticks_inv: R::ZERO,
            seconds_inv: R::ZERO,
        }
    }

    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Moves the path by whole turns of the circles, so that its newest point is within half a turn
    /// of `to`.
    pub(super) fn turn_to(&mut self, circles: Circles, to: &[R; V]) {
        let newest = self.point(0);
        let turns = difference(&circles.near(&newest, to), &newest);
        if largest(&turns) > R::ZERO {
            for point in &mut self.points {
                for (q, &turn) in point.iter_mut().zip(&turns) {
                    *q += turn;
                }
            }
        }
    }

    /// Keeps positions that are further than the spacing from the newest ones.
    #[inline]
    pub(super) fn record(&mut self, q: &[R; V]) {
        let far = largest(&difference(q, &self.point(0))) >= self.spacing;
        if ((self.count == 0) | far) & all_finite(q) {
            self.newest = if self.newest + 1 < N { self.newest + 1 } else { 0 };
            if let Some(point) = self.points.get_mut(self.newest) {
                *point = *q;
            }
            self.count = (self.count + 1).min(N);
        }
    }

    /// The least time of the retraction from a place within limits; whether there is a path to go
    /// back along.
    pub(super) fn plan(&mut self, from: &[R; V], tick: R, limits: &MotionLimits<R>) -> bool {
        let (mut step, mut bend, mut length) = (R::ZERO, R::ZERO, R::ZERO);
        self.steps = R::ZERO;
        for k in 1..self.count {
            let ahead = difference(&self.point(k), &self.point(k - 1));
            let far = largest(&ahead);
            if length < self.distance {
                let share = (self.distance - length) / (far + R::MIN_POSITIVE);
                self.steps += share.clamped(R::ZERO, R::ONE);
            }
            length += far;
            step = greater(step, far);
            if k + 1 < self.count {
                let next = difference(&self.point(k + 1), &self.point(k));
                bend = greater(bend, largest(&difference(&next, &ahead)));
            }
        }
        self.gap = difference(from, &self.point(0));
        let most = step * self.steps + largest(&self.gap);
        let rate = R::from_f64(SPEED) * self.steps;
        let square = most * R::from_f64(ACCELERATION) + bend * rate * rate;
        let by_speed = most * R::from_f64(SPEED) / limits.velocity;
        // The root is that of the control tick, which has none of zero.
        let square = square / limits.acceleration + R::MIN_POSITIVE;
        let seconds = greater(by_speed, square * square.rsqrt());
        // The amount that rounding may add to a peak in f32; a time that cannot be counted is the
        // greatest count.
        let ticks = seconds / tick * R::from_f64(1.0 + 1e-5);
        self.ticks = ticks.to_u32().saturating_add(1);
        self.ticks_inv = R::ONE / real(self.ticks);
        self.seconds_inv = self.ticks_inv / tick;
        step > R::ZERO
    }

    /// The k-th newest point; the oldest one for any beyond.
    fn point(&self, k: usize) -> [R; V] {
        let back = k.min(self.count.saturating_sub(1));
        let index = if back <= self.newest { self.newest - back } else { self.newest + N - back };
        self.points.get(index).copied().unwrap_or([R::ZERO; V])
    }

    /// The points with one more at each end, in line with the last two: the spline then begins and
    /// ends at their ends.
    fn control(&self, k: usize) -> [R; V] {
        let mirrored = |end: [R; V], inner: [R; V]| -> [R; V] {
            core::array::from_fn(|j| entry(&end, j) + (entry(&end, j) - entry(&inner, j)))
        };
        match k.checked_sub(1) {
            None => mirrored(self.point(0), self.point(1)),
            Some(k) if k < self.count => self.point(k),
            _ => mirrored(
                self.point(self.count.saturating_sub(1)),
                self.point(self.count.saturating_sub(2)),
            ),
        }
    }
}

impl<R: Real, const V: usize, const N: usize> Reference<R, V> for TravelledPath<R, V, N> {
    #[cold]
    #[inline(never)]
    fn at(&self, tick: u32) -> State<R, V, V> {
        let number = R::from_f64;
        let x = real::<R>(tick.min(self.ticks)) * self.ticks_inv;
        let (n, xx, y) = (self.steps, x * x, R::ONE - x);
        let w = xx * x * (number(10.0) - number(15.0) * x + number(6.0) * xx);
        let wd = number(30.0) * xx * y * y * self.seconds_inv;
        let wdd = number(60.0) * x * y * (y - x) * self.seconds_inv * self.seconds_inv;
        let (u, rate, change) = (n * w, n * wd, n * wdd);

        let whole = u.clamped(R::ZERO, n).trunc_saturating();
        let (f, k) = (u - whole, whole.to_u32() as usize);
        let (g, half, sixth) = (R::ONE - f, number(0.5), number(1.0 / 6.0));
        let (ff, three) = (f * f, number(3.0));
        let value = [
            g * g * g,
            three * ff * f - number(6.0) * ff + number(4.0),
            three * (f + ff - ff * f) + R::ONE,
            ff * f,
        ];
        let slope =
            [-(g * g), (three * f - number(4.0)) * f, R::ONE + (number(2.0) - three * f) * f, ff];
        let bend = [g, three * f - number(2.0), R::ONE - three * f, f];
        let mut state = State {
            q: self.gap.map(|g| g * (R::ONE - w)),
            qd: self.gap.map(|g| -(g * wd)),
            qdd: self.gap.map(|g| -(g * wdd)),
        };
        for (i, ((value, slope), bend)) in value.into_iter().zip(slope).zip(bend).enumerate() {
            let point = self.control(k + i);
            let along = half * slope;
            let rates = state.qd.iter_mut().zip(&mut state.qdd);
            for ((q, (qd, qdd)), &p) in state.q.iter_mut().zip(rates).zip(&point) {
                *q += sixth * value * p;
                *qd += along * rate * p;
                *qdd += (bend * rate * rate + along * change) * p;
            }
        }
        state
    }

    fn ticks(&self) -> u32 {
        self.ticks
    }
}

fn difference<R: Real, const V: usize>(a: &[R; V], b: &[R; V]) -> [R; V] {
    core::array::from_fn(|j| entry(a, j) - entry(b, j))
}

fn largest<R: Real, const V: usize>(x: &[R; V]) -> R {
    x.iter().fold(R::ZERO, |most, x| greater(most, x.abs()))
}

fn greater<R: Real>(a: R, b: R) -> R {
    if b > a { b } else { a }
}
