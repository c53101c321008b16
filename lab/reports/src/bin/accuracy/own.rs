//! The errors of the ways from which one is chosen for the robot of a file. Nothing is recorded of
//! it: errors are those from the core in f64.

mod inverse;
mod problem;
mod statistics;
mod yardsticks;
// `Robot` and the number of its joints, `N`.
include!(env!("OWN_ROBOT"));

fn main() {
    inverse::print::<Robot, N, N, _>(fixtures::accuracy::list::candidates::<Robot, N, N>);
}
