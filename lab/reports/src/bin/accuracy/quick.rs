//! The errors of the generated code, as it is printed, and those of the reference. Arguments name the
//! robots; none names all.

mod inverse;
/// Written by `cargo xtask accuracy`.
mod printed {
    include!(env!("ACCURACY_PRINTED"));
}
mod problem;
mod statistics;
mod yardsticks;

use dynamics_core::robots::{A1Leg, Panda, Ur5e};

macro_rules! print {
    ($($robot:ident, $b:literal, $n:literal, $w:literal, $name:ident;)*) => {
        let requested: Vec<String> = std::env::args().skip(1).collect();
        $(if requested.is_empty() || requested.iter().any(|robot| robot == stringify!($name)) {
            inverse::print::<$robot, $b, $n, $w>(|bench| {
                bench.kind = "generated";
                printed::$name(bench);
            });
        })*
    };
}

fn main() {
    print! {
        Ur5e, 6, 6, 9, ur5e;
        Panda, 7, 7, 7, panda;
        A1Leg, 4, 3, 7, a1_leg;
    }
}
