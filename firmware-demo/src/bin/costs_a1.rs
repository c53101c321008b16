//! What the algorithms cost on the A1.
#![no_std]
#![no_main]

mod costs;

use cortex_m_rt::entry;
use dynamics_core::robots::A1;

#[entry]
fn main() -> ! {
    costs::run::<A1, 16, 12>()
}
