//! Kinematic loops: a tree of bodies, closed by further joints between two of them.
//!
//! Featherstone, RBDA (2008), chapter 8. A robot with loops is a spanning tree, which is a
//! [`Robot`] as any other, and a list of [`LoopJoint`]s, [`LoopRobot::LOOPS`]. The algorithms of
//! trees are used as they are: a robot without loops costs nothing more.
//!
//! | letter | meaning |
//! |---|---|
//! | K | Jacobian of the loop constraints, C × V: K q̇ = 0 |
//! | k | K q̈ = k, the velocity products of the constraints with a minus sign |
//! | φ | error of position of the loops, rad and m |
//! | λ | the forces of the loop joints along their C constrained directions: M q̈ + C q̇ + g = τ + Kᵀ λ |
//! | y | independent coordinates, a subset of the actuated ones |
//! | G | q̇ = G ẏ and q̈ = G ÿ + ġ |
//!
//! Rows of K may depend on each other: a planar four-bar linkage in space has three rows too many,
//! and a parallelogram that lies flat one more. The rank is found at each configuration by
//! elimination with complete pivoting, relative to the size of each loop ([`RANK_TOLERANCE`]), and
//! [`LoopRows`] says which rows were redundant. There the motion does not determine the forces of
//! the loop joint: redundant rows carry no force. Near a dead point of the motors the passive
//! coordinates are damped, and [`Drive::Singular`] names the loop.
//!
//! Linkages with a closed form take fewer cycles as [`clusters`](crate::clusters).
//!
//! ```
//! use dynamics_core::effects::RIGID_BODY;
//! use dynamics_core::loops::{self, BodyFrame, LoopJoint, LoopRobot, Loops};
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot, Static};
//! use dynamics_core::state::State;
//!
//! /// A four-bar linkage on the x-z plane: a crank that is driven, a coupler on it, and a rocker.
//! struct FourBar;
//! const Y: [f64; 3] = [0.0, 1.0, 0.0];
//! impl Robot<3, 3, 3> for FourBar {
//!     const MODEL: ArmModel<f64, 3> = Model::new("four_bar", [
//!         Body::new("crank", BASE, Joint::revolute(Y)).mass(0.5).com([0.1, 0.0, 0.0]),
//!         Body::new("coupler", 0, Joint::revolute(Y)).xyz([0.2, 0.0, 0.0]).mass(1.0).com([0.25, 0.0, 0.0]),
//!         Body::new("rocker", BASE, Joint::revolute(Y)).xyz([0.6, 0.0, 0.0]).mass(0.8).com([0.2, 0.0, 0.0]),
//!     ]);
//! }
//! impl LoopRobot<3, 3, 3, 1, 5, 1> for FourBar {
//!     const LOOPS: Loops<1, 5, 1> = Loops::new(&Self::MODEL, [
//!         LoopJoint::new("coupler_rocker", Joint::revolute(Y), [
//!             BodyFrame::new(1).xyz([0.5, 0.0, 0.0]),
//!             BodyFrame::new(2).xyz([0.4, 0.0, 0.0]),
//!         ]),
//!     ], [0]); // the crank has the motor
//! }
//! const _: usize = FourBar::LOOPS.rows(0).end; // checked by `cargo check`, too
//!
//! let robot = &Static::<FourBar>::NEW;
//! let closed = loops::assemble(robot, &FourBar::LOOPS, &[-1.0_f64, 0.5, -1.5], loops::Moving::Passive)?;
//! let state = State { qd: [2.0, 0.0, 0.0], ..State::at(closed.q) }; // the crank turns, the others follow
//! let drive = loops::inverse_dynamics(robot, &FourBar::LOOPS, &state, &RIGID_BODY)?;
//! assert!(drive.tau[0].abs() > 0.5); // N·m
//! assert_eq!(drive.rows.redundant().count(), 3);
//! # Ok::<(), loops::LoopError>(())
//! ```

mod assembly;
mod chain;
mod constraints;
mod coordinate_map;
mod description;
mod elimination;
mod error;
mod factors;
mod forward_dynamics;
mod inverse_dynamics;
mod joint_constraint;
mod least_constraint;
mod loop_frame;
mod loop_joint;
mod reach;
mod singular;
mod stabilisation;
mod status;
mod thresholds;

pub use assembly::{Assembly, Moving, assemble};
pub use constraints::{Constraints, constraints};
pub use coordinate_map::{CoordinateMap, Drive, coordinate_map};
pub use description::Loops;
pub use elimination::LoopRows;
pub use error::{LoopError, LoopModelError, LoopProblem};
pub use forward_dynamics::{LoopMotion, forward_dynamics};
pub use inverse_dynamics::{LoopTorque, inverse_dynamics};
pub use loop_joint::{BodyFrame, LoopJoint};
pub use stabilisation::{Stabilisation, TIME_CONSTANT};
pub use status::{Closure, LoopRank, Mobility, OPEN, mobility};
pub use thresholds::{RANK_TOLERANCE, SINGULAR};

use crate::model::Robot;

/// A robot with L kinematic loops, of which C directions are constrained and A coordinates
/// actuated.
///
/// An impossible description does not compile; see [`Loops::new`].
pub trait LoopRobot<
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>: Robot<B, Q, V>
{
    /// The loops, and the actuated coordinates.
    const LOOPS: Loops<L, C, A>;
}
