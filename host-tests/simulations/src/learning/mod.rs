//! An SO-101 whose parameters are off by 30 % finds them in half a minute of motion, computes with
//! them from then on, and weighs what it is given to carry.
//!
//! | module | what |
//! |---|---|
//! | [`parameters`] | the 90 parameters of the arm, and the engine's model of them |
//! | [`selected`] | the nominal parameters and the 24 base parameters of the motion, selected on the host |
//! | [`arm`] | the simulated arm, with friction of either kind |
//! | [`firmware`] | a tick: observer, row, update, law, gate |
//! | [`run`] | learning, then the load |
//! | [`select`] | the selection of those base parameters |

pub mod arm;
pub mod firmware;
pub mod parameters;
pub mod run;
pub mod select;
#[rustfmt::skip]
pub mod selected;

/// A tick, s.
pub const TICK: f32 = 2e-3;
