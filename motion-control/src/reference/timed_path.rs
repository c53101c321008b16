//! The fastest motion along a path within the limits of the joints: reachability analysis.
//!
//! Pham & Pham, "A New Approach to Time-Optimal Path Parameterization Based on Reachability
//! Analysis", *IEEE Transactions on Robotics* 34 (2018). With x = ṡ² and u = s̈ the torques and
//! accelerations along q(s) are linear,
//!
//! ```text
//! τ = a u + b x + c + friction      c = ID(q, 0, 0)   a = ID(q, 0, q′) − c   b = ID(q, q′, q″) − c
//! q̈ = q′ u + q″ x                   x_{k+1} = x_k + 2 Δ u_k
//! ```
//!
//! Backward along the grid, K_k is the set of those x from which u leads into K_{k+1} within the
//! limits; forward, x takes the greatest u that leads into K_{k+1}. Each segment has the limits at
//! both of its ends ("first-order interpolation" in section III-C of the paper), with one u.
//!
//! Here the torques at rest are within their limits at every grid point, else the path is refused.
//! Then x = u = 0 is within all limits, every K_k is an interval from zero, and no stage is
//! infeasible.

use crate::entry;
use crate::real;
use crate::reference::{GeometricPath, Reference};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

mod coefficients;
mod error;
mod friction;
mod half_plane;
mod limits;
mod passes;
mod stage;
#[cfg(test)]
mod tests;

pub use error::TimedPathError;
pub use limits::{JointFriction, PathLimits};

/// The fastest motion along a path, from rest to rest, within limits of torque, speed and
/// acceleration: the reference of a controller.
///
/// The limits hold at the M points of [`GeometricPath::grid_point`], and between them up to what
/// the coefficients curve in a segment: the excess decreases with the square of M, and the time
/// that is lost with M. The guide has both for paths of the UR5e. The torques jump where a limit of
/// torque or acceleration is reached: a limit of
/// [`SafetyLimits::rate`](crate::limits::SafetyLimits::rate) has to admit this. The limits of
/// torque have to leave what the feedback needs.
///
/// ```
/// use motion_control::limits::MotionLimits;
/// use motion_control::reference::{
///     GeometricPath, JointFriction, PathLimits, PathPoint, Reference, TimedPath,
/// };
/// # struct Line;
/// # impl GeometricPath<f64, 1> for Line {
/// #     fn point(&self, s: f64) -> PathPoint<f64, 1> {
/// #         PathPoint { q: [0.8 * s], slope: [0.8], curvature: [0.0] }
/// #     }
/// # }
/// let limits = PathLimits {
///     torque: [10.0],
///     motion: [MotionLimits { velocity: f64::INFINITY, acceleration: f64::INFINITY }],
///     friction: [JointFriction::NONE],
/// };
/// // A joint of 2 kg·m² that turns by 0.8 rad accelerates with 5 rad/s² and decelerates: 2 √(0.8/5) s.
/// let motion = TimedPath::<_, _, 101>::new(&Line, 1e-3, &limits, |state| [2.0 * state.qdd[0]])?;
/// assert_eq!(motion.ticks(), 800);
/// assert!((motion.at(400).qd[0] - 2.0).abs() < 1e-3);
/// assert_eq!((motion.at(u32::MAX).q, motion.at(u32::MAX).qd), ([0.8], [0.0]));
/// # Ok::<(), motion_control::reference::TimedPathError>(())
/// ```
#[doc(alias = "TOPP")]
#[doc(alias = "TOPP-RA")]
#[doc(alias = "time-optimal path parameterization")]
#[doc(alias = "time scaling")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedPath<'a, R, P, const M: usize> {
    path: &'a P,
    grid: [GridPoint<R>; M],
    tick: R,
}

/// A part of a tick that makes no further tick at the end.
const SHORT: f64 = 1e-3;

/// A point of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
struct GridPoint<R> {
    s: R,
    /// ṡ, 1/s; while the motion is planned, x = ṡ².
    rate: R,
    /// The time at which the motion is there: the whole ticks, and the rest. While the motion is
    /// planned, the rest is x₀ of the segment that follows: where the bound of viscous friction
    /// touches it.
    ticks: u32,
    rest: R,
}

