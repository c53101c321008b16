//! The costs of the ways from which one is chosen for the robot of a file: the bin of
//! `cargo xtask accuracy --file`.
#![no_std]
#![no_main]

mod accuracy;
// `Robot` and the number of its joints, `N`.
include!(env!("OWN_ROBOT"));

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut priced = accuracy::states::<Robot, N, N, _>();
    fixtures::accuracy::list::candidates::<Robot, N, N>(&mut priced);
    accuracy::done()
}
