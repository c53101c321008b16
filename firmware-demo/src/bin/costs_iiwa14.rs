//! What the algorithms cost on the iiwa 14.
#![no_std]
#![no_main]

mod costs;

use cortex_m_rt::entry;
use dynamics_core::robots::Iiwa14;

#[entry]
fn main() -> ! {
    costs::run::<Iiwa14, 7, 7>()
}
