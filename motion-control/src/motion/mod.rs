//! A whole control loop without its law and devices, and how it comes to rest and starts again.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`MotionController`] | a control loop without its law and devices: all of the following items with memory | the state of a loop |
//! | [`ContactReaction`] | what an arm does after a contact: stop, go back along its path, float | the last path |
//! | [`hold()`] | the reference of a held arm: q̈ = −λ q̇ | none |
//! | [`TipMotion`], [`TipGoal`] | a tip that follows a joystick or goes to a pose, within limits of the joints | the reference |
//! | [`PoseSolver`] | positions of the joints for a pose of the tip | none |
//! | [`Approach`] | the way from any pose to the start of a motion | none |
//! | [`BackOff`] | the return of an arm that is beyond its bounds | how far it has come back |

pub(crate) mod approach;
pub(crate) mod back_off;
pub(crate) mod contact_reaction;
pub(crate) mod controller;
pub(crate) mod damped_motion;
pub(crate) mod hold;
pub(crate) mod pose_solver;
pub(crate) mod resume;
pub(crate) mod tip_motion;

pub use approach::{Approach, ApproachError};
pub use back_off::{BackOff, BackOffConfig};
pub use contact_reaction::{ContactPhase, ContactReaction, ContactReactionConfig, ContactResponse};
pub use controller::circles::OnCircles;
pub use controller::config::MotionControllerConfig;
pub use controller::tick::{ObservedTick, ReferencedTick};
pub use controller::{CurrentTick, MeasurementAge, MotionController, PreviousTick, ResetError};
pub use hold::hold;
pub use pose_solver::{PoseSolution, PoseSolver, PoseSolverError};
pub use tip_motion::{TipGoal, TipMotion, TipMotionConfig, TipStatus};
