//! The bounds of a command: limits, faults and their reactions, the command itself, errors of
//! configurations.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`Fault`], [`Reaction`] | what each fault leads to | |
//! | [`Circles`], [`OnCircles`](crate::motion::OnCircles) | which joints are points on a circle: the short way, at any number of turns | none |

pub(crate) mod circles;
pub(crate) mod command;
pub(crate) mod config_error;
pub(crate) mod fault;
pub(crate) mod motion_limits;
pub(crate) mod reaction;
pub(crate) mod safety_limits;

pub use circles::Circles;
pub use command::{Command, Mode, Status};
pub use config_error::{ConfigError, ConfigParameter};
pub use fault::Fault;
pub use motion_limits::MotionLimits;
pub use reaction::Reaction;
pub use safety_limits::{LimitKind, SafetyLimits, SafetyLimitsError};
