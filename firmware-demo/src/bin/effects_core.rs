//! What every effect costs in the core's inverse dynamics.
#![no_std]
#![no_main]

#[expect(
    dead_code,
    reason = "sines and cosines are for functions that take them"
)]
mod costs;
mod effects;

use cortex_m_rt::entry;
use dynamics_core::Core;
use dynamics_core::robots::{Panda, Ur5e};
use firmware_demo::effect_presets;

use effects::Priced;

#[entry]
fn main() -> ! {
    let ur5e = &mut Priced::<Core<Ur5e>, 6>::new();
    effect_presets::rigid(ur5e);
    effect_presets::joints(ur5e);
    effect_presets::bodies::<6, 5>(ur5e);
    effect_presets::spinning(ur5e);
    let panda = &mut Priced::<Core<Panda>, 7>::new();
    effect_presets::rigid(panda);
    effect_presets::joints(panda);
    effect_presets::bodies::<7, 6>(panda);
    effect_presets::spinning(panda);
    costs::done()
}
