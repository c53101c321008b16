//! Machines with kinematic loops, and their random states.

pub mod distance;
pub mod export;
pub mod machines;
pub mod states;
pub mod wrenches;
