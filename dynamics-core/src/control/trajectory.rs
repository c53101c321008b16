//! Joint trajectories through way-points: a quintic per joint and segment, at zero acceleration
//! and given velocity in each way-point.
//!
//! Craig, *Introduction to Robotics* (2005), equations (7.17) and (7.18), in the form of Hermite:
//! with s = t/T, r = 1 − s, D the step between way-points, v₀ and v₁ their velocities,
//!
//! ```text
//! q   = q₀ + D s³(1 + 3r + 6r²) + T v₀ s r³(1 + 3s)          − T v₁ r s³(1 + 3r)
//! q̇   = D/T · 30 s²r²           + v₀ r²(1 + 2s − 15s²)       + v₁ s²(1 + 2r − 15r²)
//! q̈   = D/T² · 60 s r(r − s)    − v₀/T · 12 s r(3 − 5s)      + v₁/T · 12 s r(3 − 5r)
//! ```
//!
//! The polynomials are those of all joints, and exact at both ends. The zeros of the acceleration
//! at s = 0 and 1 leave a linear factor, so that its peaks and those of the speed are roots of a
//! quadratic and of that factor: no sampling, no iteration.

use core::fmt;

use super::real;
use crate::scalar::Real;
use crate::state::{State, all_finite};

/// A configuration to pass, with the velocity in passing, at zero acceleration.
///
/// ```
/// use dynamics_core::control::WayPoint;
/// let stop = WayPoint { q: [0.3_f32, 1.2], qd: [0.0; 2], ticks: 800 };
/// # let _ = stop;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WayPoint<R, const V: usize> {
    /// Positions, rad or m.
    pub q: [R; V],
    /// Velocities in passing, rad/s or m/s; zero to stop.
    pub qd: [R; V],
    /// Ticks since the way-point before; 0 for the first.
    pub ticks: u32,
}

/// How fast a joint may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed<R> {
    /// Greatest |q̇|, rad/s or m/s.
    pub velocity: R,
    /// Greatest |q̈|, rad/s² or m/s².
    pub acceleration: R,
}

/// Why way-points make no trajectory. Points and joints count from 0; of a segment, the point that
/// ends it is named.
///
/// ```
/// use dynamics_core::control::TrajectoryError;
/// let error = TrajectoryError::Velocity { point: 2, joint: 3, needed: 3.5, allowed: 3.0 };
/// assert_eq!(
///     format!("{error}"),
///     "way-point 2, joint 3: needs a speed of 3.5000, 3.0000 allowed"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TrajectoryError {
    /// The length of a tick is not a positive number.
    Tick,
    /// A position or velocity is not finite.
    NotFinite {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
    },
    /// The first or the last way-point does not stop.
    NotAtRest {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
    },
    /// No ticks to get there (for the first point: not 0), or more than a `u32` in total.
    Ticks {
        /// The way-point.
        point: usize,
    },
    /// The joint must move faster than it may.
    Velocity {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
        /// The greatest |q̇| on the way, rad/s or m/s.
        needed: f64,
        /// The limit.
        allowed: f64,
    },
    /// The joint must accelerate more than it may.
    Acceleration {
        /// The way-point.
        point: usize,
        /// The joint.
        joint: usize,
        /// The greatest |q̈| on the way, rad/s² or m/s².
        needed: f64,
        /// The limit.
        allowed: f64,
    },
}

