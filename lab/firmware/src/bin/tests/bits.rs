//! Prints the digests of the dynamics' results: the host prints the same ones.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use firmware_demo::target;
use fixtures::{hard, recorded::digests};

#[entry]
fn main() -> ! {
    digests(|robot, quantity, digest| {
        defmt::println!("bits {=str} {=str} {=u64:016x}", robot, quantity, digest.0);
    });
    hard::digests(|case, name, digest| {
        defmt::println!("bits hard {=u32} {=str} {=u64:016x}", case, name, digest.0);
    });
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
