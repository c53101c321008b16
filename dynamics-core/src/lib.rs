//! Robot dynamics on a microcontroller: inverse and forward dynamics of any tree of bodies, every
//! control tick, in f32 or f64, with no heap, no panic and no `unsafe`.
//!
//! The modules, in layers: each uses only those in the rows before it.
//!
//! | module | contents |
//! |---|---|
//! | `math`, [`trig`] | functions of plain numbers: sine, cosine and e⁻ˣ without f64; functions that are evaluated at compile time |
//! | [`scalar`] | f32 and f64 as one type parameter |
//! | [`spatial`] | motion and force vectors, transforms, inertias, rotations |
//! | [`model`] | a robot's description, checked while compiling |
//! | [`robots`] | real robots, from a four-legged walker's leg to a humanoid |
//! | [`state`] | q, q̇, q̈; sines and cosines of one configuration; steps and differences of configurations |
//! | [`effects`] | what acts on the robot: only what a scene names is computed |
//! | [`algorithms`] | inverse and forward dynamics, M and its factors, kinematics, momenta, operational space: the textbook, for every model |
//! | [`loops`] | kinematic loops: assembly, inverse and forward dynamics of trees that further joints close |
//! | `textbook`: [`Core`] | the same for a robot known at compile time |
//! | `engine`: [`Engine`] | inverse and forward dynamics, M and Jacobians, specialised by the compiler for a robot known at compile time |
//! | [`drivetrain`] | between motors and joints: a constant matrix that couples them, or springs |
//! | [`clusters`] | kinematic loops of closed form, such as four-bars and parallel ankles, as joints of several bodies |
//! | [`flexible`] | links that bend: modes of beams, inverse and forward dynamics with them |
//! | [`advice`] | limits and frequencies of a configuration that look like another unit, in words |
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
//! - `defmt`: `defmt::Format` for what firmware logs: errors, states, motions, forces, advice.
//! - `serde`: `Serialize` and `Deserialize` for what firmware keeps in flash: joint limits, states,
//!   inertias, friction and other effects. Types that a constructor checks are built from these by
//!   that constructor.
//!
//! `examples/` in the crate has a file for each use.
//!
#![doc = include_str!("../NOTATION.md")]
#![cfg_attr(not(test), no_std)]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

// The robots that `robot-import` writes name this crate as their users' do.
extern crate self as dynamics_core;

pub mod advice;
pub mod algorithms;
pub mod clusters;
#[cfg(feature = "defmt")]
mod defmt_form;
pub mod drivetrain;
pub mod effects;
mod engine;
pub mod flexible;
pub mod loops;
mod math;
pub mod model;
pub mod robots;
pub mod scalar;
#[cfg(feature = "serde")]
#[doc(hidden)]
pub mod serde_form;
pub mod sim;
pub mod spatial;
pub mod state;
pub mod trig;

mod textbook;
pub use algorithms::{Ltdl, MassMatrix};
pub use engine::{Engine, TreeLtdl, TreeMatrix};
pub use textbook::Core;

/// The vectors and matrices of the public API. Depend on them through this re-export: another minor
/// version of glam has other types.
///
/// ```
/// use dynamics_core::effects::GravityVector;
/// use dynamics_core::glam::Vec3;
/// let on_a_wall = GravityVector::<f32>(Vec3::new(9.81, 0.0, 0.0));
/// assert_eq!(on_a_wall.0.length(), 9.81);
/// ```
pub use glam;
