//! The machines: planar linkages in space, and two parallel robots.

mod delta;
mod planar;
mod stewart;

pub use firmware_demo::robots::planar_loops::{
    FOUR_BAR, FiveBar, FourBar, Parallelogram, ThreeMotors,
};
pub use firmware_demo::robots::{Delta, FlatDelta};
pub use stewart::{SimilarStewart, Stewart};

use dynamics_core::loops::LoopRobot;

/// A machine with a configuration near which it is tested.
pub trait Machine<
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>: LoopRobot<B, Q, V, L, C, A>
{
    /// A configuration that is nearly closed.
    const HOME: [f64; Q];
    /// The range of the actuated coordinates about it, rad or m.
    const RANGE: f64;
    /// The index in q of each actuated coordinate.
    const ACTUATED_Q: [usize; A];
}
