//! A scene that names LuGre friction: `friction_dropped` is the same without it.
#![no_std]
#![no_main]

mod friction_scene;

use cortex_m::singleton;
use cortex_m_rt::entry;
use dynamics_core::effects::{Coriolis, Gravity, Inertia, Lugre, Width};

type Effects = (Gravity, Inertia, Coriolis, Lugre<f32, 6>);

const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Lugre {
        stiffness: [1e5; 6],
        damping: [300.0; 6],
        viscous: [12.0, 12.0, 8.0, 2.0, 2.0, 1.5],
        sliding: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2],
        excess: [3.0, 3.0, 2.0, 0.5, 0.5, 0.4],
        stribeck_speed: Width::f32(0.05),
        bristle: [0.0; 6],
    },
);

#[entry]
fn main() -> ! {
    friction_scene::run(singleton!(: Effects = EFFECTS))
}
