//! The scene of `friction_named` without its LuGre friction.
#![no_std]
#![no_main]

mod friction_scene;

use cortex_m::singleton;
use cortex_m_rt::entry;
use dynamics_core::effects::{Coriolis, Gravity, Inertia};

type Effects = (Gravity, Inertia, Coriolis);

const EFFECTS: Effects = (Gravity::EARTH, Inertia, Coriolis);

#[entry]
fn main() -> ! {
    friction_scene::run(singleton!(: Effects = EFFECTS))
}
