//! The linkages of the library, one a file.

mod belt;
mod constant;
mod delta;
mod dyad;
mod five_bar;
mod four_bar;
mod hook;
mod parallel_ankle;
mod stewart;
mod zero;

pub use belt::Belt;
pub use constant::Differential;
pub use delta::Delta;
pub use dyad::Branch;
pub use five_bar::FiveBar;
pub use four_bar::FourBar;
pub use parallel_ankle::{ParallelAnkle, Rod};
pub use stewart::{Leg, Stewart};
