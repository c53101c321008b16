//! What inverse dynamics costs on the Panda.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/inverse.rs"]
mod inverse;

use cortex_m_rt::entry;
use dynamics_core::robots::Panda;

#[entry]
fn main() -> ! {
    inverse::run::<Panda, 7, 7>()
}
