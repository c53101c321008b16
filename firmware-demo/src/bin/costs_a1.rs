//! What inverse dynamics costs on the A1.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/inverse.rs"]
mod inverse;

use cortex_m_rt::entry;
use dynamics_core::robots::A1;

#[entry]
fn main() -> ! {
    inverse::run::<A1, 16, 12>()
}
