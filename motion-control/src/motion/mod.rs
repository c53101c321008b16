//! A whole control loop without its law and devices, and how it comes to rest and starts again.

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
