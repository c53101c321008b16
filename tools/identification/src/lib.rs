//! Identification of an arm's parameters, on the host: inertias, frictions, armatures and offsets
//! from one recording.
//!
//! | step | here |
//! |---|---|
//! | which parameters the torques depend on | [`BaseModel`] |
//! | a motion that shows all of them, chosen by condition number | [`Search`], [`Excitation`] |
//! | into the firmware, or as a controller's reference | [`FourierMotion::rust_source`], [`FourierMotion::reference`] |
//! | what was measured in each tick, of this or any motion | [`TickRecording`] |
//! | base parameters with standard deviations | [`Fit`], [`Fitted`] |
//! | parameters of each body that are possible | [`PhysicalSet`] |
//! | the parameters of a robot's file, from a record of `cargo xtask watch` | module `files`, with the feature of this name; from arrays, with the feature `arrays` |
//!
//! The recursive estimator for the tick is `motion_control::estimate::ParameterEstimator`.
//!
//! # Assumptions
//! The noise of the torque of a joint is independent of that of other joints and of the motion; it
//! need not be white. The geometry is exact.
//!
//! # Example
//! The one of [`Fit`] identifies a pendulum.
#![deny(missing_docs)]

mod base;
mod columns;
mod error;
mod export;
#[cfg(feature = "arrays")]
#[allow(missing_docs, reason = "the program `identify` and its tests call it")]
pub mod files;
mod fit;
mod fourier;
mod gears;
mod limits;
mod low_pass;
mod physical;
mod reduced;
mod search;
mod solved;
mod ticks;

pub use base::BaseModel;
pub use columns::{Friction, OF_JOINT, OfJoint, Parameter};
pub use error::IdentificationError;
pub use fit::{Comparison, Fit, Fitted, Modelled};
pub use fourier::{FourierMotion, PeriodicReference};
pub use gears::Gears;
pub use limits::ExcitationLimits;
pub use physical::PhysicalSet;
pub use search::{Excitation, Progress, Search};
pub use ticks::{Samples, TickRecording};
