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

use crate::limits::MotionLimits;
use crate::real;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

mod error;
mod rest_to_rest;
mod segment;
mod segments;
#[cfg(test)]
mod tests;

pub use error::TrajectoryError;
pub use rest_to_rest::RestToRest;
pub use segment::WayPoint;
use segments::Segments;

/// The motion of V joints through W way-points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trajectory<R, const V: usize, const W: usize> {
    segments: Segments<R, V, W>,
}

impl<R: Real, const V: usize, const W: usize> Trajectory<R, V, W> {
    /// The trajectory through `points`, with ticks of `tick` seconds; W ≥ 1, which the compiler
    /// checks.
    ///
    /// The peaks that are compared with `limits` are exact, up to rounding. Positions between
    /// way-points that pass at speed may overshoot them.
    ///
    /// # Errors
    /// [`TrajectoryError`] names the way-point, the joint, and what was needed and allowed.
    ///
    /// ```
    /// use motion_control::limits::MotionLimits;
    /// use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};
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
        let mut trajectory = Self::REST;
        trajectory.plan(points, tick, limits)?;
        Ok(trajectory)
    }

    /// Rest at zero: what a `static` contains before [`Self::plan`].
    pub const REST: Self = Self { segments: Segments::REST };

    /// Replaces the trajectory in its place by the one through `points`, as [`Self::new`], which
    /// takes several times the size of the trajectory on the stack; this takes none of it.
    ///
    /// # Errors
    /// As [`Self::new`]; the trajectory is then as before.
    ///
    /// ```
    /// use motion_control::limits::MotionLimits;
    /// use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};
    /// let point = |q: f32, ticks| WayPoint { q: [q], qd: [0.0], ticks };
    /// let limits = [MotionLimits { velocity: 2.0, acceleration: 10.0 }];
    /// let mut trajectory = Trajectory::REST;
    /// trajectory.plan(&[point(0.0, 0), point(1.0, 1000)], 1e-3, &limits)?;
    /// assert_eq!(trajectory.at(500).q, [0.5]);
    ///
    /// // Too fast: it stays as it is.
    /// assert!(trajectory.plan(&[point(0.0, 0), point(1.0, 100)], 1e-3, &limits).is_err());
    /// assert_eq!(trajectory.at(500).q, [0.5]);
    /// # Ok::<(), TrajectoryError>(())
    /// ```
    pub fn plan(
        &mut self,
        points: &[WayPoint<R, V>; W],
        tick: R,
        limits: &[MotionLimits<R>; V],
    ) -> Result<(), TrajectoryError> {
        self.segments.plan(points, tick, false, |point, segment| segment.check(point, limits))
    }

    /// The reference at a tick counted from the start; from [`Self::ticks`] on, at rest at the last
    /// way-point.
    ///
    /// Time is counted in integers, and in fractions only within a segment, so that the accuracy
    /// does not decrease with time. Cost: about 45 flops for the segment and 17 per joint, no
    /// division, and 4 instructions per way-point to find the segment; the same instructions for
    /// all ticks.
    ///
    /// ```
    /// use motion_control::limits::MotionLimits;
    /// use motion_control::reference::{Trajectory, WayPoint};
    /// let points = [
    ///     WayPoint { q: [0.0_f32], qd: [0.0], ticks: 0 },
    ///     WayPoint { q: [1.0], qd: [0.0], ticks: 1000 },
    /// ];
    /// let quick = [MotionLimits { velocity: 2.0, acceleration: 10.0 }];
    /// let trajectory = Trajectory::new(&points, 1e-3, &quick)?;
    /// assert_eq!((trajectory.at(500).q, trajectory.at(500).qd), ([0.5], [1.875]));
    /// assert_eq!((trajectory.at(u32::MAX).q, trajectory.at(u32::MAX).qd), ([1.0], [0.0]));
    /// # Ok::<(), motion_control::reference::TrajectoryError>(())
    /// ```
    #[inline(always)]
    pub fn at(&self, tick: u32) -> State<R, V, V> {
        let Some(segment) = self.segments.find(tick) else {
            return State::at([R::ZERO; V]);
        };
        let s = real::<R>(tick.wrapping_sub(segment.start)) * segment.ticks_inv;
        segment.at(s)
    }

    /// Ticks from the first way-point to the last.
    pub fn ticks(&self) -> u32 {
        self.segments.ticks
    }
}
