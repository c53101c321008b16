//! Runs the scene [`wheel_leg_balance`](firmware_demo::scenes::wheel_leg_balance).
#![no_std]
#![no_main]

#[cortex_m_rt::entry]
fn main() -> ! {
    #[cfg(not(feature = "telemetry"))]
    firmware_demo::target::wheeled::scene();
    #[cfg(feature = "telemetry")]
    firmware_demo::target::trials::wheel_leg_balance()
}
