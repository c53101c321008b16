//! Way-points, the quintic between two of them, and its exact peaks.

use super::error::TrajectoryError;
use crate::limits::MotionLimits;
use crate::real;
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};

/// A configuration and the velocity at which to pass it, at zero acceleration.
///
/// ```
/// use motion_control::reference::WayPoint;
/// let stop = WayPoint { q: [0.3_f32, 1.2], qd: [0.0; 2], ticks: 800 };
/// # let _ = stop;
/// ```
#[doc(alias = "via point")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WayPoint<R, const V: usize> {
    /// Positions, rad or m.
    pub q: [R; V],
    /// Velocities in passing, rad/s or m/s; zero to stop.
    pub qd: [R; V],
    /// Ticks since the previous way-point; 0 for the first.
    pub ticks: u32,
}

impl<R: Real> MotionLimits<R> {
    /// Compares the speed that a joint needs before a point with its limit; a NaN is rejected.
    pub(super) fn admits_speed(
        &self,
        needed: R,
        point: usize,
        joint: usize,
    ) -> Result<(), TrajectoryError> {
        if needed.is_finite() && needed <= self.velocity {
            return Ok(());
        }
        Err(TrajectoryError::Velocity {
            point,
            joint,
            needed: needed.to_f64(),
            allowed: self.velocity.to_f64(),
        })
    }

    /// Compares the acceleration that a joint needs before a point with its limit; a NaN is
    /// rejected.
    pub(super) fn admits_acceleration(
        &self,
        needed: R,
        point: usize,
        joint: usize,
    ) -> Result<(), TrajectoryError> {
        if needed.is_finite() && needed <= self.acceleration {
            return Ok(());
        }
        Err(TrajectoryError::Acceleration {
            point,
            joint,
            needed: needed.to_f64(),
            allowed: self.acceleration.to_f64(),
        })
    }
}

/// The motion between two way-points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment<R, const V: usize> {
    pub(super) start: u32,
    /// 1 / its ticks, so that no tick divides.
    pub(super) ticks_inv: R,
    /// T.
    pub(super) seconds: R,
    /// 1 / T.
    pub(super) seconds_inv: R,
    /// q₀, D, v₀, v₁.
    pub(super) joints: [[R; 4]; V],
}

/// The factors of D, v₀ and v₁ in q, q̇ and q̈ at one time, which are those of all joints.
pub(super) struct Weights<R> {
    q: [R; 3],
    qd: [R; 3],
    qdd: [R; 3],
}

impl<R: Real, const V: usize> Segment<R, V> {
    /// Rest at zero.
    pub(super) const REST: Self = Self {
        start: 0,
        ticks_inv: R::ZERO,
        seconds: R::ZERO,
        seconds_inv: R::ZERO,
        joints: [[R::ZERO; 4]; V],
    };

    /// Rest at q, of zero duration: only the weights of zeros differ from zero.
    pub(super) fn rest(q: [R; V]) -> Self {
        Self { joints: q.map(|q| [q, R::ZERO, R::ZERO, R::ZERO]), ..Self::REST }
    }

    pub(super) fn between(start: u32, from: &WayPoint<R, V>, to: &WayPoint<R, V>, tick: R) -> Self {
        let mut joints = [[R::ZERO; 4]; V];
        let ends = from.q.iter().zip(&to.q);
        let speeds = from.qd.iter().zip(&to.qd);
        for ((joint, (&q_0, &q_1)), (&v_0, &v_1)) in joints.iter_mut().zip(ends).zip(speeds) {
            *joint = [q_0, q_1 - q_0, v_0, v_1];
        }
        let ticks = real::<R>(to.ticks);
        let seconds = ticks * tick;
        Self { start, ticks_inv: R::ONE / ticks, seconds, seconds_inv: R::ONE / seconds, joints }
    }

    #[inline(always)]
    fn weights(&self, s: R) -> Weights<R> {
        // One by one: at opt-level s an array of them is converted while the code runs, in
        // software.
        let (two, three, five) = (R::from_f64(2.0), R::from_f64(3.0), R::from_f64(5.0));
        let (six, twelve) = (R::from_f64(6.0), R::from_f64(12.0));
        let (fifteen, thirty) = (R::from_f64(15.0), R::from_f64(30.0));
        let (one, r) = (R::ONE, R::ONE - s);
        let (ss, rr, sr) = (s * s, r * r, s * r);
        let w = self.seconds_inv;
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
    pub(super) fn at(&self, s: R) -> State<R, V, V> {
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

    /// Compares the peaks of speed and acceleration with the limits; `point` ends the segment.
    pub(super) fn check(
        &self,
        point: usize,
        limits: &[MotionLimits<R>; V],
    ) -> Result<(), TrajectoryError> {
        for (joint, (&[_, step, v_0, v_1], limit)) in self.joints.iter().zip(limits).enumerate() {
            // q̈ = s r (a + b s) / T²
            let scaled = [step, v_0 * self.seconds, v_1 * self.seconds];
            let a = weigh([60.0, -36.0, -24.0].map(R::from_f64), scaled);
            let b = weigh([-120.0, 60.0, 60.0].map(R::from_f64), scaled);

            let change = [step, v_0, v_1];
            let needed = peak([R::ZERO, -a / b, R::ONE], |s| weigh(self.weights(s).qd, change));
            let needed = if all_finite(&[a, b]) { needed } else { a + b };
            limit.admits_speed(needed, point, joint)?;
            let needed = peak(jerk_roots(a, b), |s| weigh(self.weights(s).qdd, change));
            limit.admits_acceleration(needed, point, joint)?;
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

/// The zeros of d/ds \[s (1 − s)(a + b s)\], that is of 3b s² − 2(b − a) s − a; NaN where a = b =
/// 0.
fn jerk_roots<R: Real>(a: R, b: R) -> [R; 2] {
    let scale = if a.abs() > b.abs() { a.abs() } else { b.abs() };
    let (a, b) = (a / scale, b / scale);
    let half = b - a;
    let root = sqrt(a * a + a * b + b * b);
    // The sign is the one that does not cancel; the other root by Vieta.
    let k = half + if half < R::ZERO { -root } else { root };
    [k / (R::from_f64(3.0) * b), -a / k]
}

/// √x for 3/4 ≤ x ≤ 3, which the scaling of [`jerk_roots`] ensures, by Newton's method.
pub(super) fn sqrt<R: Real>(x: R) -> R {
    let mut y = R::from_f64(1.25);
    for _ in 0..6 {
        y = R::from_f64(0.5) * (y + x / y);
    }
    y
}
