//! What effects at joints cost in the engine's inverse dynamics of the Panda.
#![no_std]
#![no_main]

#[expect(
    dead_code,
    reason = "sines and cosines are for functions that take them"
)]
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
