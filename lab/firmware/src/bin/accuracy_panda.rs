//! The cost of each way to compute the Panda's torques.
#![no_std]
#![no_main]

mod accuracy;

#[cortex_m_rt::entry]
fn main() -> ! {
    accuracy::robot::<dynamics_core::robots::Panda, 7, 7, 7>()
}
