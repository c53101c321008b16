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

use super::real;
use crate::scalar::Real;
use crate::state::{State, all_finite};

mod error;
mod rest_to_rest;
mod segment;
#[cfg(test)]
mod tests;

pub use error::TrajectoryError;
pub use rest_to_rest::RestToRest;
use segment::Segment;

/// A configuration and the velocity at which to pass it, at zero acceleration.
///
/// ```
/// use dynamics_core::control::WayPoint;
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

/// The limits of a joint's motion that a trajectory respects; a supervisor enforces [`super::SafetyLimits`].
#[doc(alias = "Speed")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionLimits<R> {
    /// Greatest |q̇|, rad/s or m/s.
    pub velocity: R,
    /// Greatest |q̈|, rad/s² or m/s².
    pub acceleration: R,
}

impl<R: Real> MotionLimits<R> {
    /// Compares the speed that a joint needs before a point with its limit; a NaN is rejected.
    fn admits_speed(&self, needed: R, point: usize, joint: usize) -> Result<(), TrajectoryError> {
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

    /// Compares the acceleration that a joint needs before a point with its limit; a NaN is rejected.
    fn admits_acceleration(
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

/// The motion of V joints through W way-points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trajectory<R, const V: usize, const W: usize> {
    /// The segments; the last one is the rest at the end.
    segments: [Segment<R, V>; W],
    ticks: u32,
}

impl<R: Real, const V: usize, const W: usize> Trajectory<R, V, W> {
    /// The trajectory through `points`, with ticks of `tick` seconds; W ≥ 1, which the compiler
    /// checks.
    ///
    /// The peaks that are compared with `limits` are exact, up to rounding. Positions between way-points that pass at
    /// speed may overshoot them.
    ///
    /// # Errors
    /// [`TrajectoryError`] names the way-point, the joint, and what was needed and allowed.
    ///
    /// ```
    /// use dynamics_core::control::{MotionLimits, Trajectory, TrajectoryError, WayPoint};
    /// let points = [
    ///     WayPoint { q: [0.0_f32], qd: [0.0], ticks: 0 },
    ///     WayPoint { q: [1.0], qd: [0.0], ticks: 1000 },
    /// ];
    /// let slow = [MotionLimits { velocity: 1.0, acceleration: 10.0 }];
    /// let error = Trajectory::new(&points, 1e-3, &slow).unwrap_err();
    /// assert_eq!(error, TrajectoryError::Velocity { point: 1, joint: 0, needed: 1.875, allowed: 1.0 });
    /// ```
    pub fn new(
        points: &[WayPoint<R, V>; W],
        tick: R,
        limits: &[MotionLimits<R>; V],
    ) -> Result<Self, TrajectoryError> {
        let (segments, ticks) = segments(points, tick, false, |point, segment| {
            segment.check(point, limits)
        })?;
        Ok(Self { segments, ticks })
    }

    /// The reference at a tick counted from the start; from [`Self::ticks`] on, at rest at the last way-point.
    ///
    /// Time is counted in integers, and in fractions only within a segment, so that the accuracy does not decrease with
    /// time. Cost: about 45 flops for the segment and 17 per joint, no division, and 4 instructions per way-point to
    /// find the segment; the same instructions for all ticks.
    ///
    /// ```
    /// use dynamics_core::control::{MotionLimits, Trajectory, WayPoint};
    /// let points = [
    ///     WayPoint { q: [0.0_f32], qd: [0.0], ticks: 0 },
    ///     WayPoint { q: [1.0], qd: [0.0], ticks: 1000 },
    /// ];
    /// let quick = [MotionLimits { velocity: 2.0, acceleration: 10.0 }];
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
        let s = real::<R>(tick.wrapping_sub(segment.start)) * segment.ticks_inv;
        segment.at(s)
    }

    /// Ticks from the first way-point to the last.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }
}

/// The segments between way-points, the rest at the end last, and the ticks that they take; `stops` if every
/// way-point has to be at rest.
fn segments<R: Real, const V: usize, const W: usize>(
    points: &[WayPoint<R, V>; W],
    tick: R,
    stops: bool,
    check: impl Fn(usize, &Segment<R, V>) -> Result<(), TrajectoryError>,
) -> Result<([Segment<R, V>; W], u32), TrajectoryError> {
    const { assert!(W > 0, "a trajectory has at least one way-point") };
    if !(tick.is_finite() && tick > R::ZERO) {
        return Err(TrajectoryError::Tick);
    }
    for (point, p) in points.iter().enumerate() {
        let end = stops || point == 0 || point == W - 1;
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
        check(point, segment)?;
        ticks = match ticks.checked_add(to.ticks) {
            Some(sum) => sum,
            None => return Err(TrajectoryError::Ticks { point }),
        };
    }
    if let Some(rest) = segments.last_mut() {
        rest.start = ticks;
    }
    Ok((segments, ticks))
}
