//! Machines with kinematic loops, and their random states.

pub mod export;
pub mod machines;
pub mod recorded;
pub mod states;
pub mod wrenches;
