//! The cost of each way to compute a quadruped leg's torques.
#![no_std]
#![no_main]

mod accuracy;

#[cortex_m_rt::entry]
fn main() -> ! {
    accuracy::robot::<dynamics_core::robots::A1Leg, 4, 3, 7>()
}
