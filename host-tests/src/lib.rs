//! The core on the host: recordings of independent oracles, one tolerance table, and the robots
//! as those oracles are given them.

pub mod carried;
pub mod controller;
pub mod dual;
pub mod export;
pub mod friction;
pub mod fuzz;
pub mod hard;
pub mod measured;
pub mod random;
pub mod recordings;
pub mod stress_robot;
pub mod tolerances;
pub mod true_motion;
pub mod widen;

pub use fixtures::trees;

/// What only a run with the feature `full` compiles.
#[cfg(feature = "full")]
#[macro_export]
macro_rules! in_full {
    ($($words:tt)*) => { $($words)* };
}
/// What only a run with the feature `full` compiles.
#[cfg(not(feature = "full"))]
#[macro_export]
macro_rules! in_full {
    ($($words:tt)*) => {};
}

/// Numbers of states, runs or ticks, or bounds of them: those of an everyday run, or with the
/// feature `full` the second ones.
pub const fn everyday_or_full<T: Copy>(everyday: T, full: T) -> T {
    if cfg!(feature = "full") { full } else { everyday }
}
