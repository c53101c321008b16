//! Runs the scene [`openarm_free_drive`](firmware_demo::scenes::openarm_free_drive).
#![no_std]
#![no_main]

#[cortex_m_rt::entry]
fn main() -> ! {
    #[cfg(not(feature = "telemetry"))]
    firmware_demo::target::guided::scene();
    #[cfg(feature = "telemetry")]
    firmware_demo::target::trials::openarm_free_drive()
}
