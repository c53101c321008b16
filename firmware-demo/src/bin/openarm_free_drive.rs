//! Runs the scene [`openarm_free_drive`](firmware_demo::scenes::openarm_free_drive).
#![no_std]
#![no_main]

use firmware_demo::scenes::openarm_free_drive::trial::Guidance;

#[cortex_m_rt::entry]
fn main() -> ! {
    firmware_demo::target::trials::scene::<Guidance, 7>()
}
