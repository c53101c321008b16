//! What inverse dynamics of a robot from a file costs: `cargo xtask import` names the file while this is compiled.
#![no_std]
#![no_main]

mod costs;
// `robot`, the file's module, and `OwnRobot`, its type.
include!(concat!(env!("OUT_DIR"), "/own_robot.rs"));

use costs::row::Row;
use costs::{Ask, STATES, asks, done};
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use robot::V;

type Torque<E> = fn(&State<f32, V, V>, &E) -> [f32; V];

#[cortex_m_rt::entry]
fn main() -> ! {
    let asks = asks::<OwnRobot, V, V, STATES>();
    measure("full", &asks, &(Gravity::EARTH, Inertia, Coriolis));
    measure("gravity", &asks, &(Gravity::EARTH,));
    done()
}

/// Both forms, with sines and cosines computed inside.
fn measure<E: Effect<f32, V, V>>(inputs: &str, asks: &[Ask<V>; STATES], effects: &E) {
    let forms: [(&str, Torque<E>); 2] = [
        ("core", |state, effects| {
            Core::<OwnRobot>::rnea(state, effects)
        }),
        ("engine", |state, effects| {
            Engine::<OwnRobot>::rnea(state, effects)
        }),
    ];
    for (form, torque) in forms {
        let row = Row {
            robot: "own",
            algorithm: "rnea",
            form,
            inputs,
            trig: true,
            joints: V,
        };
        row.measure(torque as usize, asks, |ask| torque(&ask.state, effects));
    }
}
