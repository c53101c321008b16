//! The cost of a step of each way to simulate.
#![no_std]
#![no_main]

mod accuracy;

#[cortex_m_rt::entry]
fn main() -> ! {
    accuracy::simulated::<fixtures::accuracy::passive_motion::DoublePendulum, 2>();
    accuracy::simulated::<dynamics_core::robots::Ur5e, 6>();
    accuracy::done()
}
