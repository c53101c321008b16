//! Batch identification of an arm's parameters, on the host: inertias, frictions, armatures and
//! offsets from one recording.
//!
//! | step | here |
//! |---|---|
//! | which parameters the torques depend on | [`BaseModel`] |
//! | a motion that shows all of them, chosen by condition number | [`Search`], [`Excitation`] |
//! | into the firmware, or as a controller's reference | [`FourierMotion::rust_source`], [`FourierMotion::reference`] |
//! | what was measured, in whole periods | [`Recording`] |
//! | base parameters with standard deviations | [`Batch`], [`Identified`] |
//! | the same from ticks of any motion | [`TickRecording`], [`Fit`], [`Fitted`] |
//! | parameters of each body that are possible | [`PhysicalSet`] |
//! | the parameters of a robot's file, from a record of `cargo xtask watch` | module `files`, with the feature of this name; from arrays, with the feature `arrays` |
//!
//! The recursive estimator for the tick is `motion_control::estimate::ParameterEstimator`.
//!
//! # Why the motion is periodic
//! Encoders measure positions only, and differences of their steps are useless as accelerations. A
//! periodic motion is a Fourier series in steady state: fitted to all samples of all periods it has
//! the velocity and the acceleration as exact derivatives, with the noise of n positions reduced by
//! √(2/n) a coefficient. Noise in the regressor, which biases least squares, is then negligible.
//! Torques are projected on the same harmonics, so that what the series lacks of faster motion is
//! missing from both sides.
//!
//! # Assumptions
//! The noise of the torque of a joint is independent of that of other joints and, within bands of
//! harmonics, of the motion; it need not be white. The motion repeats: the first period is not
//! recorded. The geometry is exact.
//!
//! # Example
//! ```
//! use dynamics_core::algorithms::rnea;
//! use dynamics_core::effects::{Armature, Coulomb, RIGID_BODY, Viscous, Width};
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
//! use identification::{BaseModel, Batch, ExcitationLimits, Recording, Search};
//!
//! let rod = Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.0, 0.0, -0.5]).inertia([0.1, 0.0, 0.0, 0.1, 0.0, 0.1]);
//! let pendulum: ArmModel<f64, 1> = Model::new("pendulum", [rod]);
//! let width = Width::new(0.02);
//! let limits = ExcitationLimits { lower: [-1.5], upper: [1.5], velocity: [4.0], acceleration: [20.0], torque: [30.0] };
//! let arm = BaseModel::new(pendulum, RIGID_BODY, width, limits);
//! assert_eq!(arm.name(0), "body 0 m c_x"); // then m c_z, I_yy with the armature, two frictions, and the offset
//! assert_eq!(arm.name(2), "body 0 I_yy + joint 0 armature");
//!
//! let search = Search { period: 4.0, harmonics: 5, samples: 100, starts: 2, fresh: 10, steps: 50, seed: 1 };
//! let excitation = search.run(&arm, |_| true, |_| ()).expect("within its torque");
//!
//! // What an arm would measure, here without noise.
//! let friction = (Viscous([0.8]), Coulomb { torque: [0.5], width }, Armature([0.05]));
//! let states: Vec<_> = (0..1000).map(|k| excitation.motion.at(4e-3 * f64::from(k))).collect();
//! let torques = states.iter().map(|state| rnea(&pendulum, state, &(RIGID_BODY, friction))).collect();
//! let recording = Recording::try_new(states.iter().map(|state| state.q).collect(), torques, 1000, 4e-3)?;
//!
//! let batch = Batch { delay: 0.0, ..Batch::new(40, 4e-3) };
//! let found = batch.identify(&arm, &recording)?;
//! let true_values = [0.0, -1.0, 2.0 * 0.25 + 0.1 + 0.05, 0.8, 0.5, 0.0];
//! assert!(found.base.iter().zip(true_values).all(|(found, value)| (found - value).abs() < 1e-6));
//! # Ok::<(), identification::IdentificationError>(())
//! ```
#![deny(missing_docs)]

mod base;
mod batch;
mod columns;
mod error;
mod export;
#[cfg(feature = "arrays")]
#[allow(missing_docs, reason = "the program `identify` and its tests call it")]
pub mod files;
mod fit;
mod fourier;
mod gears;
mod identified;
mod limits;
mod low_pass;
mod noise;
mod physical;
mod recording;
mod reduced;
mod search;
mod solved;
mod ticks;

pub use base::BaseModel;
pub use batch::Batch;
pub use columns::{Friction, OF_JOINT, OfJoint, Parameter};
pub use error::IdentificationError;
pub use fit::{Comparison, Fit, Fitted, Modelled};
pub use fourier::{FourierMotion, PeriodicReference};
pub use gears::Gears;
pub use identified::Identified;
pub use limits::ExcitationLimits;
pub use physical::PhysicalSet;
pub use recording::Recording;
pub use search::{Excitation, Progress, Search};
pub use ticks::{Samples, TickRecording};
