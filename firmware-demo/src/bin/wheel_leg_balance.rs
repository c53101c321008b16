//! Runs the scene [`wheel_leg_balance`](firmware_demo::scenes::wheel_leg_balance).
#![no_std]
#![no_main]

use firmware_demo::scenes::wheel_leg_balance::trial::Ride;

#[cortex_m_rt::entry]
fn main() -> ! {
    firmware_demo::target::trials::scene::<Ride, 6>()
}
