//! Machines with kinematic loops, robots with clusters, their states, and the hard cases of them.

pub mod clusters;
pub mod distance;
pub mod export;
pub mod hard;
pub mod machines;
pub mod recorded;
pub mod states;
pub mod wrenches;