impl<'a, R: Real, P, const M: usize> TimedPath<'a, R, P, M> {
    /// The fastest motion along `path` with M ≥ 3 grid points, which the compiler checks, and ticks
    /// of `tick` seconds.
    ///
    /// `inverse_dynamics` returns the torques of a state, with gravity, inertia and velocity
    /// products and without friction, which is in the limits:
    /// [`Core::rnea`](dynamics_core::Core::rnea) or [`Engine::rnea`](dynamics_core::Engine::rnea)
    /// with such effects.
    ///
    /// # Cost
    /// Not for a tick. In two passes along the grid, with viscous friction in six: at each point
    /// four calls of the inverse dynamics, the fourth for the check that there is no friction in
    /// them, and one linear program of two variables, solved by eliminating one of them: at most (4
    /// V + 1)² pairs of limits. Constant memory: no coefficients are stored.
    ///
    /// # Errors
    /// [`TimedPathError`] names the joint and the point of the grid.
    ///
    /// ```
    /// use motion_control::limits::MotionLimits;
    /// use motion_control::reference::{
    ///     JointFriction, PathLimits, PathSpline, Reference, TimedPath,
    /// };
    /// use dynamics_core::effects::{Armature, RIGID_BODY};
    /// use dynamics_core::{Core, robots::Ur5e};
    /// let points = [[0.0_f64, -1.6, 1.6, -1.6, -1.6, 0.0], [0.5, -1.2, 1.2, -1.2, -1.2, 0.0], [1.0, -1.0, 1.4, -1.6, -1.6, 0.0]];
    /// let mut path = PathSpline::<f64, 6, 3>::EMPTY;
    /// path.fit(&points, &[0.1; 6], &[0.0; 6])?;
    /// let limits = PathLimits {
    ///     torque: [140.0, 140.0, 140.0, 25.0, 25.0, 25.0],
    ///     motion: [MotionLimits { velocity: 3.0, acceleration: 20.0 }; 6],
    ///     friction: [JointFriction { coulomb: 5.0, viscous: 2.0, certain: 0.0 }; 6],
    /// };
    /// let effects = (RIGID_BODY, Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]));
    /// let motion = TimedPath::<_, _, 65>::new(&path, 1e-3, &limits, |state| Core::<Ur5e>::rnea(state, &effects))?;
    /// assert!((500..700).contains(&motion.ticks()));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn new<const V: usize>(
        path: &'a P,
        tick: R,
        limits: &PathLimits<R, V>,
        inverse_dynamics: impl Fn(&State<R, V, V>) -> [R; V],
    ) -> Result<Self, TimedPathError>
    where
        P: GeometricPath<R, V>,
    {
        const { assert!(M >= 3, "a grid has at least three points") };
        if !(tick.is_finite() && tick > R::ZERO) {
            return Err(TimedPathError::Tick);
        }
        limits.check()?;
        let rest = GridPoint { s: R::ONE, rate: R::ZERO, ticks: 0, rest: R::ZERO };
        let mut timed = Self { path, grid: [rest; M], tick };
        for (point, at) in timed.grid.iter_mut().enumerate() {
            at.s = path.grid_point(point, M - 1);
        }
        timed.plan(limits, inverse_dynamics)?;
        timed.count_ticks()?;
        Ok(timed)
    }

    /// s at a point of the grid; 1 beyond the last one.
    pub fn grid_point(&self, point: usize) -> R {
        self.grid.get(point).map_or(R::ONE, |at| at.s)
    }

    /// x = ṡ² at a point of the grid, 1/s²; zero beyond the last one.
    pub fn square_rate(&self, point: usize) -> R {
        self.grid.get(point).map_or(R::ZERO, |at| at.rate * at.rate)
    }

    /// The duration, s.
    pub fn seconds(&self) -> R {
        self.grid.last().map_or(R::ZERO, |end| (real::<R>(end.ticks) + end.rest) * self.tick)
    }

    /// Times from x, which becomes ṡ.
    fn count_ticks(&mut self) -> Result<(), TimedPathError> {
        let (mut ticks, mut rest) = (0_u32, R::ZERO);
        let mut before: Option<GridPoint<R>> = None;
        for at in &mut self.grid {
            at.rate = if at.rate > R::ZERO { at.rate.sqrt() } else { R::ZERO };
            if let Some(before) = before {
                let step = (at.s - before.s) / self.tick;
                rest += (step + step) / (before.rate + at.rate);
                let whole = rest.to_u32();
                let sum =
                    ticks.checked_add(whole).filter(|&sum| rest.is_finite() & (sum < u32::MAX));
                ticks = sum.ok_or(TimedPathError::TooLong)?;
                rest += -real::<R>(whole);
            }
            (at.ticks, at.rest, before) = (ticks, rest, Some(*at));
        }
        if let Some(end) = self.grid.last_mut().filter(|end| end.rest < R::from_f64(SHORT)) {
            end.rest = R::ZERO;
        }
        Ok(())
    }
}

impl<R: Real, P: GeometricPath<R, V>, const V: usize, const M: usize> Reference<R, V>
    for TimedPath<'_, R, P, M>
{
    /// The reference at a tick counted from the start; from [`Self::ticks`] on, at rest at the end
    /// of the path.
    ///
    /// Cost: a binary search among M points, a division, some 15 flops, and the point of the path
    /// with 4 flops a joint.
    #[inline]
    fn at(&self, tick: u32) -> State<R, V, V> {
        let past = |at: &GridPoint<R>| at.ticks < tick || (at.ticks == tick && at.rest <= R::ZERO);
        let next = self.grid.partition_point(past);
        let k = next.saturating_sub(1);
        let (Some(from), Some(to)) = (self.grid.get(k), self.grid.get(next)) else {
            return State::at(self.path.point(R::ONE).q);
        };
        let t = (real::<R>(tick.wrapping_sub(from.ticks)) - from.rest) * self.tick;
        let half = R::from_f64(0.5);
        let half_u = half * half * (to.rate - from.rate) * (to.rate + from.rate) / (to.s - from.s);
        let s = from.s + t * (from.rate + half_u * t);
        let (u, rate) = (half_u + half_u, from.rate + (half_u + half_u) * t);
        let rate = rate.clamped(R::ZERO, if from.rate > to.rate { from.rate } else { to.rate });
        let point = self.path.point(s.clamped(R::ZERO, R::ONE));
        State {
            q: point.q,
            qd: point.slope.map(|slope| slope * rate),
            qdd: core::array::from_fn(|j| {
                entry(&point.slope, j) * u + entry(&point.curvature, j) * rate * rate
            }),
        }
    }

    fn ticks(&self) -> u32 {
        let end = self.grid.last();
        end.map_or(0, |end| end.ticks + u32::from(end.rest > R::ZERO))
    }
}
