//! The motion that the arm should follow: trajectories, paths, and their timing.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`Trajectory`] | quintics through way-points, checked against speed and acceleration limits | none |
//! | [`RestToRest`] | from stop to stop with four derivatives, for compliant joints | none |
//! | [`MovingGoal`] | a goal that may change at any tick, with limits of velocity, acceleration and jerk | the motion |
//! | [`Reference`] | the reference of a controller: a trajectory, or a user's own motion | |
//! | [`TaughtPath`] | way-points of an arm that is guided by hand | the way-points |
//! | [`PathSpline`], [`GeometricPath`] | a smooth path near way-points | none |
//! | [`TimedPath`] | the fastest motion along a path within limits of torque, speed and acceleration | none |

pub(crate) mod geometric_path;
pub(crate) mod goal;
pub(crate) mod path_spline;
pub(crate) mod shaper;
pub(crate) mod taught_path;
pub(crate) mod timed_path;
pub(crate) mod trajectory;

pub use geometric_path::{GeometricPath, PathPoint};
pub use goal::{GoalChange, GoalError, JerkLimits, MovingGoal};
pub use path_spline::{PathSpline, PathSplineError};
pub use shaper::{Shaped, Shaper, ShaperError, ShaperProblem, Vibration};
pub use taught_path::{Recorded, TaughtPath};
pub use timed_path::{JointFriction, PathLimits, TimedPath, TimedPathError};
pub use trajectory::{RestToRest, Trajectory, TrajectoryError, WayPoint};

use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// The motion that a controller follows: a state of V joints for each tick.
///
/// ```
/// use motion_control::reference::Reference;
/// use dynamics_core::state::State;
/// /// Two joints that stand still.
/// struct Rest([f32; 2]);
/// impl Reference<f32, 2> for Rest {
///     fn at(&self, _: u32) -> State<f32, 2, 2> {
///         State::at(self.0)
///     }
///     fn ticks(&self) -> u32 {
///         0
///     }
/// }
/// assert_eq!(Rest([0.1, 0.2]).at(7).q, [0.1, 0.2]);
/// ```
pub trait Reference<R, const V: usize> {
    /// Position, velocity and acceleration at a tick, rad and s or m and s; after the end, the
    /// final state of the motion (a trajectory is then at rest).
    fn at(&self, tick: u32) -> State<R, V, V>;

    /// Ticks from start to end.
    fn ticks(&self) -> u32;
}

/// The same state in every tick: an arm that stands still at a [`State::at`].
impl<R: Real, const V: usize> Reference<R, V> for State<R, V, V> {
    fn at(&self, _: u32) -> Self {
        *self
    }

    fn ticks(&self) -> u32 {
        0
    }
}

impl<R: Real, const V: usize, const W: usize> Reference<R, V> for Trajectory<R, V, W> {
    #[inline(always)]
    fn at(&self, tick: u32) -> State<R, V, V> {
        Trajectory::at(self, tick)
    }

    fn ticks(&self) -> u32 {
        Trajectory::ticks(self)
    }
}
