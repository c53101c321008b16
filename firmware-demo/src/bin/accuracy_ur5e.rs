//! What each way to compute the UR5e's torques costs.
#![no_std]
#![no_main]

mod accuracy;

use cortex_m_rt::entry;
use dynamics_core::robots::Ur5e;
use firmware_demo::trajectories::PICK_AND_PLACE;

#[entry]
fn main() -> ! {
    accuracy::inverse::<Ur5e, 6, 6, 9>(&PICK_AND_PLACE)
}
