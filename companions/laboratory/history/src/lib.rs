//! The ancestors of today's dynamics algorithms, from 1965 on, as they were published: to be
//! tested, counted and measured, not to be used. `docs/history.md` has the figures.
//!
//! One algorithm a file, with the letters of its source; each takes sines and cosines from outside.
//! They run on the host and on the target, in any [`Number`], and are never inlined, so that a call
//! is what is measured.
//!
//! Operations are those that Hollerbach (1980) counted: a product of 4 × 4 matrices is 64
//! products and 48 sums and one of 3 × 3 matrices 27 and 18, with all their zeros and ones; Q A,
//! the derivative of a matrix A, costs nothing; changes of sign and what the robot's constants
//! allow to compute beforehand cost nothing.
#![no_std]

pub mod balafoutis_patel;
pub mod chain;
pub mod composite_bodies;
#[cfg(not(target_os = "none"))]
pub mod counting;
pub mod counts;
pub mod hollerbach_3;
pub mod hollerbach_4;
pub mod luh_walker_paul;
pub mod matrix;
pub mod number;
pub mod polynomial;
pub mod uicker_kahn;
pub mod walker_orin;
pub mod waters;

pub use chain::{Chain, State};
pub use number::Number;
