//! The core on the host: recordings of independent oracles, one tolerance table, and the robots
//! as those oracles are given them.

pub mod export;
pub mod fuzz;
pub mod hard;
pub mod measured;
pub mod odd;
pub mod random;
pub mod recordings;
pub mod tolerances;
pub mod trees;
pub mod wide;
