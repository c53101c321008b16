//! The cost of M, forward dynamics and Jacobians on the robot of a file: a bin of
//! `cargo xtask costs --file`.
#![no_std]
#![no_main]

mod costs;
// `Robot` and the number of its joints, `N`.
include!(env!("OWN_ROBOT"));

#[cortex_m_rt::entry]
fn main() -> ! {
    costs::forward::both::<Robot, N, N, { N - 1 }>()
}
