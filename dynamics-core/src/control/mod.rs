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
//! use dynamics_core::control::*;
//! use dynamics_core::{Core, effects::RIGID_BODY, robots::Ur5e, state::State};
//!
//! const TICK: f32 = 1e-3;
//! let home = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
//! let away = [1.0, -1.2, 1.4, -1.57, -1.57, 0.0];
//! let stop = |q, ticks| WayPoint { q, qd: [0.0; 6], ticks };
//! let limits = [Speed { velocity: 3.0, acceleration: 10.0 }; 6];
//! let trajectory = Trajectory::new(&[stop(home, 0), stop(away, 1000)], TICK, &limits)?;
//!
//! let bounds = Bounds {
//!     torque: [150.0, 150.0, 150.0, 28.0, 28.0, 28.0],
//!     rate: [20.0; 6],
//!     speed: [3.2; 6],
//!     lower: [-6.3; 6],
//!     upper: [6.3; 6],
//! };
//! const LAMBDA: f32 = 2.0 * 25.0; // how fast damping takes a speed away: K_d / M = 2 ζ ω_n
//! let mut supervisor = Supervisor::new(bounds, TICK, 100, 200).riding(5);
//! let mut observer = Observer::new(250.0, TICK);
//! let mut rejoin = Rejoin::new(TICK, LAMBDA, 200);
//! let gains = Gains::from_inertia(&[3.0, 3.0, 1.0, 0.3, 0.3, 0.3], 25.0, 1.0);
//! let (mut clock, mut expected) = (0, [0.0; 6]);
//!
//! # for _ in 0..3 {
//! let measured = Ok(&home); // or Err(Fault::Encoder { joint })
//! supervisor.admit(measured);
//! let estimate = match supervisor.seen() {
//!     true => observer.update(supervisor.last_good(), &expected),
//!     false => observer.predict(&expected),
//! };
//! let held = supervisor.watch(&estimate.qd) != Mode::Full;
//! let aim = if held {
//!     rejoin.start(&estimate, clock); // the way back will start here
//!     State::at(estimate.q) // the same law: gravity torque and damping
//! } else if rejoin.active() && supervisor.authority() < 1.0 {
//!     rejoin.at(&trajectory, supervisor.authority())
//! } else {
//!     clock = if rejoin.active() { rejoin.finish() } else { clock + 1 };
//!     trajectory.at(clock)
//! };
//! expected = if held { estimate.qd.map(|qd| -LAMBDA * qd) } else { aim.qdd };
//! let mut tau = Core::<Ur5e>::rnea(&aim, &RIGID_BODY);
//! for (tau, pd) in tau.iter_mut().zip(feedback(&gains, &aim, &estimate.q, &estimate.qd)) {
//!     *tau += pd;
//! }
//! let command = supervisor.pass(&tau); // command.torque and command.brake go to the drives
//! # assert_eq!(command.status.fault, None);
//! # assert!(!command.brake);
//! # }
//! # assert_eq!(clock, 3);
//! # Ok::<(), TrajectoryError>(())
//! ```

mod between;
mod bounds;
mod command;
mod fault;
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
