//! The linkages of the library, one a file.

mod belt;
mod constant;
mod dyad;
mod five_bar;
mod four_bar;
mod parallel_ankle;
mod zero;

pub use belt::Belt;
pub use constant::Differential;
pub use dyad::Branch;
pub use five_bar::FiveBar;
pub use four_bar::FourBar;
pub use parallel_ankle::{ParallelAnkle, Rod};
