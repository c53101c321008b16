//! The cost of each way to compute a quadruped leg's torques.
#![no_std]
#![no_main]

mod accuracy;

#[cortex_m_rt::entry]
fn main() -> ! {
    type Leg = dynamics_core::robots::A1Leg;
    let mut priced = accuracy::states::<Leg, 4, 3, 7>();
    lab_target::accuracy::list::inverse::<Leg, 4, 3>(&mut priced);
    accuracy::done()
}
