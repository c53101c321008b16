//! Robot dynamics on a microcontroller: inverse and forward dynamics of any tree of bodies, every
//! control tick, in f32 or f64, with no heap, no panic and no `unsafe`.
//!
//! The modules, from numbers to control; what a robot is and its scalar know of each other:
//!
//! | module | what |
//! |---|---|
//! | [`scalar`], [`trig`], [`exponential`] | f32 and f64 as one type parameter; sine, cosine and e⁻ˣ without f64 |
//! | [`spatial`] | motion and force vectors, transforms, inertias |
//! | [`model`], [`robots`] | a robot's description, checked while compiling; eight real ones |
//! | [`state`], [`configuration`] | q, q̇, q̈, the sines and cosines of one configuration; steps and differences of configurations |
//! | [`transmission`] | joints that motors drive through a constant matrix |
//! | [`effects`] | what acts on the robot: only what a scene names is computed |
//! | [`algorithms`], [`Core`] | inverse and forward dynamics, M, kinematics, momenta, operational space: the textbook, for every model and for robots known at compile time |
//! | [`Engine`] | inverse and forward dynamics, M and the tip's Jacobian, specialised by the compiler for a robot known at compile time |
//! | [`control`] | trajectories, observer, control law, safety gate |
//! | [`flexible`] | joints driven through springs: their plant and their inverse dynamics |
//! | [`sim`] | time steps of a simulated robot, and its actuators |
//!
//! ```
//! use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e, state::State};
//! let reference = State { q: [0.0_f32, -1.2, 1.5, 0.3, 0.7, 0.0], qd: [0.5; 6], qdd: [1.0; 6] };
//! let tau = Engine::<Ur5e>::rnea(&reference, &RIGID_BODY); // N·m for each motor
//! assert!(tau.iter().all(|tau| tau.is_finite()));
//! ```
//!
//! Cargo features, off by default, neither of which changes a number:
//!
//! - `defmt`: `defmt::Format` for what firmware logs: faults, modes, status, commands, errors, states, forces.
//! - `serde`: `Serialize` and `Deserialize` for what firmware keeps in flash: bounds, gains, limits, way-points, states,
//!   inertias, friction. Types that a constructor checks are built from these by that constructor.
//!
//! `examples/` in the crate has a file for each use.
//!
#![doc = include_str!("../NOTATION.md")]
#![cfg_attr(not(test), no_std)]
#![forbid(unsafe_code)]

pub mod algorithms;
mod articulated;
pub mod configuration;
mod const_math;
pub mod control;
#[cfg(feature = "defmt")]
mod defmt_form;
pub mod effects;
mod engine;
pub mod exponential;
pub mod flexible;
mod lie;
mod mass_matrix;
pub mod model;
pub mod robots;
pub mod scalar;
#[cfg(feature = "serde")]
mod serde_form;
pub mod sim;
pub mod spatial;
pub mod state;
mod symmetric;
pub mod transmission;
pub mod trig;

mod core_form;
pub use core_form::Core;
pub use engine::Engine;
pub use mass_matrix::{Factor, MassMatrix};

/// The vectors and matrices of the public API. Depend on them through this re-export: another minor version of glam
/// has other types.
///
/// ```
/// use dynamics_core::effects::GravityAlong;
/// use dynamics_core::glam::Vec3;
/// let on_a_wall = GravityAlong::<f32>(Vec3::new(9.81, 0.0, 0.0));
/// assert_eq!(on_a_wall.0.length(), 9.81);
/// ```
pub use glam;
