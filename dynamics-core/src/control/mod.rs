//! Control: where the arm should be, where it is, the torque in between, and the gate that every
//! command passes.
//!
//! | item | what | memory |
//! |---|---|---|
//! | [`Trajectory`] | quintics through way-points, checked against speed and acceleration limits | none |
//! | [`RestToRest`] | from stop to stop with four derivatives, for compliant joints | none |
//! | [`Reference`] | what a controller follows: a trajectory, or a motion of one's own | |
//! | [`MultiTurnEncoder`] | an encoder's counts, turns included | counts |
//! | [`Observer`] | velocity from positions | estimate |
//! | [`Gains`], [`feedback`] | K_p (q_d − q) + K_d (q̇_d − q̇) | none |
//! | [`hold`] | what a held arm is to follow: q̈ = −λ q̇ | none |
//! | [`hybrid_motion_force`], [`TaskCommand`] | motions and forces along a task's directions | none |
//! | [`ZeroOrderHold`], [`FirstOrderHold`], [`Interpolator`], [`InertiaUpdate`] | the torque of ticks that compute no dynamics | last torques |
//! | [`Supervisor`] | limits, plausibility, what to do on a fault | last good values |
//! | [`Rejoin`] | from where a fault left the arm back onto the trajectory | reference |
//!
//! Time is counted in integer ticks of one nominal length; nothing divides by a measured interval.
//! What has no memory gives the same bits for the same inputs whatever happened before; what has
//! memory never takes in a value that it rejects. Nothing here panics or returns NaN.
//!
//! One tick of an arm's control loop:
//!
//! ```
#![doc = include_str!("example.rs")]
//!
//! let stop = |q, ticks| WayPoint { q, qd: [0.0; 6], ticks };
//! let (home, away) = ([0.0, -1.57, 1.57, -1.57, -1.57, 0.0], [1.0, -1.2, 1.4, -1.57, -1.57, 0.0]);
//! let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6];
//! let trajectory = Trajectory::new(&[stop(home, 0), stop(away, 1000)], TICK, &limits)?;
//! let bounds = SafetyLimits {
//!     torque: [150.0, 150.0, 150.0, 28.0, 28.0, 28.0],
//!     rate: [75.0, 75.0, 75.0, 14.0, 14.0, 14.0],
//!     speed: [3.2; 6],
//!     lower: [-6.3; 6],
//!     upper: [6.3; 6],
//! };
//! let mut control = Loop::new(bounds, home);
//! for measured in [Ok(&home), Ok(&home), Err(Fault::Encoder { joint: 2 })] {
//!     let command = control.tick(&trajectory, measured);
//!     assert_eq!((command.status.fault, command.brake), (measured.err(), false));
//! }
//! # Ok::<(), TrajectoryError>(())
//! ```

mod command;
mod fault;
mod feedback;
mod hold;
mod hybrid_force;
mod multi_turn;
mod multirate;
mod observer;
mod reference;
mod resume;
mod safety_limits;
mod supervisor;
mod trajectory;

pub use command::{Command, Mode, Status};
pub use fault::Fault;
pub use feedback::{Gains, feedback};
pub use hold::hold;
pub use hybrid_force::{TaskCommand, TaskFrame, hybrid_motion_force, orientation_error};
pub use multi_turn::MultiTurnEncoder;
pub use multirate::{FirstOrderHold, InertiaUpdate, Interpolator, ZeroOrderHold};
pub use observer::{Estimate, Observer};
pub use reference::Reference;
pub use resume::Rejoin;
pub use safety_limits::{LimitKind, SafetyLimits, SafetyLimitsError};
pub use supervisor::Supervisor;
pub use trajectory::{MotionLimits, RestToRest, Trajectory, TrajectoryError, WayPoint};

use crate::scalar::Real;

/// A number of ticks as a scalar.
#[inline(always)]
fn real<R: Real>(ticks: u32) -> R {
    // One VCVT in f32: the other conversion, a call into software there, is dead code.
    R::select(f64::from(ticks), ticks as f32)
}
