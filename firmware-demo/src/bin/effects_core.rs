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
use firmware_demo::catalogue;

use effects::Priced;

#[entry]
fn main() -> ! {
    let ur5e = &mut Priced::<Core<Ur5e>, 6>::new();
    catalogue::rigid(ur5e);
    catalogue::joints(ur5e);
    catalogue::bodies::<6, 5>(ur5e);
    catalogue::spinning(ur5e);
    let panda = &mut Priced::<Core<Panda>, 7>::new();
    catalogue::rigid(panda);
    catalogue::joints(panda);
    catalogue::bodies::<7, 6>(panda);
    catalogue::spinning(panda);
    costs::done()
}
