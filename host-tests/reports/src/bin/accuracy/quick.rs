//! The errors of single changes to the default way to compute a torque, and of what is printed to be pasted: what the bin
//! `accuracy` prints of them, from less to build. Arguments name the robots; none names all.

mod inverse;
mod speed;
mod statistics;
mod yardsticks;

use dynamics_core::robots::{A1Leg, Panda, Ur5e};
use firmware_demo::accuracy::list;

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &str| asked.is_empty() || asked.iter().any(|robot| robot == name);
    if wanted("ur5e") {
        inverse::print::<Ur5e, 6, 6, 9>(list::single::<Ur5e, 6, 6>);
    }
    if wanted("panda") {
        inverse::print::<Panda, 7, 7, 7>(list::single::<Panda, 7, 7>);
    }
    if wanted("a1_leg") {
        inverse::print::<A1Leg, 4, 3, 7>(list::single::<A1Leg, 4, 3>);
    }
}
