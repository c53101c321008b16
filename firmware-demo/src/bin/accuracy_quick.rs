//! What single changes to the default way to compute torques cost, and what is printed to be pasted: few enough for the
//! tests.
#![no_std]
#![no_main]

mod accuracy;

use cortex_m_rt::entry;
use dynamics_core::robots::{A1Leg, Panda, Ur5e};
use firmware_demo::accuracy::list;
use firmware_demo::accuracy::robots::Compared;

#[inline(never)]
fn robot<T: Compared<B, N, W>, const B: usize, const N: usize, const W: usize>() {
    let mut priced = accuracy::states::<T, B, N, W>();
    list::single::<T, B, N>(&mut priced);
    priced.algorithm = "pasted";
    T::pasted(&mut priced);
}

#[entry]
fn main() -> ! {
    robot::<Ur5e, 6, 6, 9>();
    robot::<Panda, 7, 7, 7>();
    robot::<A1Leg, 4, 3, 7>();
    accuracy::done()
}
