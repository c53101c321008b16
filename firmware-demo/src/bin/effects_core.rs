//! What every effect costs in the core's inverse dynamics.
#![no_std]
#![no_main]

#[expect(dead_code, reason = "postures are for what takes them at hand")]
mod costs;
mod effects;

use cortex_m_rt::entry;
use dynamics_core::Core;
use dynamics_core::robots::Ur5e;
use firmware_demo::catalogue;

#[entry]
fn main() -> ! {
    let mut priced = effects::Priced::<Core<Ur5e>>::new();
    catalogue::rigid(&mut priced);
    catalogue::joints(&mut priced);
    catalogue::bodies(&mut priced);
    catalogue::spinning(&mut priced);
    costs::done()
}
