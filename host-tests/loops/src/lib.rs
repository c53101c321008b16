//! Machines with kinematic loops, their random states, and the hard cases of them.

pub mod distance;
pub mod export;
pub mod hard;
pub mod machines;
pub mod recorded;
pub mod states;
pub mod wrenches;
