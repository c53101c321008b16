//! The errors of single changes to the default way to compute a torque, on the robot of a file.
//! Nothing is recorded of it: errors are those from the core in f64.

mod inverse;
mod problem;
mod statistics;
mod yardsticks;
// `Robot` and the number of its joints, `N`.
include!(env!("OWN_ROBOT"));

fn main() {
    inverse::print::<Robot, N, N, _>(fixtures::accuracy::list::single::<Robot, N, N>);
}
