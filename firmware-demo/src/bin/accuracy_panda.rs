//! What each way to compute the Panda's torques costs.
#![no_std]
#![no_main]

mod accuracy;
#[path = "accuracy/arm.rs"]
mod arm;

use cortex_m_rt::entry;
use dynamics_core::robots::Panda;

#[entry]
fn main() -> ! {
    arm::run::<Panda, 7, 7>()
}
