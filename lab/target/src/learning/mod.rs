//! Scene `so101_learn`: an SO-101 whose parameters are off by 30 % finds them in half a minute of motion, computes with them from
//! then on, and weighs what it is given to carry.
//!
//! | module | what |
//! |---|---|
//! | [`parameters`] | the 90 parameters of the arm, and the engine's model of them |
//! | [`selected`] | the nominal parameters and the 24 base parameters of the motion, selected on the host |
//! | [`arm`] | the simulated arm, with friction of either kind |
//! | [`firmware`] | a tick: observer, row, update, law, gate, in the regions of the meter |
//! | [`run`] | learning, then the load |
//! | [`tag_k`] | another estimator of a load, for comparison |
//!
//! The code is the same on the host and in QEMU, and so are the torques, to the bit.

pub mod arm;
pub mod firmware;
pub mod parameters;
pub mod run;
#[rustfmt::skip]
pub mod selected;
pub mod tag_k;

/// A tick, s.
pub const TICK: f32 = 2e-3;
