//! Prints the errors of every way to compute a torque, one line of JSON each:
//! `cargo xtask accuracy` joins them with what the ways cost on the target. f32 gives the same bits
//! here and there.
//!
//! | kind of line | what |
//! |---|---|
//! | `inverse` | torque errors of a way along the robot's trajectory, and over states anywhere, N·m |
//! | `yardstick` | torque errors that an encoder, parameters and friction leave, N·m |
//! | `simulation` | trajectory error in the first second, rad, and energy bias_acceleration, J/s, of a way with a length of step, µs |
//! | `oracle` | the error of the f64 reference itself |
//!
//! Arguments name the robots, and `simulation`; none names all.

mod inverse;
mod problem;
mod simulation;
mod statistics;
mod yardsticks;

use dynamics_core::robots::{A1Leg, Panda, Ur5e};
use fixtures::accuracy::list;

fn main() {
    let requested: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &str| requested.is_empty() || requested.iter().any(|robot| robot == name);
    if wanted("ur5e") {
        inverse::print::<Ur5e, 6, 6, 9>(list::inverse::<Ur5e, 6, 6>);
    }
    if wanted("panda") {
        inverse::print::<Panda, 7, 7, 7>(list::inverse::<Panda, 7, 7>);
    }
    if wanted("a1_leg") {
        inverse::print::<A1Leg, 4, 3, 7>(list::inverse::<A1Leg, 4, 3>);
    }
    if wanted("simulation") {
        simulation::print();
    }
}
