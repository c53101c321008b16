//! The linkages of the library, one file each.

/// Expands a block for each of these numbers, in place of a loop, which might not be unrolled:
/// angles that no effect reads are then computed.
macro_rules! unrolled {
    ($i:ident in $($n:literal)*, $body:block) => {$({
        const $i: usize = $n;
        $body
    })*};
}

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
