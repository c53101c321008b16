//! What inverse dynamics costs on the robot of a file: a bin of `cargo xtask costs --file`.
#![no_std]
#![no_main]

mod costs;

use firmware_demo::robots::Own;

/// Measures the one robot that there is.
macro_rules! robots {
    ($number:literal $robot:ty, $joints:expr;) => {
        const N: usize = $joints;

        #[cortex_m_rt::entry]
        fn main() -> ! {
            costs::inverse::run::<Own<$robot>, N, N>()
        }
    };
}
include!(env!("OWN_ROBOTS"));
