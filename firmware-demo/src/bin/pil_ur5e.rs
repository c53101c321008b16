//! The controller of the scene [`ur5e`](firmware_demo::scenes::ur5e), its robot simulated by the program on the host that
//! `cargo xtask pil` runs.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::sim_io::Wires;
use firmware_demo::target::pil::control;

#[entry]
fn main() -> ! {
    static WIRES: Wires<6> = Wires::new();
    control::<PickAndPlace, 6, 6, 6, 6>(&WIRES)
}