impl fmt::Display for TrajectoryError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Tick => write!(out, "the length of a tick is not a positive number"),
            Self::NotFinite { point, joint } => write!(
                out,
                "way-point {point}, joint {joint}: position or velocity is not finite"
            ),
            Self::NotAtRest { point, joint } => write!(
                out,
                "way-point {point}, joint {joint}: the first and the last way-point have to stop"
            ),
            Self::Ticks { point: 0 } => write!(out, "way-point 0: its ticks are not 0"),
            Self::Ticks { point } => write!(
                out,
                "way-point {point}: no ticks to get there, or more than 2^32 in total"
            ),
            Self::Velocity {
                point,
                joint,
                needed,
                allowed,
            } => write!(
                out,
                "way-point {point}, joint {joint}: needs a speed of {needed:.4}, {allowed:.4} allowed"
            ),
            Self::Acceleration {
                point,
                joint,
                needed,
                allowed,
            } => write!(
                out,
                "way-point {point}, joint {joint}: needs an acceleration of {needed:.4}, \
                 {allowed:.4} allowed"
            ),
        }
    }
}

impl core::error::Error for TrajectoryError {}

/// The motion of V joints through W way-points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trajectory<R, const V: usize, const W: usize> {
    /// The last one is the rest at the end.
    segments: [Segment<R, V>; W],
    ticks: u32,
}

impl<R: Real, const V: usize, const W: usize> Trajectory<R, V, W> {
    /// The trajectory through `points`, with ticks of `tick` seconds; W ≥ 1, which the compiler
    /// checks.
    ///
    /// The peaks that are held against `limits` are exact, up to rounding. Positions between
    /// way-points that pass at speed may overshoot them.
    ///
    /// # Errors
    /// [`TrajectoryError`] names the way-point, the joint, and what was needed and allowed.
    ///
    /// ```
    /// use dynamics_core::control::{Speed, Trajectory, TrajectoryError, WayPoint};
    /// let points = [
    ///     WayPoint { q: [0.0_f32], qd: [0.0], ticks: 0 },
    ///     WayPoint { q: [1.0], qd: [0.0], ticks: 1000 },
    /// ];
    /// let slow = [Speed { velocity: 1.0, acceleration: 10.0 }];
    /// let error = Trajectory::new(&points, 1e-3, &slow).unwrap_err();
    /// assert_eq!(error, TrajectoryError::Velocity { point: 1, joint: 0, needed: 1.875, allowed: 1.0 });
    /// ```
    pub fn new(
        points: &[WayPoint<R, V>; W],
        tick: R,
        limits: &[Speed<R>; V],
    ) -> Result<Self, TrajectoryError> {
        const { assert!(W > 0, "a trajectory has at least one way-point") };
        if !(tick.is_finite() && tick > R::ZERO) {
            return Err(TrajectoryError::Tick);
        }
        for (point, p) in points.iter().enumerate() {
            let end = point == 0 || point == W - 1;
            for (joint, (&q, &qd)) in p.q.iter().zip(&p.qd).enumerate() {
                if !all_finite(&[q, qd]) {
                    return Err(TrajectoryError::NotFinite { point, joint });
                }
                if end && qd != R::ZERO {
                    return Err(TrajectoryError::NotAtRest { point, joint });
                }
            }
            if (point == 0) != (p.ticks == 0) {
                return Err(TrajectoryError::Ticks { point });
            }
        }

        let mut segments = points.map(|p| Segment::rest(p.q));
        let mut ticks = 0_u32;
        let pairs = points.iter().zip(points.iter().enumerate().skip(1));
        for (segment, (from, (point, to))) in segments.iter_mut().zip(pairs) {
            *segment = Segment::between(ticks, from, to, tick);
            segment.check(point, limits)?;
            ticks = match ticks.checked_add(to.ticks) {
                Some(sum) => sum,
                None => return Err(TrajectoryError::Ticks { point }),
            };
        }
        if let Some(rest) = segments.last_mut() {
            rest.start = ticks;
        }
        Ok(Self { segments, ticks })
    }

