//! What inverse dynamics costs on the iiwa 14.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/inverse.rs"]
mod inverse;

use cortex_m_rt::entry;
use dynamics_core::robots::Iiwa14;

#[entry]
fn main() -> ! {
    inverse::run::<Iiwa14, 7, 7>()
}
