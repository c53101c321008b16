//! Joint trajectories from stop to stop with four derivatives, for the inverse dynamics of
//! compliant joints.
//!
//! The polynomial of degree nine whose first four derivatives vanish at both ends; with s = t/T, D
//! the step, u = s (1 − s) and w = 1 − 2 s,
//!
//! ```text
//! q = q₀ + D s⁵ (126 − 420 s + 540 s² − 315 s³ + 70 s⁴)
//! q̇ = D/T · 630 u⁴                    q⁽³⁾ = D/T³ · 2520 u² (3 − 14 u)
//! q̈ = D/T² · 2520 u³ w               q⁽⁴⁾ = D/T⁴ · 15120 u w (1 − 7 u)
//! ```
//!
//! The regularised incomplete beta function I_s(5, 5) and its derivatives.

use super::error::TrajectoryError;
use super::segment::{Segment, WayPoint};
use super::segments::Segments;
use crate::limits::MotionLimits;
use crate::real;
use crate::reference::Reference;
use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// The greatest of |q̇| T/|D|, at s = 1/2: 630/4⁴.
const SPEED: f64 = 630.0 / 256.0;
/// The greatest of |q̈| T²/|D|, at u = 3/14: 2520 (3/14)³ √(1/7).
const ACCELERATION: f64 = 2520.0 * 27.0 / 2744.0 * 0.377_964_473_009_227_2;

/// The motion of V joints from stop to stop, W of them, smooth to the fourth derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestToRest<R, const V: usize, const W: usize> {
    segments: Segments<R, V, W>,
}

impl<R: Real, const V: usize, const W: usize> RestToRest<R, V, W> {
    /// The motion that stops in each of `points`, with ticks of `tick` seconds.
    ///
    /// # Errors
    /// As [`Trajectory::new`](super::Trajectory::new); the velocity at every way-point must be
    /// zero.
    ///
    /// ```
    /// use motion_control::limits::MotionLimits;
    /// use motion_control::reference::{RestToRest, TrajectoryError, WayPoint};
    /// let stop = |q, ticks| WayPoint { q: [q], qd: [0.0_f32], ticks };
    /// let points = [stop(0.0, 0), stop(1.0, 1000)];
    /// let slow = [MotionLimits { velocity: 2.0, acceleration: 20.0 }];
    /// let error = RestToRest::new(&points, 1e-3, &slow).unwrap_err();
    /// assert_eq!(error, TrajectoryError::Velocity { point: 1, joint: 0, needed: 2.4609375, allowed: 2.0 });
    /// ```
    pub fn new(
        points: &[WayPoint<R, V>; W],
        tick: R,
        limits: &[MotionLimits<R>; V],
    ) -> Result<Self, TrajectoryError> {
        let mut segments = Segments::REST;
        segments.plan(points, tick, true, |point, segment| check(point, segment, limits))?;
        Ok(Self { segments })
    }

    /// Position and four derivatives at a tick counted from the start; after the end, at rest at
    /// the last stop.
    ///
    /// Cost: about 40 flops for the segment and 9 per joint, no division.
    ///
    /// ```
    /// use motion_control::limits::MotionLimits;
    /// use motion_control::reference::{RestToRest, WayPoint};
    /// # use motion_control::reference::TrajectoryError;
    /// let stop = |q, ticks| WayPoint { q: [q], qd: [0.0_f32], ticks };
    /// let quick = [MotionLimits { velocity: 3.0, acceleration: 20.0 }];
    /// let smooth = RestToRest::new(&[stop(0.0, 0), stop(1.0, 1000)], 1e-3, &quick)?;
    /// let middle = smooth.elastic_reference(500);
    /// assert_eq!((middle.state.q, middle.jerk, middle.snap), ([0.5], [-78.75], [0.0]));
    /// assert_eq!(smooth.elastic_reference(1000).state.q, [1.0]);
    /// # Ok::<(), TrajectoryError>(())
    /// ```
    pub fn elastic_reference(&self, tick: u32) -> ElasticReference<R, V, V> {
        let zero = [R::ZERO; V];
        let mut course = ElasticReference { state: State::at(zero), jerk: zero, snap: zero };
        let Some(segment) = self.segments.find(tick) else {
            return course;
        };
        let weights = weights(segment, tick);
        for (j, &[q_0, step, ..]) in segment.joints.iter().enumerate() {
            let [q, qd, qdd, jerk, snap] = weights.map(|weight| weight * step);
            let state = &mut course.state;
            let places = [
                (&mut state.q, q_0 + q),
                (&mut state.qd, qd),
                (&mut state.qdd, qdd),
                (&mut course.jerk, jerk),
                (&mut course.snap, snap),
            ];
            for (place, value) in places {
                if let Some(place) = place.get_mut(j) {
                    *place = value;
                }
            }
        }
        course
    }
}

