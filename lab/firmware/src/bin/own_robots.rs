//! The cost of inverse dynamics of robots from files: `cargo xtask import` names the files while
//! this is compiled.
#![no_std]
#![no_main]

mod costs;
// A module for each file, and `robots`, which calls `robot` for each.
include!(env!("OWN_ROBOT"));

use costs::row::Row;
use costs::{Ask, STATES, asks, done};
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia};
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

type Torque<E, const N: usize> = fn(&State<f32, N, N>, &E) -> [f32; N];

#[cortex_m_rt::entry]
fn main() -> ! {
    robots();
    done()
}

#[inline(never)]
fn robot<T: Robot<N, N, N>, const N: usize>(name: &'static str) {
    let asks = asks::<T, N, N, STATES>();
    measure::<T, _, N>(name, "full", &asks, &(Gravity::EARTH, Inertia, Coriolis));
    measure::<T, _, N>(name, "gravity", &asks, &(Gravity::EARTH,));
}

/// Both forms, with sines and cosines computed inside.
fn measure<T: Robot<N, N, N>, E: Effect<f32, N, N>, const N: usize>(
    name: &'static str,
    inputs: &str,
    asks: &[Ask<N>; STATES],
    effects: &E,
) {
    let forms: [(&str, Torque<E, N>); 2] = [
        ("core", |state, effects| Core::<T>::rnea(state, effects)),
        ("engine", |state, effects| Engine::<T>::rnea(state, effects)),
    ];
    for (form, torque) in forms {
        let row = Row { robot: name, algorithm: "rnea", form, inputs, trig: true, joints: N };
        row.measure(torque as usize, asks, |ask| torque(&ask.state, effects));
    }
}
