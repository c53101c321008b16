//! What effects at joints cost in the engine's inverse dynamics of the UR5e.
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
use dynamics_core::robots::Ur5e;
use firmware_demo::effect_presets;

use effects::Priced;

#[entry]
fn main() -> ! {
    effect_presets::joints(&mut Priced::<Engine<Ur5e>, 6>::new());
    costs::done()
}
