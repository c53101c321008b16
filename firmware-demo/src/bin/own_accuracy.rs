//! What single changes to the default way to compute torques cost on the robot of a file: the bin of `cargo xtask
//! accuracy --file`.
#![no_std]
#![no_main]

mod accuracy;

use firmware_demo::accuracy::list;
use firmware_demo::robots::Own;

/// Measures the one robot that there is.
macro_rules! robots {
    ($number:literal $robot:ty, $joints:expr;) => {
        const N: usize = $joints;

        #[cortex_m_rt::entry]
        fn main() -> ! {
            let mut priced = accuracy::states::<Own<$robot>, N, N, _>();
            list::single::<Own<$robot>, N, N>(&mut priced);
            accuracy::done()
        }
    };
}
include!(env!("OWN_ROBOTS"));
