//! What the algorithms cost on the Panda.
#![no_std]
#![no_main]

mod costs;

use cortex_m_rt::entry;
use dynamics_core::robots::Panda;

#[entry]
fn main() -> ! {
    costs::run::<Panda, 7, 7>()
}
