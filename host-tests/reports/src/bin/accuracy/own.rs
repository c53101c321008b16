//! The errors of single changes to the default way to compute a torque, on the robot of a file. Nothing is recorded of
//! it: errors are those from the core in f64.

mod inverse;
mod statistics;
mod yardsticks;

use firmware_demo::accuracy::list;
use firmware_demo::robots::Own;

/// Computes them of the one robot that there is.
macro_rules! robots {
    ($number:literal $robot:ty, $joints:expr;) => {
        const N: usize = $joints;

        fn main() {
            inverse::print::<Own<$robot>, N, N, _>(list::single::<Own<$robot>, N, N>);
        }
    };
}
include!(env!("OWN_ROBOTS"));
