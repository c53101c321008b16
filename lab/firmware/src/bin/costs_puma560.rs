//! The cost of inverse dynamics, M and forward dynamics on the PUMA 560.
#![no_std]
#![no_main]

mod costs;

use costs::forward;
use costs::inverse::inverse;
use dynamics_core::effects::{Gravity, RIGID_BODY};

fn run() -> ! {
    let asks = costs::asks::<robots::Puma560, 6, 6, { costs::STATES }>();
    inverse::<robots::Puma560, _, 6, 6>("full", &asks, &RIGID_BODY);
    inverse::<robots::Puma560, _, 6, 6>("gravity", &asks, &(Gravity::EARTH,));
    let forms = [
        forward::of_core::<robots::Puma560, 6, 6, 5>(),
        forward::of_engine::<robots::Puma560, 6, 6, 5>(),
    ];
    forward::run::<robots::Puma560, 6, 6, 5>(&asks, &forms);
    forward::derivatives::<robots::Puma560, 6, 6, 5>(&asks, &forms);
    costs::done()
}

costs::main!(run());