    /// The reference at a tick since the start; at rest at the last way-point from [`Self::ticks`]
    /// on.
    ///
    /// As exact after a day as at once: time runs in integers, and in fractions only within a
    /// segment. Cost: about 45 flops for the segment and 17 a joint, no division, 4 instructions a
    /// way-point to find the segment; the same instructions whatever the tick.
    ///
    /// ```
    /// use dynamics_core::control::{Speed, Trajectory, WayPoint};
    /// let points = [
    ///     WayPoint { q: [0.0_f32], qd: [0.0], ticks: 0 },
    ///     WayPoint { q: [1.0], qd: [0.0], ticks: 1000 },
    /// ];
    /// let quick = [Speed { velocity: 2.0, acceleration: 10.0 }];
    /// let trajectory = Trajectory::new(&points, 1e-3, &quick)?;
    /// assert_eq!((trajectory.at(500).q, trajectory.at(500).qd), ([0.5], [1.875]));
    /// assert_eq!((trajectory.at(u32::MAX).q, trajectory.at(u32::MAX).qd), ([1.0], [0.0]));
    /// # Ok::<(), dynamics_core::control::TrajectoryError>(())
    /// ```
    #[inline(always)]
    pub fn at(&self, tick: u32) -> State<R, V, V> {
        // W ≥ 1: the compiler drops the other branch.
        let Some(mut segment) = self.segments.first() else {
            return State::at([R::ZERO; V]);
        };
        for next in &self.segments {
            segment = if next.start <= tick { next } else { segment };
        }
        let s = real::<R>(tick.wrapping_sub(segment.start)) * segment.per_tick;
        segment.at(s)
    }

    /// Ticks from the first way-point to the last.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }
}

/// The motion between two way-points.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Segment<R, const V: usize> {
    start: u32,
    /// 1 / its ticks, so that no tick divides.
    per_tick: R,
    /// T.
    seconds: R,
    /// 1 / T.
    per_second: R,
    /// q₀, D, v₀, v₁.
    joints: [[R; 4]; V],
}

/// What the joints share at one moment: the factors of D, v₀ and v₁ in q, q̇ and q̈.
struct Weights<R> {
    q: [R; 3],
    qd: [R; 3],
    qdd: [R; 3],
}

impl<R: Real, const V: usize> Segment<R, V> {
    /// Rest at q, which takes no time: every weight but those of zeros vanishes.
    fn rest(q: [R; V]) -> Self {
        Self {
            start: 0,
            per_tick: R::ZERO,
            seconds: R::ZERO,
            per_second: R::ZERO,
            joints: q.map(|q| [q, R::ZERO, R::ZERO, R::ZERO]),
        }
    }

    fn between(start: u32, from: &WayPoint<R, V>, to: &WayPoint<R, V>, tick: R) -> Self {
        let mut joints = [[R::ZERO; 4]; V];
        let ends = from.q.iter().zip(&to.q);
        let speeds = from.qd.iter().zip(&to.qd);
        for ((joint, (&q_0, &q_1)), (&v_0, &v_1)) in joints.iter_mut().zip(ends).zip(speeds) {
            *joint = [q_0, q_1 - q_0, v_0, v_1];
        }
        let ticks = real::<R>(to.ticks);
        let seconds = ticks * tick;
        Self {
            start,
            per_tick: R::ONE / ticks,
            seconds,
            per_second: R::ONE / seconds,
            joints,
        }
    }

    #[inline(always)]
    fn weights(&self, s: R) -> Weights<R> {
        let [two, three, five, six] = [2.0, 3.0, 5.0, 6.0].map(R::from_f64);
        let [twelve, fifteen, thirty] = [12.0, 15.0, 30.0].map(R::from_f64);
        let (one, r) = (R::ONE, R::ONE - s);
        let (ss, rr, sr) = (s * s, r * r, s * r);
        let w = self.per_second;
        Weights {
            q: [
                ss * s * (one + three * r + six * rr),
                self.seconds * (sr * rr * (one + three * s)),
                -(self.seconds * (sr * ss * (one + three * r))),
            ],
            qd: [
                w * (thirty * sr * sr),
                rr * (one + two * s - fifteen * ss),
                ss * (one + two * r - fifteen * rr),
            ],
            qdd: [
                w * w * (thirty * two * sr * (r - s)),
                -(w * (twelve * sr * (three - five * s))),
                w * (twelve * sr * (three - five * r)),
            ],
        }
    }

