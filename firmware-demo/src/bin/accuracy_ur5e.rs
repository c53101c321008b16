//! What each way to compute the UR5e's torques costs.
#![no_std]
#![no_main]

mod accuracy;
#[path = "accuracy/arm.rs"]
mod arm;

use cortex_m_rt::entry;
use dynamics_core::robots::Ur5e;

#[entry]
fn main() -> ! {
    arm::run::<Ur5e, 6, 9>()
}
