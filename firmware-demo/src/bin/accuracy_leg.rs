//! What each way to compute a quadruped leg's torques costs.
#![no_std]
#![no_main]

mod accuracy;

use cortex_m_rt::entry;
use dynamics_core::robots::A1Leg;

#[entry]
fn main() -> ! {
    accuracy::rigid::<A1Leg, 4, 3, 7>();
    accuracy::done()
}