    #[inline(always)]
    fn at(&self, s: R) -> State<R, V, V> {
        let weights = self.weights(s);
        let mut state = State::at([R::ZERO; V]);
        let rates = state.qd.iter_mut().zip(&mut state.qdd);
        for ((q, (qd, qdd)), joint) in state.q.iter_mut().zip(rates).zip(&self.joints) {
            let [q_0, change @ ..] = *joint;
            *q = q_0 + weigh(weights.q, change);
            *qd = weigh(weights.qd, change);
            *qdd = weigh(weights.qdd, change);
        }
        state
    }

    /// Holds the peaks of speed and acceleration against the limits; `point` ends the segment.
    fn check(&self, point: usize, limits: &[Speed<R>; V]) -> Result<(), TrajectoryError> {
        for (joint, (&[_, step, v_0, v_1], limit)) in self.joints.iter().zip(limits).enumerate() {
            // q̈ = s r (a + b s) / T²
            let scaled = [step, v_0 * self.seconds, v_1 * self.seconds];
            let a = weigh([60.0, -36.0, -24.0].map(R::from_f64), scaled);
            let b = weigh([-120.0, 60.0, 60.0].map(R::from_f64), scaled);

            let change = [step, v_0, v_1];
            let needed = peak([R::ZERO, -a / b, R::ONE], |s| {
                weigh(self.weights(s).qd, change)
            });
            if !(all_finite(&[a, b, needed]) && needed <= limit.velocity) {
                let (needed, allowed) = (needed.to_f64(), limit.velocity.to_f64());
                return Err(TrajectoryError::Velocity {
                    point,
                    joint,
                    needed,
                    allowed,
                });
            }
            let needed = peak(jerk_roots(a, b), |s| weigh(self.weights(s).qdd, change));
            if !(needed.is_finite() && needed <= limit.acceleration) {
                let (needed, allowed) = (needed.to_f64(), limit.acceleration.to_f64());
                return Err(TrajectoryError::Acceleration {
                    point,
                    joint,
                    needed,
                    allowed,
                });
            }
        }
        Ok(())
    }
}

/// Σ weight · change.
#[inline(always)]
fn weigh<R: Real>(weights: [R; 3], change: [R; 3]) -> R {
    let ([a, b, c], [x, y, z]) = (weights, change);
    a * x + b * y + c * z
}

/// The greatest |f| over those s that lie within the segment; infinite if it overflows.
fn peak<R: Real, const K: usize>(candidates: [R; K], f: impl Fn(R) -> R) -> R {
    let mut peak = R::ZERO;
    for s in candidates {
        if R::ZERO <= s && s <= R::ONE {
            let y = f(s).abs();
            if y > peak {
                peak = y;
            } else if !y.is_finite() {
                return R::from_f64(f64::INFINITY);
            }
        }
    }
    peak
}

/// The zeros of d/ds \[s (1 − s)(a + b s)\], that is of 3b s² − 2(b − a) s − a; NaN where a = b = 0.
fn jerk_roots<R: Real>(a: R, b: R) -> [R; 2] {
    let scale = if a.abs() > b.abs() { a.abs() } else { b.abs() };
    let (a, b) = (a / scale, b / scale);
    let half = b - a;
    let root = sqrt(a * a + a * b + b * b);
    // Of the two signs the one that does not cancel; the other root by Vieta.
    let k = half + if half < R::ZERO { -root } else { root };
    [k / (R::from_f64(3.0) * b), -a / k]
}

