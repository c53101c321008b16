//! The cost of each way to compute the UR5e's torques.
#![no_std]
#![no_main]

mod accuracy;

#[cortex_m_rt::entry]
fn main() -> ! {
    accuracy::robot::<dynamics_core::robots::Ur5e, 6, 6, 9>()
}
