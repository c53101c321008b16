//! Prints the errors of every way to compute a torque, one line of JSON each: `cargo xtask accuracy` joins them with
//! what the ways cost on the target. f32 gives the same bits here and there.
//!
//! Kinds of line: `inverse` and `yardstick` (N·m), `oracle` (how far the f64 that they are held against is itself off).
//! Arguments name the robots; none names all.

mod inverse;
mod statistics;

use dynamics_core::robots::Ur5e;
use firmware_demo::trajectories::PICK_AND_PLACE;

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &str| asked.is_empty() || asked.iter().any(|robot| robot == name);
    if wanted("ur5e") {
        inverse::print::<Ur5e, 6, 6, 9>("ur5e", &PICK_AND_PLACE);
    }
}
