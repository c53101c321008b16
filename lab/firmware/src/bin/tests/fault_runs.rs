//! Prints the digests of 100 arms under injected faults: the host prints the same ones.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use firmware_demo::target;
use fixtures::faults::{Setup, one};

#[entry]
fn main() -> ! {
    for seed in 0..100 {
        match one(seed, Setup::SOUND, |_| ()) {
            (name, Ok(outcome)) => defmt::println!(
                "run {=u32} {=str} {=u32} faults {=u64:016x}",
                seed,
                name,
                outcome.injected,
                outcome.digest.0
            ),
            (name, Err(why)) => {
                let why = defmt::Display2Format(&why);
                defmt::println!("run {=u32} {=str} {}", seed, name, why);
            }
        }
    }
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
