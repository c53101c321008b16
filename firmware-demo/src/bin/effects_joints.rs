//! What effects at joints cost in the engine's inverse dynamics.
#![no_std]
#![no_main]

#[expect(dead_code, reason = "postures are for what takes them at hand")]
mod costs;
mod effects;

use cortex_m_rt::entry;
use dynamics_core::Engine;
use dynamics_core::robots::Ur5e;
use firmware_demo::catalogue;

#[entry]
fn main() -> ! {
    let mut priced = effects::Priced::<Engine<Ur5e>>::new();
    catalogue::joints(&mut priced);
    costs::done()
}