impl<R: Real, const V: usize, const W: usize> Reference<R, V> for RestToRest<R, V, W> {
    fn at(&self, tick: u32) -> State<R, V, V> {
        self.elastic_reference(tick).state
    }

    fn ticks(&self) -> u32 {
        self.segments.ticks
    }
}

/// The factors of D in q and its derivatives.
fn weights<R: Real, const V: usize>(segment: &Segment<R, V>, tick: u32) -> [R; 5] {
    let number = R::from_f64;
    let s = real::<R>(tick.wrapping_sub(segment.start)) * segment.ticks_inv;
    let (u, w) = (s * (R::ONE - s), R::ONE - number(2.0) * s);
    let (uu, t_inv) = (u * u, segment.seconds_inv);
    let tt_inv = t_inv * t_inv;
    let inner = [number(-315.0), number(540.0), number(-420.0), number(126.0)];
    let horner = inner.into_iter().fold(number(70.0), |sum, c| sum * s + c);
    [
        s * s * s * s * s * horner,
        t_inv * (number(630.0) * uu * uu),
        tt_inv * (number(2520.0) * uu * u * w),
        tt_inv * t_inv * (number(2520.0) * uu * (number(3.0) - number(14.0) * u)),
        tt_inv * tt_inv * (number(15120.0) * u * w * (R::ONE - number(7.0) * u)),
    ]
}

/// Compares the peaks of speed and acceleration with the limits; `point` ends the segment.
fn check<R: Real, const V: usize>(
    point: usize,
    segment: &Segment<R, V>,
    limits: &[MotionLimits<R>; V],
) -> Result<(), TrajectoryError> {
    let seconds_inv = segment.seconds_inv;
    for (joint, (&[_, step, ..], limit)) in segment.joints.iter().zip(limits).enumerate() {
        let speed = R::from_f64(SPEED) * step.abs() * seconds_inv;
        limit.admits_speed(speed, point, joint)?;
        let acceleration = R::from_f64(ACCELERATION) * step.abs() * seconds_inv * seconds_inv;
        limit.admits_acceleration(acceleration, point, joint)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{motion_limits, stop};

    const TICK: f64 = 1e-3;

    fn swing() -> RestToRest<f64, 1, 2> {
        let points = [stop([-0.4], 0), stop([1.3], 800)];
        RestToRest::new(&points, TICK, &[motion_limits(10.0, 100.0)]).unwrap()
    }

    /// Central differences of one derivative are the next one, up to h²/6 of the third from there:
    /// of the snap, at the ends, (1/800)²/6 · 15120 · 42 / 945 = 1.8e-4 of full scale at most.
    #[test]
    fn each_derivative_is_the_slope_of_the_one_before() {
        let smooth = swing();
        let all = |tick| {
            let c = smooth.elastic_reference(tick);
            [c.state.q, c.state.qd, c.state.qdd, c.jerk, c.snap].map(|[x]| x)
        };
        let scale: [f64; 5] =
            core::array::from_fn(|n| (0..=800).map(|tick| all(tick)[n].abs()).fold(0.0, f64::max));
        for tick in 1..800 {
            for n in 0..4 {
                let slope = (all(tick + 1)[n] - all(tick - 1)[n]) / (2.0 * TICK);
                let error = (slope - all(tick)[n + 1]).abs() / scale[n + 1];
                assert!(error < 1.8e-4, "derivative {} at {tick}: {error:e}", n + 1);
            }
        }
    }

    #[test]
    fn the_peaks_that_are_checked_are_those_of_the_motion() {
        let smooth = swing();
        let peak = |of: fn(&ElasticReference<f64, 1, 1>) -> f64| {
            let all = (0..=800).map(|tick| of(&smooth.elastic_reference(tick)).abs());
            all.fold(0.0, f64::max)
        };
        let (step, t) = (1.7, 0.8);
        let speed = peak(|c| c.state.qd[0]) / (SPEED * step / t);
        let acceleration = peak(|c| c.state.qdd[0]) / (ACCELERATION * step / (t * t));
        assert!((0.99999..=1.0 + 1e-14).contains(&speed), "{speed}");
        let used = (0.9999..=1.0 + 1e-14).contains(&acceleration);
        assert!(used, "{acceleration}");
    }

    #[test]
    fn a_way_point_passed_at_speed_is_refused() {
        let [first, mut passed, last] = [0, 100, 100].map(|ticks| stop([0.0_f32], ticks));
        passed.qd = [0.1];
        let refused = RestToRest::new(&[first, passed, last], 1e-3, &[motion_limits(10.0, 100.0)]);
        let at_speed = TrajectoryError::NotAtRest { point: 1, joint: 0 };
        assert_eq!(refused, Err(at_speed));
    }
}
