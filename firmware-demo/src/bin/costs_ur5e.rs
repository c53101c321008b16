//! What inverse dynamics costs on the UR5e.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/inverse.rs"]
mod inverse;

use cortex_m_rt::entry;
use dynamics_core::robots::Ur5e;

#[entry]
fn main() -> ! {
    inverse::run::<Ur5e, 6, 6>()
}
