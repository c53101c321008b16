//! Control: where the arm should be, where it is, the torque in between, and the gate that every
//! command passes.
//!
//! | item | what | memory |
//! |---|---|---|
//! | [`Trajectory`] | quintics through way-points, checked against speed and acceleration limits | none |
//! | [`Smooth`] | from stop to stop with four derivatives, for compliant joints | none |
//! | [`Reference`] | what a controller follows: a trajectory, or a motion of one's own | |
//! | [`TurnCounter`] | an encoder's counts, turns included | counts |
//! | [`Observer`] | velocity from positions | estimate |
//! | [`Gains`], [`feedback`] | K_p (q_d − q) + K_d (q̇_d − q̇) | none |
//! | [`hold`] | what a held arm is to follow: q̈ = −λ q̇ | none |
//! | [`motion_and_force`], [`Aim`] | motions and forces along a task's directions | none |
//! | [`Held`], [`Extrapolated`], [`Interpolated`], [`Linearised`] | the torque of ticks that compute no dynamics | last torques |
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
//! let limits = [Speed { velocity: 3.0, acceleration: 10.0 }; 6];
//! let trajectory = Trajectory::new(&[stop(home, 0), stop(away, 1000)], TICK, &limits)?;
//! let bounds = Bounds {
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

mod between;
mod bounds;
mod command;
mod fault;
mod hold;
mod law;
mod observer;
mod operational;
mod reference;
mod rejoin;
mod supervisor;
mod trajectory;
mod turns;

pub use between::{Extrapolated, Held, Interpolated, Linearised};
pub use bounds::{Bounds, BoundsError, Limited};
pub use command::{Command, Mode, Status};
pub use fault::Fault;
pub use hold::hold;
pub use law::{Gains, feedback};
pub use observer::{Estimate, Observer};
pub use operational::{Aim, TaskFrame, motion_and_force, turn_to};
pub use reference::Reference;
pub use rejoin::Rejoin;
pub use supervisor::Supervisor;
pub use trajectory::{Smooth, Speed, Trajectory, TrajectoryError, WayPoint};
pub use turns::TurnCounter;

use crate::scalar::Real;

/// A number of ticks as a scalar.
#[inline(always)]
fn real<R: Real>(ticks: u32) -> R {
    // One VCVT in f32: the other conversion, a call into software there, is dead code.
    R::pick_value(f64::from(ticks), ticks as f32)
}