/// √x for 3/4 ≤ x ≤ 3, which the scaling of [`jerk_roots`] ensures, by Newton's method.
fn sqrt<R: Real>(x: R) -> R {
    let mut y = R::from_f64(1.25);
    for _ in 0..6 {
        y = R::from_f64(0.5) * (y + x / y);
    }
    y
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: Speed<f64> = Speed {
        velocity: 1e9,
        acceleration: 1e9,
    };

    fn stop(q: f64, ticks: u32) -> WayPoint<f64, 1> {
        pass(q, 0.0, ticks)
    }

    fn pass(q: f64, qd: f64, ticks: u32) -> WayPoint<f64, 1> {
        WayPoint {
            q: [q],
            qd: [qd],
            ticks,
        }
    }

    /// Repeatable numbers in ±1.
    fn noise(seed: &mut u64) -> f64 {
        *seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    #[test]
    fn roots_are_square_roots() {
        for n in 75..=300 {
            let x = f64::from(n) / 100.0;
            assert!((sqrt(x) - x.sqrt()).abs() < 4e-16, "{x}");
        }
    }

    #[test]
    fn peaks_are_those_of_dense_sampling() {
        let mut seed = 1;
        for _ in 0..300 {
            let [a, b] = [noise(&mut seed), noise(&mut seed)];
            let points = [
                stop(0.0, 0),
                pass(a, 3.0 * noise(&mut seed), 700),
                pass(b, 3.0 * noise(&mut seed), 900),
                stop(noise(&mut seed), 500),
            ];
            let motion = Trajectory::new(&points, 1e-3, &[FREE]).unwrap();
            for (point, segment) in (1..4).zip(&motion.segments) {
                let samples = (0..=20_000).map(|k| segment.at(f64::from(k) / 20_000.0));
                let (qd, qdd) = samples.fold((0.0_f64, 0.0_f64), |(qd, qdd), x| {
                    (qd.max(x.qd[0].abs()), qdd.max(x.qdd[0].abs()))
                });
                // A limit just above the sampled peak holds, one just below names it.
                let limit = |velocity, acceleration| {
                    segment.check(
                        point,
                        &[Speed {
                            velocity,
                            acceleration,
                        }],
                    )
                };
                let close = 1.0 + 1e-6;
                assert_eq!(limit(qd * close, qdd * close), Ok(()));
                match limit(qd / close, qdd) {
                    Err(TrajectoryError::Velocity { needed, .. }) => {
                        assert!(needed >= qd * (1.0 - 1e-12) && needed <= qd * close);
                    }
                    other => panic!("{other:?}"),
                }
                match limit(qd * close, qdd / close) {
                    Err(TrajectoryError::Acceleration { needed, .. }) => {
                        assert!(needed >= qdd * (1.0 - 1e-12) && needed <= qdd * close);
                    }
                    other => panic!("{other:?}"),
                }
            }
        }
    }

    #[test]
    fn velocity_and_acceleration_are_the_derivatives() {
        let points = [stop(0.2, 0), pass(1.0, -0.7, 400), stop(-0.5, 600)];
        let motion = Trajectory::new(&points, 1e-3, &[FREE]).unwrap();
        for segment in &motion.segments[..2] {
            let ds = 1e-6;
            for k in 1..100 {
                let s = f64::from(k) / 100.0;
                let [before, now, after] = [s - ds, s, s + ds].map(|s| segment.at(s));
                let dt = 2.0 * ds * segment.seconds;
                assert!(((after.q[0] - before.q[0]) / dt - now.qd[0]).abs() < 1e-7);
                assert!(((after.qd[0] - before.qd[0]) / dt - now.qdd[0]).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn way_points_are_met_exactly() {
        let points = [
            stop(0.3, 0),
            pass(1.1, 0.7, 1234),
            pass(0.9, -0.2, 777),
            stop(0.1, 400),
        ];
        let motion = Trajectory::new(&points, 1e-3, &[FREE]).unwrap();
        let mut tick = 0;
        for (at, point) in points.iter().enumerate() {
            tick += point.ticks;
            let state = motion.at(tick);
            assert_eq!((state.q, state.qd, state.qdd), (point.q, point.qd, [0.0]));
            if let Some(segment) = at.checked_sub(1).and_then(|at| motion.segments.get(at)) {
                let end = segment.at(1.0);
                assert_eq!((end.qd, end.qdd), (point.qd, [0.0]));
                assert!((end.q[0] - point.q[0]).abs() < 1e-15);
            }
        }
        assert_eq!(
            (motion.ticks(), motion.at(u32::MAX)),
            (2411, State::at([0.1]))
        );
    }

    #[test]
    fn a_move_of_a_day_is_as_exact_at_its_end_as_at_its_start() {
        let day = 86_400_000;
        let end = WayPoint {
            q: [1.0_f32],
            qd: [0.0],
            ticks: 1000,
        };
        let points = [
            WayPoint { ticks: 0, ..end },
            WayPoint { ticks: day, ..end },
            WayPoint { q: [2.0], ..end },
        ];
        let limits = [Speed {
            velocity: 2.0,
            acceleration: 10.0,
        }];
        let late = Trajectory::new(&points, 1e-3, &limits).unwrap();
        let early = Trajectory::new(&[WayPoint { ticks: 0, ..end }, points[2]], 1e-3, &limits);
        let early = early.unwrap();
        for tick in 0..=1001 {
            assert_eq!(late.at(day + tick), early.at(tick));
        }
    }

    #[test]
    fn unusable_way_points_are_named() {
        let new = |points: [WayPoint<f64, 1>; 3]| Trajectory::new(&points, 1e-3, &[FREE]).err();
        let good = [stop(0.0, 0), stop(1.0, 10), stop(0.0, 10)];
        let with = |at: usize, point| {
            let mut points = good;
            points[at] = point;
            new(points)
        };
        assert_eq!(new(good), None);
        for (at, point, error) in [
            (0, stop(0.0, 1), TrajectoryError::Ticks { point: 0 }),
            (1, stop(1.0, 0), TrajectoryError::Ticks { point: 1 }),
            (2, stop(0.0, u32::MAX), TrajectoryError::Ticks { point: 2 }),
            (
                0,
                pass(0.0, 0.1, 0),
                TrajectoryError::NotAtRest { point: 0, joint: 0 },
            ),
            (
                2,
                pass(0.0, 0.1, 9),
                TrajectoryError::NotAtRest { point: 2, joint: 0 },
            ),
            (
                1,
                stop(f64::NAN, 9),
                TrajectoryError::NotFinite { point: 1, joint: 0 },
            ),
            (
                1,
                pass(0.0, f64::INFINITY, 9),
                TrajectoryError::NotFinite { point: 1, joint: 0 },
            ),
        ] {
            assert_eq!(with(at, point), Some(error));
        }
        for tick in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(
                Trajectory::new(&good, tick, &[FREE]).err(),
                Some(TrajectoryError::Tick)
            );
        }
    }

    #[test]
    fn what_overflows_is_an_error_and_so_is_a_limit_that_is_not_a_number() {
        let unlimited = Speed {
            velocity: f64::INFINITY,
            acceleration: f64::INFINITY,
        };
        for points in [
            [stop(1e308, 0), stop(-1e308, 10)],
            [stop(0.0, 0), stop(1e307, 10)],
            [stop(0.0, 0), stop(1e306, 1)],
        ] {
            assert!(Trajectory::new(&points, 1e-3, &[unlimited]).is_err());
        }
        let points = [stop(0.0, 0), stop(0.0, 10)];
        assert!(Trajectory::new(&points, 1e-3, &[unlimited]).is_ok());
        let unclear = Speed {
            acceleration: f64::NAN,
            ..unlimited
        };
        assert!(matches!(
            Trajectory::new(&points, 1e-3, &[unclear]),
            Err(TrajectoryError::Acceleration { point: 1, .. })
        ));
    }
}
