//! The cost of the generated code, as it is printed.
#![no_std]
#![no_main]

mod accuracy;
/// Written by `cargo xtask accuracy`.
mod printed {
    include!(env!("ACCURACY_PRINTED"));
}

use dynamics_core::robots::{A1Leg, Panda, Ur5e};

/// Robots, and what is printed of them.
macro_rules! measure {
    ($($robot:ident, $b:literal, $n:literal, $w:literal, $printed:ident;)*) => {$({
        let mut priced = accuracy::states::<$robot, $b, $n, $w>();
        priced.algorithm = "generated";
        printed::$printed(&mut priced);
    })*};
}

#[cortex_m_rt::entry]
fn main() -> ! {
    measure! {
        Ur5e, 6, 6, 9, ur5e;
        Panda, 7, 7, 7, panda;
        A1Leg, 4, 3, 7, a1_leg;
    }
    accuracy::done()
}
