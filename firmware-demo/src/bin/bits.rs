//! Prints the digests of the dynamics' results: the host prints the same ones.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use firmware_demo::{bits::digests, target};

#[entry]
fn main() -> ! {
    digests(|robot, quantity, digest| {
        defmt::println!("bits {=str} {=str} {=u64:016x}", robot, quantity, digest.0);
    });
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
