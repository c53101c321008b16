//! What the algorithms cost on the UR5e.
#![no_std]
#![no_main]

mod costs;

use cortex_m_rt::entry;
use dynamics_core::robots::Ur5e;

#[entry]
fn main() -> ! {
    costs::run::<Ur5e, 6, 6>()
}
