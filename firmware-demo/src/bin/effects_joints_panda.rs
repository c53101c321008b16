//! What effects at joints cost in the engine's inverse dynamics of the Panda.
#![no_std]
#![no_main]

#[expect(dead_code, reason = "postures are for what takes them at hand")]
mod costs;
mod effects;

use cortex_m_rt::entry;
use dynamics_core::Engine;
use dynamics_core::robots::Panda;
use firmware_demo::effect_presets;

use effects::Priced;

#[entry]
fn main() -> ! {
    effect_presets::joints(&mut Priced::<Engine<Panda>, 7>::new());
    costs::done()
}
